#pragma once

#include <array>
#include <vector>

#include "unsnarl/link.h"

namespace unsnarl {

/// A crossing: the four edges around it, counter-clockwise from the one that arrives below.
using PlanarCode = std::vector<std::array<int, 4>>;

/// The link of a planar diagram code in space: the diagram drawn in the plane z = 0 by Tutte's embedding, with the
/// strands above and below it where they cross. Throws FileError, naming the crossing or the edge, for a code that is
/// of no planar diagram.
Link lay_out(const PlanarCode& code);

}  // namespace unsnarl
