#include "mesh/validity.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/types.h"

namespace unsnarl {
namespace {

void require_finite(std::span<const double> positions) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!std::isfinite(positions[i]))
      throw std::invalid_argument("vertex " + std::to_string(i / 3) + " has a coordinate that is not a finite number");
}

}  // namespace

void require_valid(const SurfaceView& surface) {
  if (surface.positions.size() % 3 != 0)
    throw std::invalid_argument("positions hold " + std::to_string(surface.positions.size()) +
                                " numbers, which is no multiple of 3: give x, y, z of each vertex");
  require_finite(surface.positions);
  const std::size_t n = surface.vertex_count();
  if (surface.offsets.empty()) {
    if (surface.corners.size() % 3 != 0)
      throw std::invalid_argument("there are " + std::to_string(surface.corners.size()) +
                                  " corners of triangles, which is no multiple of 3: give offsets for polygons");
  } else {
    if (surface.offsets.front() != 0 || static_cast<std::size_t>(surface.offsets.back()) != surface.corners.size())
      throw std::invalid_argument("the offsets of the faces run from " + std::to_string(surface.offsets.front()) +
                                  " to " + std::to_string(surface.offsets.back()) + ", but there are " +
                                  std::to_string(surface.corners.size()) + " corners");
    for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f)
      if (surface.offsets[f + 1] < surface.offsets[f])
        throw std::invalid_argument("the offsets of face " + std::to_string(f) + " decrease");
  }
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    for (Index v : surface.face(f))
      if (v < 0 || static_cast<std::size_t>(v) >= n)
        throw std::invalid_argument("face " + std::to_string(f) + " uses vertex " + std::to_string(v) +
                                    ", but there are " + std::to_string(n) + " vertices (counted from 0)");
}

void require_positions(const SurfaceView& surface, std::span<const double> positions) {
  if (positions.size() != surface.positions.size())
    throw std::invalid_argument("there are " + std::to_string(positions.size() / 3) + " positions for a surface of " +
                                std::to_string(surface.vertex_count()) + " vertices");
  require_finite(positions);
}

}  // namespace unsnarl
