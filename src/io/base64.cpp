#include "io/base64.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace unsnarl {
namespace {

/// Six bits of a base64 digit (also of the URL-safe alphabet), or -1.
int base64_bits(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

bool is_space(char c) {
  return static_cast<unsigned char>(c) <= ' ';
}

}  // namespace

std::string base64_encoded(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::string_view group = bytes.substr(at, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < group.size() ? std::uint8_t(group[k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= group.size() ? digits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::optional<std::string> base64_decoded(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string result;
  result.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int six = base64_bits(c);
    if (six < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(six);
    count += 6;
    if (count >= 8) {
      count -= 8;
      result += static_cast<char>(bits >> count & 0xFF);
    }
  }
  return result;
}

void base64_patch(std::string& text, std::string_view old_bytes, std::string_view new_bytes) {
  const bool url_safe = text.find_first_of("-_") != std::string::npos;
  const std::string_view last_two = url_safe ? "-_" : "+/";
  for (std::size_t i = 0; i < old_bytes.size(); ++i) {
    if (old_bytes[i] == new_bytes[i]) continue;
    const std::size_t group = i / 3 * 3;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t at = group / 3 * 4 + k;
      // Digit k covers the bits 6 k to 6 k + 5 of the group; those of bytes that do not exist stay.
      std::uint32_t six = 0;
      for (std::size_t bit = 6 * k; bit < 6 * k + 6; ++bit) {
        const std::size_t byte = group + bit / 8;
        std::uint32_t value = 0;
        if (byte < new_bytes.size()) {
          value = static_cast<unsigned char>(new_bytes[byte]) >> (7 - bit % 8) & 1;
        } else if (at < text.size() && text[at] != '=') {
          value = static_cast<std::uint32_t>(base64_bits(text[at])) >> (6 * k + 5 - bit) & 1;
        }
        six = six << 1 | value;
      }
      if (at >= text.size() || text[at] == '=') continue;
      constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
      if (static_cast<std::uint32_t>(base64_bits(text[at])) != six) {
        text[at] = six < 62 ? digits[six] : last_two[six - 62];
      }
    }
  }
}

std::string without_space(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  std::copy_if(text.begin(), text.end(), std::back_inserter(result), [](char c) { return !is_space(c); });
  return result;
}

std::string with_digits(std::string_view old_text, std::string_view digits) {
  const auto first = std::find_if_not(old_text.begin(), old_text.end(), is_space);
  const auto last = std::find_if_not(old_text.rbegin(), std::make_reverse_iterator(first), is_space).base();
  const auto count = std::count_if(first, last, [](char c) { return !is_space(c); });
  if (static_cast<std::size_t>(count) != digits.size())
    return std::string(old_text.begin(), first).append(digits).append(last, old_text.end());
  std::string result(old_text);
  std::size_t next = 0;
  for (char& c : result)
    if (!is_space(c)) c = digits[next++];
  return result;
}

}  // namespace unsnarl
