#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "unsnarl/surface.h"

namespace unsnarl::shapes {

/// The part of a lens that lies at one position without being one vertex.
enum class LensPinch {
  none,
  vertices,         ///< the middles of front and back
  edges,            ///< and one edge from each of them
  fans,             ///< and all faces around them
  all,              ///< front and back everywhere, face on face
  other_diagonals,  ///< the same with the quads of the back cut the other way
  ends_of_an_edge,  ///< one edge of the front has length zero
  fan_in_a_point,   ///< and all edges around the middle of the front
};

/// A closed manifold surface, one component: two discs of `n` sectors and three rings, joined along the outermost.
inline Surface lens(std::int32_t n, LensPinch pinch) {
  Surface s;
  const auto add = [&](double radius, double sector, double z) {
    const double angle = 6.283185307179586 * sector / n;
    s.positions.insert(s.positions.end(), {radius * std::cos(angle), radius * std::sin(angle), z});
    return static_cast<std::int32_t>(s.positions.size() / 3) - 1;
  };
  std::vector<std::int32_t> rim;
  for (std::int32_t k = 0; k < n; ++k) rim.push_back(add(3, k, 0));
  const bool is_flat = pinch == LensPinch::all || pinch == LensPinch::other_diagonals;
  const bool fans_meet = is_flat || pinch == LensPinch::fans;
  const bool middles_meet = fans_meet || pinch == LensPinch::vertices || pinch == LensPinch::edges;
  for (const int side : {1, -1}) {
    const double height = side * 0.5;
    const std::int32_t middle = add(0, 0, middles_meet ? 0 : height);
    std::array<std::vector<std::int32_t>, 3> rings;
    for (std::int32_t k = 0; k < n; ++k) {
      const bool first_meets = fans_meet || (pinch == LensPinch::edges && k == 0);
      const bool is_in_middle =
          side > 0 && (pinch == LensPinch::fan_in_a_point || (pinch == LensPinch::ends_of_an_edge && k == 0));
      rings[0].push_back(add(is_in_middle ? 0 : 1, k, first_meets ? 0 : height));
    }
    for (std::int32_t k = 0; k < n; ++k) rings[1].push_back(add(2, k, is_flat ? 0 : 0.7 * height));
    rings[2] = rim;
    const auto add_triangle = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      if (side > 0)
        s.corners.insert(s.corners.end(), {a, b, c});
      else
        s.corners.insert(s.corners.end(), {a, c, b});
    };
    for (std::int32_t k = 0; k < n; ++k) {
      const std::int32_t next = (k + 1) % n;
      add_triangle(middle, rings[0][k], rings[0][next]);
      for (int r = 0; r < 2; ++r) {
        const std::int32_t a = rings[r][k], b = rings[r + 1][k], c = rings[r + 1][next], d = rings[r][next];
        if (side < 0 && pinch == LensPinch::other_diagonals) {
          add_triangle(a, b, d);
          add_triangle(b, c, d);
        } else {
          add_triangle(a, b, c);
          add_triangle(a, c, d);
        }
      }
    }
  }
  return s;
}

}  // namespace unsnarl::shapes
