#pragma once

#include <span>

#include "scene/diagnose.h"
#include "scene/prepared_surface.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// Fills displacement and its lower bound, untouched share, flipped triangles, volume and area change, edge stretch of
/// a report. `positions` and the surface's own are 3 n doubles.
void measure_change(const SurfaceView& surface, const PreparedSurface& prepared, const Diagnosis& diagnosis,
                    std::span<const double> positions, RepairReport& report);

/// Fills the list of components: those with pairs (of triangles) of their own in the input or in `left`.
void measure_components(const PreparedSurface& prepared, const Diagnosis& diagnosis,
                        const std::vector<IntersectingPair>& left, RepairReport& report);
/// Adds the obstruction that the pairs in `left` between two components are, if there are any.
void name_pairs_between_components(const PreparedSurface& prepared, const Diagnosis& diagnosis,
                                   const std::vector<IntersectingPair>& left, RepairReport& report);

/// Adds the obstruction of pieces of polygons that are left on the same three vertices by another cut than the input's.
void name_duplicates_by_other_cuts(std::span<const IntersectingPair> by_other_cuts, RepairReport& report);

}  // namespace unsnarl
