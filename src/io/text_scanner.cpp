#include "io/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>

#include "text/read_number.h"
#include "unsnarl/document.h"
#include "unsnarl/visible_text.h"

namespace unsnarl {
namespace {

/// For a number out of range: is it too small (rather than too large)?
bool is_tiny(std::string_view token) {
  const std::size_t e = std::min(token.find_first_of("eE"), token.size());
  const std::string_view mantissa = token.substr(0, e);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t digit = mantissa.find_first_of("123456789");
  if (digit == std::string_view::npos) return true;
  const auto leading = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(digit);
  std::int64_t exponent = 0;
  if (e < token.size()) {
    std::string_view digits = token.substr(e + 1);
    const bool negative = digits.starts_with('-');
    if (negative || digits.starts_with('+')) digits.remove_prefix(1);
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (result.ec == std::errc::result_out_of_range) return negative;
    if (negative) exponent = -exponent;
  }
  return exponent < -leading;
}

}  // namespace

template <class T>
TextScanner::Number TextScanner::number(T& value) {
  if (at_ == end_ || ends_token(*at_)) return Number::missing;
  const char* start = at_;
  if (*start == '+' && start + 1 != end_ && start[1] != '-') ++start;
  T result{};
  const auto [after, error] = read_number(start, end_, result);
  if (error == std::errc::invalid_argument) return Number::malformed;
  if (after != end_ && !ends_token(*after)) return Number::malformed;
  if (error == std::errc::result_out_of_range) {
    const std::string_view token(start, static_cast<std::size_t>(after - start));
    if (!is_tiny(token)) return Number::not_finite;
    result = token.starts_with('-') ? -T{0} : T{0};
  }
  if (!std::isfinite(result)) return Number::not_finite;
  value = result;
  at_ = after;
  return Number::ok;
}
template TextScanner::Number TextScanner::number(float&);
template TextScanner::Number TextScanner::number(double&);

std::string_view TextScanner::rest_of_line() {
  skip_blanks();
  const char* start = at_;
  while (at_ != end_ && *at_ != '\n' && *at_ != '\r') ++at_;
  const char* stop = at_;
  while (stop != start && static_cast<unsigned char>(stop[-1]) <= ' ') --stop;
  skip_line_end();
  return {start, static_cast<std::size_t>(stop - start)};
}

std::size_t TextScanner::line(std::size_t offset) const {
  std::size_t lines = 1;
  for (const char* c = begin_; c != begin_ + offset; ++c) {
    lines += *c == '\n' || (*c == '\r' && (c + 1 == end_ || c[1] != '\n'));
  }
  return lines;
}

void TextScanner::fail(const std::string& message, std::size_t offset) const {
  throw FileError(fmt::format("line {}: {}", line(offset), message));
}

void TextScanner::fail_coordinate(Number reason, std::size_t vertex, bool is_float) {
  const std::string token = in_quotes(peek());
  switch (reason) {
    case Number::missing: fail(fmt::format("vertex {} has fewer than three coordinates; give it x, y and z", vertex));
    case Number::malformed:
      fail(fmt::format("coordinate {} of vertex {} is not a number; write it like -1.5e-3, with a decimal point", token,
                       vertex));
    default:
      fail(fmt::format("coordinate {} of vertex {} is not finite{}; correct or remove this vertex", token, vertex,
                       is_float ? " in 32 bits" : ""));
  }
}

std::string_view number_token(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && static_cast<unsigned char>(text[end]) > ' ' && text[end] != '\\' && text[end] != '#') {
    ++end;
  }
  return text.substr(begin, end - begin);
}

std::string in_quotes(std::string_view token) {
  std::size_t longest = 30;
  while (longest > 0 && token.size() > longest && (token[longest] & 0xc0) == 0x80) --longest;  // within a character
  return '\'' + visible_text(token.substr(0, longest)) + (token.size() > longest ? "...'" : "'");
}

}  // namespace unsnarl
