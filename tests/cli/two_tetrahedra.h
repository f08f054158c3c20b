#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>

/// A tetrahedron into which the tip of a small one sticks.
namespace unsnarl::cli::two_tetrahedra {

inline constexpr std::array<std::array<float, 3>, 8> points = {{{0, 0, 0},
                                                                {4, 0, 0},
                                                                {0, 4, 0},
                                                                {0, 0, 4},
                                                                {1.2F, 1.2F, 1.1F},
                                                                {2.6F, 2.5F, 2},
                                                                {2.5F, 2.6F, 2.2F},
                                                                {2, 2, 2.7F}}};
inline constexpr std::array<int, 24> corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4, 6, 5, 4, 5, 7, 5, 6, 7, 4, 7, 6};

/// Their corners, three a triangle, larger by `scale`: little-endian floats.
inline std::string buffer(float scale = 1) {
  std::string bytes;
  for (const int c : corners)
    for (const float x : points[c]) {
      const auto word = std::bit_cast<std::uint32_t>(scale * x);
      for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 255);
    }
  return bytes;
}

}  // namespace unsnarl::cli::two_tetrahedra
