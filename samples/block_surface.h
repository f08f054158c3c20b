#pragma once

#include <array>
#include <functional>
#include <vector>

#include "samples/mesh_builder.h"

namespace unsnarl {

/// A unit cube of a lattice: [x, x + 1] x [y, y + 1] x [z, z + 1].
using Block = std::array<int, 3>;

/// The closed surface around a union of blocks, each face of a block cut into divisions^2 cells, rounded off by
/// averaging over neighbours until corners have a radius of about `roundness` blocks. Blocks that touch along an edge
/// or at a corner only would give a non-manifold surface: the caller avoids them. `keep`: of the faces of blocks, by
/// their middle, those that are part of the surface, which is open elsewhere; empty: all.
Surface sample_blocks(const std::vector<Block>& blocks, int divisions, FaceKind faces, double roundness = 0.5,
                      const std::function<bool(const Vec3& middle)>& keep = {});

}  // namespace unsnarl
