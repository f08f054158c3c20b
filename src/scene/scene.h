#pragma once

#include <cstdint>
#include <vector>

#include "contact/passing.h"
#include "geometry/types.h"
#include "mesh/adjacency.h"
#include "scene/solids.h"

namespace unsnarl {

/// The whole surface as the solvers see it: welded vertices, triangles, rest positions and current positions.
struct Scene {
  Positions rest;  ///< the input
  Positions x;     ///< now
  std::vector<Triangle> triangles;
  std::vector<Index> face_of;  ///< of each triangle the face of the input that it is a piece of; empty: each is one
  std::vector<std::uint8_t> fixed;  ///< one flag a vertex
  std::vector<Index> group_of;  ///< of each vertex: triangles of two groups pass through each other; empty: all meet
  std::vector<Index> part_of;   ///< of each triangle: its part in `parts`; empty: none passes through another
  const PassingParts* parts = nullptr;  ///< not owned
  Solids solids;                        ///< whose volumes are to be kept
  IndexLists triangles_of_vertex;
  IndexLists neighbours;  ///< of vertices, by edges

  Passing passing() const { return part_of.empty() ? Passing(group_of) : Passing(group_of, part_of, *parts); }
  Index vertex_count() const { return static_cast<Index>(rest.cols()); }
  Index triangle_count() const { return static_cast<Index>(triangles.size()); }
};

/// A scene at rest.
Scene make_scene(Positions rest, std::vector<Triangle> triangles, std::vector<std::uint8_t> fixed);
/// The same where the edges of the triangles (sorted) are known.
Scene make_scene(Positions rest, std::vector<Triangle> triangles, std::vector<std::uint8_t> fixed,
                 std::span<const Edge> edges);

}  // namespace unsnarl
