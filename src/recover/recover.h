#pragma once

#include <functional>

#include "recover/recover_options.h"
#include "scene/patch.h"

namespace unsnarl {

struct RecoverResult {
  int iterations = 0;         ///< Newton steps
  int solver_iterations = 0;  ///< PCG iterations in all
  double min_gap = 0;         ///< least distance of a contact stencil of the active faces (infinite: none is near)
  Index closed = 0;           ///< stencils whose gap could not be opened to what was wanted
  Index at_rest = 0;          ///< free vertices that are bit-exactly at rest
  bool moved = false;         ///< any vertex is elsewhere than at the start
  bool stopped = false;       ///< by the caller
};

/// Moves the free vertices of an embedded patch back toward rest, as near as contact allows, without ever leaving the
/// embedded set (paper §3.4, eq. 12; barrier and step filter after Incremental Potential Contact).
///
/// In order: gaps are opened; Newton steps move all free vertices; vertices that can reach rest snap there; flipped
/// faces are turned over; Newton steps move the others on; vertices snap again. \pre patch.x has no intersecting pair
/// with an active triangle, in any class. Pairs that are there nevertheless are tolerated, and none is added.
/// Guarantees:
/// - No new intersecting pair.
/// - No step flips a face against its rest shape. Faces that were flipped before are pulled back.
/// - A step leaves a stencil min_gap or half its distance, whichever is less. Stencils that end closer than min_gap are
///   opened as far as there is room. Neighbours that are closer at rest need only a share of their rest distance.
/// - Free vertices that can reach their rest positions are bit-exactly there.
/// - Vertices that are closer to something than round-off do not move while others step. Where most edges are shorter
///   than that, no vertex moves.
/// - The same bytes at any number of threads.
/// `stop` is asked once a step; true ends the recovery at the state reached so far.
RecoverResult recover(Patch& patch, const RecoverOptions& options = {}, const std::function<bool()>& stop = {});

}  // namespace unsnarl
