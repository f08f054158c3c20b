#pragma once

#include <cstdint>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// The vertices of a patch that move in a stage of the recovery, numbered as unknowns.
struct MovingVertices {
  std::vector<std::uint8_t> moves;  ///< per vertex
  std::vector<Index> vertices;      ///< unknown -> vertex, ascending
  std::vector<Index> slot;          ///< vertex -> unknown or -1

  MovingVertices() = default;
  explicit MovingVertices(std::vector<std::uint8_t> which) : moves(std::move(which)), slot(moves.size(), -1) {
    for (std::size_t v = 0; v < moves.size(); ++v) {
      if (!moves[v]) continue;
      slot[v] = static_cast<Index>(vertices.size());
      vertices.push_back(static_cast<Index>(v));
    }
  }
  Index count() const { return static_cast<Index>(vertices.size()); }
};

}  // namespace unsnarl
