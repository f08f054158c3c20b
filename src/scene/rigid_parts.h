#pragma once

#include <string>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// The parts of a surface that move as bodies.
struct RigidParts {
  std::vector<Index> of_vertex;  ///< the part of each welded vertex, or -1; empty: no part is rigid
  Index count = 0;
  std::vector<std::string> names;  ///< of the first of them

  /// The name of a part; its number where it has none.
  std::string name(Index part) const {
    const auto p = static_cast<std::size_t>(part);
    return p < names.size() ? names[p] : std::to_string(part);
  }
};

}  // namespace unsnarl
