#include "render/packed_words.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <limits>
#include <stdexcept>
#include <vector>

namespace unsnarl {
namespace {

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t group = 0;
    int count = 3;
    for (std::size_t k = 0; k < 4; ++k) {
      if (text[i + k] == '=') --count;
      group = group << 6 | (text[i + k] == '=' ? 0u : static_cast<std::uint32_t>(digits.find(text[i + k])));
    }
    for (int k = 0; k < count; ++k) bytes += static_cast<char>(group >> (16 - 8 * k));
  }
  return bytes;
}

/// What the page does: viewer/src/packed_words.js.
std::vector<std::uint32_t> unpacked(const std::string& text, std::size_t n, const Prediction& prediction = {}) {
  const std::string compressed = from_base64(text);
  std::vector<unsigned char> planes(4 * n + 1);
  uLongf size = planes.size();
  EXPECT_EQ(uncompress(planes.data(), &size, reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()),
            Z_OK);
  EXPECT_EQ(size, 4 * n);
  std::vector<std::uint32_t> words(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::uint32_t code = 0;
    for (std::size_t k = 0; k < 4; ++k) code |= std::uint32_t{planes[k * n + i]} << (8 * k);
    words[i] = code >> 1 ^ (0u - (code & 1));
    if (!prediction.like.empty())
      words[i] += prediction.like[i];
    else if (prediction.stride > 0 && i >= prediction.stride)
      words[i] += words[i - prediction.stride];
  }
  return words;
}

const std::vector<std::uint32_t> extremes = {0, 1, 0xffffffff, 0x80000000, 0x7fffffff, 12345, 12346};

TEST(PackedWords, come_back_whatever_the_prediction) {
  const std::vector<std::uint32_t> like = {7, 0xffffffff, 0, 0x80000001, 5, 5, 5};
  for (const Prediction& prediction :
       {Prediction{}, Prediction{.stride = 1, .like = {}}, Prediction{.stride = 3, .like = {}},
        Prediction{.stride = 100, .like = {}}, Prediction{.stride = 0, .like = like}})
    EXPECT_EQ(unpacked(pack_words(std::span<const std::uint32_t>(extremes), prediction), extremes.size(), prediction),
              extremes);
}

TEST(PackedWords, floats_are_their_bits) {
  const std::vector<float> values = {0.F, -0.F, 1.5F, std::numeric_limits<float>::infinity(), 1e-40F};
  const std::vector<std::uint32_t> words = unpacked(pack_words(std::span<const float>(values)), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(words[i], std::bit_cast<std::uint32_t>(values[i]));
}

TEST(PackedWords, what_was_predicted_takes_next_to_no_room) {
  std::vector<std::int32_t> words(30000);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::int32_t>(i);
  EXPECT_LT(pack_words(std::span<const std::int32_t>(words), {.stride = 3, .like = {}}).size(), 500u);
}

TEST(PackedWords, prediction_of_another_length_is_refused) {
  EXPECT_THROW(
      pack_words(std::span<const std::uint32_t>(extremes), {.stride = 0, .like = std::span(extremes).first(2)}),
      std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
