#pragma once

#include <vector>

#include "mesh/progressive_mesh.h"
#include "scene/patch.h"

namespace unsnarl {

/// Whether the corners of a triangle are at the same places in both.
bool is_at(const Triangle& t, const Positions& x, const Positions& other);

/// Places the vertices of a round that come back to a mesh simplified from a patch, each at the first of its places
/// where its star is in no new pair by the exact test: where the fan carries the vertex from rest, with less and less
/// of its offset from there; points of the fan closer and closer to the parent; and directions in which it may
/// leave the parent. Fixed vertices come back to where they are. A vertex that finds no place stays where its star is
/// in the fewest pairs.
///
/// `mesh`: as mesh.refine() has left it; `removals`: what that returned. `x` holds the positions of the patch's
/// vertices. Returns the removals of vertices that are elsewhere than at their best places.
std::vector<ProgressiveMesh::Removal> insert_vertices(const Patch& patch, const ProgressiveMesh& mesh,
                                                      const std::vector<ProgressiveMesh::Removal>& removals,
                                                      Positions& x);

/// Moves vertices that insert_vertices() had to displace to where their fans carry them, or half the way, where that
/// brings no pair. To be called once a recovery has made room.
void offer_better_places(const Patch& patch, const ProgressiveMesh& mesh,
                         const std::vector<ProgressiveMesh::Removal>& displaced, Positions& x);

}  // namespace unsnarl
