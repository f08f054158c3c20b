#include "render/packed_words.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "geometry/bit_cast.h"

namespace unsnarl {
namespace {

template <class Word>
std::vector<std::uint32_t> as_unsigned(std::span<const Word> words) {
  std::vector<std::uint32_t> result(words.size());
  for (std::size_t i = 0; i < words.size(); ++i) result[i] = bit_cast<std::uint32_t>(words[i]);
  return result;
}

/// Small differences of either sign become small numbers, so that the planes of the high bytes are mostly zero.
constexpr std::uint32_t sign_to_lowest_bit(std::uint32_t difference) {
  return (difference << 1) ^ (0u - (difference >> 31));
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_DEFAULT_COMPRESSION);
  if (code == Z_MEM_ERROR) throw std::bad_alloc();
  if (code != Z_OK) throw std::runtime_error("zlib could not compress a list of the page");
  result.resize(size);
  return result;
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string pack_words(std::span<const std::uint32_t> words, const Prediction& prediction) {
  if (!prediction.like.empty() && prediction.like.size() != words.size())
    throw std::invalid_argument("a list can be predicted only from one of the same length");
  const std::size_t n = words.size(), stride = prediction.stride;
  std::string planes(4 * n, '\0');
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t expected = !prediction.like.empty()    ? prediction.like[i]
                                   : stride > 0 && i >= stride ? words[i - stride]
                                                               : 0;
    const std::uint32_t code = sign_to_lowest_bit(words[i] - expected);
    for (std::size_t k = 0; k < 4; ++k) planes[k * n + i] = static_cast<char>(code >> (8 * k));
  }
  return base64(deflated(planes));
}

std::string pack_words(std::span<const std::int32_t> words, const Prediction& prediction) {
  return pack_words(as_unsigned(words), prediction);
}

std::string pack_words(std::span<const float> words, const Prediction& prediction) {
  return pack_words(as_unsigned(words), prediction);
}

}  // namespace unsnarl
