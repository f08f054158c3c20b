#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace unsnarl {

/// Predictions of the words of a list; only the differences from them are stored.
struct Prediction {
  std::size_t stride = 0;  ///< > 0: the word this many places before; before the first: 0
  std::span<const std::uint32_t> like =
      {};  ///< not empty: the word at the same place of this list, as long as the first
};

/// Lists of 32-bit words as text that a page can hold: differences from the prediction (modulo 2^32) with the sign in
/// the lowest bit, their lowest bytes first and their highest last, deflated (zlib format), base64.
///
/// viewer/src/packed_words.js reads it. Throws std::invalid_argument where `like` has another length.
std::string pack_words(std::span<const std::uint32_t> words, const Prediction& prediction = {});
std::string pack_words(std::span<const std::int32_t> words, const Prediction& prediction = {});
/// The bits of the floats are the words.
std::string pack_words(std::span<const float> words, const Prediction& prediction = {});

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace unsnarl
