#include "samples/mesh_builder.h"

#include <utility>

namespace unsnarl {

Index MeshBuilder::add_vertex(const Vec3& position) {
  // Adding 0 turns -0.0 into +0.0, so that equal positions are equal bytes in every format.
  for (int k = 0; k < 3; ++k) surface_.positions.push_back(position[k] + 0.0);
  return static_cast<Index>(surface_.positions.size() / 3) - 1;
}

void MeshBuilder::add_face(std::initializer_list<Index> corners) {
  surface_.corners.insert(surface_.corners.end(), corners);
  surface_.offsets.push_back(static_cast<Index>(surface_.corners.size()));
}

void MeshBuilder::add_cell(Index a, Index b, Index c, Index d, FaceKind kind, bool other_diagonal) {
  if (kind == FaceKind::quads) {
    add_face({a, b, c, d});
  } else if (other_diagonal) {
    add_face({a, b, d});
    add_face({b, c, d});
  } else {
    add_face({a, b, c});
    add_face({a, c, d});
  }
}

void MeshBuilder::append(const SurfaceView& part, const Vec3& offset) {
  const auto first = static_cast<Index>(surface_.positions.size() / 3);
  for (std::size_t v = 0; v < part.vertex_count(); ++v)
    add_vertex(Vec3(part.positions[3 * v], part.positions[3 * v + 1], part.positions[3 * v + 2]) + offset);
  for (std::size_t f = 0; f < part.face_count(); ++f) {
    for (Index v : part.face(f)) surface_.corners.push_back(first + v);
    surface_.offsets.push_back(static_cast<Index>(surface_.corners.size()));
  }
}

Surface MeshBuilder::take() {
  std::vector<Index> renamed(surface_.positions.size() / 3, -1);
  for (Index v : surface_.corners) renamed[v] = 0;
  Index used = 0;
  for (std::size_t v = 0; v < renamed.size(); ++v) {
    if (renamed[v] < 0) continue;
    for (std::size_t k = 0; k < 3; ++k)
      surface_.positions[3 * static_cast<std::size_t>(used) + k] = surface_.positions[3 * v + k];
    renamed[v] = used++;
  }
  surface_.positions.resize(3 * static_cast<std::size_t>(used));
  bool all_triangles = true;
  for (Index& v : surface_.corners) v = renamed[v];
  for (std::size_t f = 0; f + 1 < surface_.offsets.size(); ++f)
    all_triangles &= surface_.offsets[f + 1] - surface_.offsets[f] == 3;
  if (all_triangles) surface_.offsets.clear();
  return std::exchange(surface_, Surface{{}, {}, {0}});
}

}  // namespace unsnarl
