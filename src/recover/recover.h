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
/// Measured on one core of a loaded machine: 20 to 60 ms for 100 to 200 free vertices, 0.3 s for 400 with a deep
/// tangle, 2 s for a component of 28k vertices.
///
/// Opens gaps, takes a few steps, snaps to rest what can reach it, steps on with the others, snaps again.
/// \pre patch.x has no intersecting pair with an active triangle, in any class. Pairs that are there are tolerated and
/// never become more.
/// Guarantees: no new pair; no face flips against its rest shape in a step, unless filter_step does not settle (not
/// seen so far), and those that were flipped are pulled back; in a step a stencil keeps `min_gap` or half its distance,
/// whichever is less, and those that end closer than min_gap are opened, unless they are hemmed in (neighbours that are
/// closer at rest need a share of their rest distance only); free vertices that can reach their rest
/// positions are bit-exactly there; what is closer than round-off to something stays where it is while others step, and
/// so does all where most edges are shorter than that; the same bytes at any number of threads. `stop` is asked once a
/// step; what was reached by then is kept.
RecoverResult recover(Patch& patch, const RecoverOptions& options = {}, const std::function<bool()>& stop = {});

}  // namespace unsnarl
