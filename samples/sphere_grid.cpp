#include "samples/sphere_grid.h"

#include <array>
#include <map>
#include <numbers>

#include "geometry/portable_math.h"
#include "geometry/rotation.h"

namespace unsnarl {
namespace {

using LatticePoint = std::array<int, 3>;

/// Even spacing by angle rather than along the edge of the cube: cells then differ in area by less than a factor of
/// two.
double by_angle(int i, int n) {
  return portable::tan((2.0 * i / n - 1) * std::numbers::pi / 4);
}

Vec3 direction_of(const LatticePoint& p, int n) {
  static const Eigen::Matrix3d turn =
      rotation_about(Vec3::UnitX(), 0.61) * rotation_about(Vec3::UnitY(), 0.37) * rotation_about(Vec3::UnitZ(), 0.23);
  return turn * Vec3(by_angle(p[0], n), by_angle(p[1], n), by_angle(p[2], n)).normalized();
}

Surface sample_cube(int n, FaceKind faces, bool antipodes_are_one, const DirectionMap& f) {
  MeshBuilder builder;
  std::map<LatticePoint, Index> known;
  const auto vertex = [&](LatticePoint p) {
    const LatticePoint opposite = {n - p[0], n - p[1], n - p[2]};
    if (antipodes_are_one && opposite < p) p = opposite;
    const auto [entry, is_new] = known.try_emplace(p, 0);
    if (is_new) entry->second = builder.add_vertex(f(direction_of(p, n)));
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side <= 1; ++side) {
      if (antipodes_are_one && side == 0) continue;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int a, int b) {
            LatticePoint p{};
            p[axis] = side * n;
            p[(axis + 1) % 3] = a;
            p[(axis + 2) % 3] = b;
            return vertex(p);
          };
          const Index a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
          const bool flip = (i + j) % 2 != 0;
          if (side == 1)
            builder.add_cell(a, b, c, d, faces, flip);
          else
            builder.add_cell(a, d, c, b, faces, flip);
        }
    }
  return builder.take();
}

}  // namespace

Surface sample_sphere(int n, FaceKind faces, const DirectionMap& f) {
  return sample_cube(n, faces, false, f);
}

Surface sample_projective_plane(int n, FaceKind faces, const DirectionMap& f) {
  return sample_cube(n, faces, true, f);
}

}  // namespace unsnarl
