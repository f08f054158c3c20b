#include "mesh/simplification.h"

#include <meshoptimizer.h>

#include <cmath>

#include "geometry/box.h"

namespace unsnarl {

std::vector<Triangle> simplify(const Positions& x, std::span<const Triangle> triangles, std::size_t count,
                               double tolerance) {
  Box box;
  for (const Triangle& t : triangles) box.extend(box_of(x, t));
  const double size = triangles.empty() ? 0 : (box.hi - box.lo).maxCoeff();
  if (!(size > 0) || !std::isfinite(size)) return {triangles.begin(), triangles.end()};
  // In the units of the library: single precision, sizes relative to the largest extent. Only which vertices stay
  // depends on it.
  std::vector<float> points(3 * static_cast<std::size_t>(x.cols()));
  std::vector<unsigned> corners;
  corners.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (const Index v : t) {
      corners.push_back(static_cast<unsigned>(v));
      for (int k = 0; k < 3; ++k)
        points[3 * static_cast<std::size_t>(v) + k] = static_cast<float>((x(k, v) - box.lo[k]) / size);
    }
  std::vector<unsigned> left(corners.size());
  left.resize(meshopt_simplify(left.data(), corners.data(), corners.size(), points.data(), points.size() / 3,
                               3 * sizeof(float), 3 * count, static_cast<float>(tolerance / size),
                               meshopt_SimplifyLockBorder));
  std::vector<Triangle> result(left.size() / 3);
  for (std::size_t k = 0; k < left.size(); ++k) result[k / 3][k % 3] = static_cast<Index>(left[k]);
  return result;
}

}  // namespace unsnarl
