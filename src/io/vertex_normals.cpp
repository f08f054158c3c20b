#include "io/vertex_normals.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

namespace unsnarl {
namespace {

using Eigen::Vector3d;

Vector3d vertex(std::span<const double> positions, std::int32_t v) {
  return Eigen::Map<const Vector3d>(positions.data() + 3 * static_cast<std::size_t>(v));
}

/// Twice the area times the normal.
Vector3d area_vector(std::span<const double> positions, std::span<const std::int32_t> face) {
  const Vector3d origin = vertex(positions, face[0]);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 2; k < face.size(); ++k)
    sum += (vertex(positions, face[k - 1]) - origin).cross(vertex(positions, face[k]) - origin);
  return sum;
}

/// Properties of the faces that use a normal.
struct Use {
  Vector3d before = Vector3d::Zero(), after = Vector3d::Zero();
  std::int32_t vertex = -1;
  bool by_several_vertices = false, by_moved = false, by_unmoved = false;
};

}  // namespace

std::vector<double> turned_normals(const SurfaceView& before, std::span<const double> after,
                                   std::span<const double> normals, std::span<const std::int32_t> normal_of_corner) {
  std::vector<Use> uses(normals.size() / 3);
  std::size_t corner = 0;
  for (std::size_t f = 0; f < before.face_count(); ++f) {
    const std::span<const std::int32_t> face = before.face(f);
    const bool moved = std::any_of(face.begin(), face.end(),
                                   [&](std::int32_t v) { return vertex(before.positions, v) != vertex(after, v); });
    const Vector3d area_before = area_vector(before.positions, face), area_after = area_vector(after, face);
    for (const std::int32_t v : face) {
      const std::int32_t n = normal_of_corner[corner++];
      if (n < 0) continue;
      Use& use = uses[static_cast<std::size_t>(n)];
      use.before += area_before;
      use.after += area_after;
      (moved ? use.by_moved : use.by_unmoved) = true;
      use.by_several_vertices |= use.vertex >= 0 && use.vertex != v;
      use.vertex = v;
    }
  }
  std::vector<double> result(normals.begin(), normals.end());
  for (std::size_t n = 0; n < uses.size(); ++n) {
    const Use& use = uses[n];
    if (!use.by_moved || (use.by_several_vertices && use.by_unmoved)) continue;
    if (use.before.isZero(0) || use.after.isZero(0)) continue;
    Eigen::Map<Vector3d> normal(result.data() + 3 * n);
    normal = (Eigen::Quaterniond::FromTwoVectors(use.before, use.after) * normal).eval();
  }
  return result;
}

}  // namespace unsnarl
