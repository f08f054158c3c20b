#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scene/nested_surfaces.h"
#include "scene/scene.h"
#include "scene/scene_index.h"

namespace unsnarl {

struct PushResult {
  std::vector<Index> moved;  ///< vertices, ascending; none: all was in order, or nothing could be done
  int iterations = 0;
};

/// Pushes nested surfaces that cross each other apart, the inner one in and the outer one out, however far that is.
/// Each vertex on the wrong side goes half the way to the nearest point of the other surface whose normal is on the
/// same side as its own, and half the way beyond it by a margin (all the way if that cannot move). This is repeated
/// until no faces of the two cross, or their number no longer falls. The margin doubles wherever faces still cross, up
/// to half an edge: without a bound, layers closer to each other than an edge would be thrown far apart. What crosses
/// within one surface, or is left to cross of a few faces, is for the strategies.
///
/// A component that crosses nothing of the other surface stays, although it may lie on the wrong side.
/// `component_of_vertex`: of the scene; -1: an unused one. `stop`: true: leave it at that; may be empty.
PushResult push_into_nesting(Scene& scene, SceneIndex& index, std::span<const Index> component_of_vertex,
                             const NestedSurfaces& nested, const std::function<bool()>& stop = {});

}  // namespace unsnarl
