#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/image.h"

namespace unsnarl {

/// A few colours in place of many.
class Palette {
 public:
  /// Up to `size` colours ([2, 256]) for all pixels of the images, by cutting the colours used where their variance is
  /// largest (a variant of P. Heckbert's median cut, "Color Image Quantization for Frame Buffer Display", 1982). White
  /// is always among them. Deterministic.
  Palette(std::span<const Image> images, int size);

  const std::vector<std::array<std::uint8_t, 3>>& colours() const { return colours_; }
  /// Position of the colour nearest to an 8-bit RGB pixel.
  std::uint8_t nearest(const std::uint8_t* pixel) const { return nearest_[bin_of(pixel)]; }

 private:
  static constexpr int bits = 6;  ///< Bits of each channel that are told apart (unit: bits)
  static std::size_t bin_of(const std::uint8_t* pixel) {
    return (std::size_t{pixel[0]} >> (8 - bits)) << (2 * bits) | (std::size_t{pixel[1]} >> (8 - bits)) << bits |
           std::size_t{pixel[2]} >> (8 - bits);
  }

  std::vector<std::array<std::uint8_t, 3>> colours_;
  std::vector<std::uint8_t> nearest_;  // by bin
};

}  // namespace unsnarl
