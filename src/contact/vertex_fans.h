#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/adjacency.h"

namespace unsnarl {

/// The triangles around each vertex (its fan), and which fans are unfolded: seen along a coordinate axis, the triangles
/// follow one another around the vertex within one turn, and none is turned over or without area. Two triangles of an
/// unfolded fan meet only in the hull of the vertices they share, since their projections lie in sectors around the
/// vertex that share at most a ray. Decided exactly, much faster than by testing every pair.
class VertexFans {
 public:
  /// Fans of the vertices of the triangles [0, active_count). Those that are no single fan of consistent orientation,
  /// and those of many triangles, never count as unfolded.
  VertexFans(std::span<const Triangle> triangles, Index active_count, Index vertex_count);

  /// Takes over the positions. Parallel.
  void update(const Positions& x);

  /// Whether all triangles at v meet but in the hull of what they share; as of the last update.
  bool is_unfolded(Index v) const { return unfolded_[v] != 0; }
  std::span<const Index> triangles_at(Index v) const { return triangles_at_[v]; }  ///< ascending

 private:
  void update_vertex(const Positions& x, Index v);

  IndexLists triangles_at_;
  /// The neighbours of each vertex in their order around it; the first again at the end where its fan is closed. Empty:
  /// no fan.
  IndexLists around_;
  std::vector<std::uint8_t> axis_;  // along which the fan is looked at first
  std::vector<std::uint8_t> unfolded_;
};

}  // namespace unsnarl
