#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scene/nested_surfaces.h"
#include "scene/scene.h"
#include "scene/scene_index.h"

namespace unsnarl {

/// On eleven scenes of two or three surfaces, two of them with the outer one held, half, twice or four times the first
/// two numbers change the mean displacement by 2 % at most.
struct PushOptions {
  /// How far inside or outside of the other surface a vertex is pushed at first: a share of the mean edge at it.
  double margin = 0.05;
  double growth = 1.5;  ///< factor of the margin where faces cross still, after each iteration
  /// Share of the mean edge that the margin grows to at most. Without a bound two layers that are closer to each other
  /// than an edge end eight diagonals away.
  double most_margin = 0.5;
  int max_iterations = 30;
  std::function<bool()> stop;  ///< true: leave it at that; may be empty
};

struct PushResult {
  std::vector<Index> moved;  ///< vertices, ascending; none: all was in order, or nothing could be done
  int iterations = 0;
};

/// Pushes nested surfaces that cross each other apart, the inner one in and the outer one out, however far that is:
/// each vertex on the wrong side goes halfway to the nearest point of the other surface and a margin beyond it (all the
/// way where that cannot move), and so on until none is on the wrong side and no faces of the two cross. What crosses
/// within one surface, or is left to cross of a few faces, is for the strategies.
///
/// A component that crosses nothing of the other surface is let be, although it may lie on the wrong side.
/// `component_of_vertex`: of the scene; -1: an unused one.
PushResult push_into_nesting(Scene& scene, SceneIndex& index, std::span<const Index> component_of_vertex,
                             const NestedSurfaces& nested, const PushOptions& options = {});

}  // namespace unsnarl
