#pragma once

#include <functional>

#include "scene/prepared_surface.h"

namespace unsnarl::peers {

/// Goes back from an embedded state towards rest with the product's recovery in the paper's variant (the "reverse flow"
/// of Minarčík et al., §3.4); in place.
void recover_towards_rest(const PreparedSurface& prepared, Positions& x, const std::function<bool()>& stop);

}  // namespace unsnarl::peers
