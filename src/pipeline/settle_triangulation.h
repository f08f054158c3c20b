#pragma once

#include "pipeline/job.h"
#include "pipeline/scene_repair.h"
#include "scene/finders.h"

namespace unsnarl {

/// Whoever reads the result, a second run among them, cuts its polygons by its own positions. Where that cut
/// intersects, work goes on until it and the input's both hold: on both at once or, as long as no way is found to that,
/// on the one and the other in turn. Quads along either diagonal, if both count. Components on which something is left,
/// or for which no way is found, are let be. `finders`: of the triangles of the scene, which are those of the input's
/// cut.
void settle_triangulation(SceneRepair& repair, const Job& job, Finders& finders);

}  // namespace unsnarl
