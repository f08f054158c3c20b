#pragma once

#include <cmath>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Two wavy sheets over the unit square that cross along some curves, with about `faces` triangles in all.
struct CrossingSheets {
  Positions x;
  std::vector<Triangle> triangles;
};

inline CrossingSheets make_crossing_sheets(Index faces) {
  const Index n = std::max<Index>(2, static_cast<Index>(std::lround(std::sqrt(faces / 4.0))));  // quads a side
  CrossingSheets sheets;
  sheets.x.resize(3, 2 * (n + 1) * (n + 1));
  for (Index s = 0; s < 2; ++s) {
    const Index first = s * (n + 1) * (n + 1);
    for (Index i = 0; i <= n; ++i)
      for (Index j = 0; j <= n; ++j) {
        // Shifted by a part of an edge, so that crossings are generic.
        const double u = (i + 0.37 * s) / n, v = (j + 0.21 * s) / n;
        const double height = s == 0 ? 0.05 * std::sin(7 * u) * std::cos(5 * v) : 0.05 * std::cos(6 * u + 3 * v);
        sheets.x.col(first + i * (n + 1) + j) = Vec3(u, v, height);
      }
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        const Index a = first + i * (n + 1) + j, b = a + n + 1;
        sheets.triangles.push_back({a, b, b + 1});
        sheets.triangles.push_back({a, b + 1, a + 1});
      }
  }
  return sheets;
}

}  // namespace unsnarl
