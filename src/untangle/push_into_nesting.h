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

/// Pushes nested surfaces that cross each other apart, the inner one in and the outer one out, however far that is:
/// each vertex on the wrong side goes halfway to the nearest point of the other surface whose normal is on the same
/// side as its own, and halfway beyond it by a margin (all the way where that cannot move), and so on until no faces of
/// the two cross, or their number has not fallen for LocalOptions::patience iterations. What crosses within one
/// surface, or is left to cross of a few faces, is for the strategies.
///
/// The margin is LocalOptions::margin of the mean edge at the vertex and doubles wherever faces cross still, up to half
/// an edge: without a bound, two layers that are closer to each other than an edge end eight diagonals away. (On eleven
/// scenes of two or three surfaces, margins and factors half and twice as large change the mean displacement by 2 % at
/// most.)
///
/// A component that crosses nothing of the other surface is let be, although it may lie on the wrong side.
/// `component_of_vertex`: of the scene; -1: an unused one. `stop`: true: leave it at that; may be empty.
PushResult push_into_nesting(Scene& scene, SceneIndex& index, std::span<const Index> component_of_vertex,
                             const NestedSurfaces& nested, const std::function<bool()>& stop = {});

}  // namespace unsnarl
