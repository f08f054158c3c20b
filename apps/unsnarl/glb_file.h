#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "unsnarl/surface.h"

namespace unsnarl::app {

/// A new binary glTF of the surface, in 32-bit numbers, faces cut into triangles from their first corner: a node with a
/// mesh of its own for each part. part_of: of each face, from 0; names: of the parts, at least one a part.
std::string glb_file(const SurfaceView& surface, std::span<const std::int32_t> part_of,
                     const std::vector<std::string>& names, const std::string& generator);

}  // namespace unsnarl::app
