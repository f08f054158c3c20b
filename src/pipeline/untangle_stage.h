#pragma once

#include "pipeline/repair_state.h"
#include "scene/finders.h"

namespace unsnarl {

/// Moves the scene from rest to the start that the task names, if it names one, and untangles it with as little motion
/// from there as may be. The recovery then takes what is not at rest. `finders`: of the scene's triangles.
void start_stage(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state);

/// Untangles the scene, recovers it toward rest and rounds it to the digits of the result, again where rounding brought
/// intersections. Where float32 was not asked for and no way is found to hold in it, float64 has to do. `finders`: of
/// the scene's triangles.
void untangle_stage(const RepairTask& task, const RepairControl& control, Finders& finders, RepairState& state);

/// At rest, is there anything to untangle or to round?
bool has_work(const RepairTask& task, Finders& finders, const RepairState& state);

/// Puts sets of vertices that went farther than allowed back to rest. `finder`: of the triangles of the input's cut.
void keep_within_displacement(const RepairTask& task, IntersectionFinder& finder, RepairState& state);

}  // namespace unsnarl
