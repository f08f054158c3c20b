#pragma once

#include "energy/orientation_penalty.h"
#include "mesh/adjacency.h"
#include "recover/embedding_guard.h"
#include "scene/patch.h"

namespace unsnarl {

/// Active faces that are flipped against their rest shape.
std::vector<Index> flipped_faces(const Patch& patch, const OrientationPenalty& orientation);

/// Unflips active faces: gives the free vertices around each, over growing rings up to `max_rings`, displacements from
/// rest that are smooth between those of the vertices beyond, so that the faces lie there as at rest. Kept where the
/// exact guard finds no new pair and fewer faces are flipped. Returns how many faces were unflipped.
Index unflip_faces(Patch& patch, const IndexLists& neighbours, const OrientationPenalty& orientation,
                   EmbeddingGuard& guard, int max_rings);

}  // namespace unsnarl
