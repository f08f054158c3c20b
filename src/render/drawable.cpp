#include "render/drawable.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/portable_math.h"
#include "mesh/adjacency.h"

namespace unsnarl {
namespace {

/// Corner normals: the area-weighted mean over the triangles around the vertex that are turned by less than 40 degrees,
/// whichever way they are oriented (the surface may not be orientable).
void smooth_normals(Drawable& drawable) {
  const double least_cosine = portable::cos(40 * EIGEN_PI / 180);
  const std::size_t n = drawable.triangles.size();
  std::vector<Vec3> areas(n), units(n);
  for (std::size_t t = 0; t < n; ++t) {
    const auto& [a, b, c] = drawable.triangles[t];
    const Vec3& p = drawable.positions[a];
    areas[t] = (drawable.positions[b] - p).cross(drawable.positions[c] - p);
    const double length = areas[t].norm();
    units[t] = length > 0 ? Vec3(areas[t] / length) : Vec3::Zero();
  }
  const IndexLists around = triangles_of_vertices(drawable.triangles, static_cast<Index>(drawable.positions.size()));
  drawable.normals.resize(n);
  for (std::size_t t = 0; t < n; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 sum = areas[t];
      for (Index other : around[drawable.triangles[t][k]]) {
        const double cosine = units[t].dot(units[other]);
        if (static_cast<std::size_t>(other) == t || std::abs(cosine) < least_cosine) continue;
        sum += std::copysign(1.0, cosine) * areas[other];
      }
      const double length = sum.norm();
      drawable.normals[t][k] = (length > 0 ? Vec3(sum / length) : units[t]).cast<float>();
    }
}

}  // namespace

Drawable make_drawable(const SurfaceView& surface, std::span<const Index> red, std::span<const SceneFile> files) {
  Drawable drawable;
  const std::size_t faces = surface.face_count();
  std::vector<std::uint8_t> face_is_red(faces, 0);
  for (Index f : red) {
    if (f < 0 || static_cast<std::size_t>(f) >= faces)
      throw std::invalid_argument("highlighted face " + std::to_string(f) + " is not one of the surface's " +
                                  std::to_string(faces) + " faces");
    face_is_red[f] = 1;
  }
  for (std::size_t v = 0; v < surface.vertex_count(); ++v)
    drawable.positions.emplace_back(surface.positions[3 * v], surface.positions[3 * v + 1],
                                    surface.positions[3 * v + 2]);
  std::vector<Index> file_of = file_of_faces(files);
  file_of.resize(faces, 0);
  std::vector<double> lengths;
  for (std::size_t f = 0; f < faces; ++f) {
    const auto corners = surface.face(f);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const Triangle t = {corners[0], corners[k], corners[k + 1]};
      const auto position = [&](std::size_t i) -> const Vec3& { return drawable.positions[t[i]]; };
      if (!position(0).allFinite() || !position(1).allFinite() || !position(2).allFinite()) continue;
      drawable.triangles.push_back(t);
      drawable.red.push_back(face_is_red[f]);
      drawable.file.push_back(file_of[f]);
      const int edges = (k == 1 ? 1 : 0) | 2 | (k + 2 == corners.size() ? 4 : 0);
      drawable.drawn_edges.push_back(static_cast<std::uint8_t>(edges));
      lengths.push_back((position(2) - position(1)).norm());
    }
  }
  if (!lengths.empty()) {
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    drawable.median_edge = *middle;
  }
  smooth_normals(drawable);
  return drawable;
}

}  // namespace unsnarl
