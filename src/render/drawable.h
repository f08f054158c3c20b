#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// A surface made ready for drawing.
struct Drawable {
  static constexpr Index grey = -1;  ///< Stands for the file of triangles that have no colour of their own
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;  ///< fans of the polygons; those with non-finite corners are left out
  std::vector<std::array<Eigen::Vector3f, 3>> normals;  ///< of the corners, smooth except across creases
  std::vector<std::uint8_t> drawn_edges;  ///< bit k: the edge from corner k to k + 1 is an edge of the polygon
  std::vector<std::uint8_t> red;          ///< 1: highlighted
  std::vector<Index> file;                ///< number of the triangle's file, or `grey`
  double median_edge = 0;                 ///< length of the polygons' edges
};

/// `files`: that the surface is of; empty: one. Throws std::invalid_argument where `red` names a face that the surface
/// does not have.
Drawable make_drawable(const SurfaceView& surface, std::span<const Index> red, std::span<const SceneFile> files = {});

}  // namespace unsnarl
