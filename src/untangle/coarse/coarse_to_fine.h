#pragma once

#include <cstddef>
#include <span>

#include "scene/patch.h"
#include "untangle/strategy.h"

namespace unsnarl {

struct CoarseResult {
  std::size_t pairs_left = 0;  ///< in patch.x
  int iterations = 0;          ///< of the strategies that resolved something on coarse meshes
};

/// How many coarse meshes are tried.
enum class CoarseMeshes {
  one,
  /// Coarser and coarser ones, each from several starts, of which the nearest solution is carried on, the coarsest from
  /// many, until fewer pairs are left on the patch.
  until_solved,
};

/// Numbers in brackets: docs/experiments.md.
struct CoarseOptions {
  /// Edges of the first coarse mesh are so many times as long as the patch's (no unit)
  double factor = 3;
  CoarseMeshes meshes = CoarseMeshes::until_solved;
  std::span<const Tier> on_coarse_mesh = {};  ///< strategies that untangle the coarse mesh
  std::span<const Tier> on_small_mesh = {};   ///< those for what vertices that come back bring on a small mesh
  std::span<const Tier> on_large_mesh = {};   ///< the same on a mesh of more than most_faces_for_all faces

  /// A coarse mesh that keeps a larger share of its pairs is not carried to the fine one [E143] (no unit)
  double carried_share = 0.1;
  /// The way back is given up on a mesh that keeps more than this share of the patch's [E51] (no unit)
  double way_back_share = 0.7;
  /// No coarser mesh is tried after one that left no more than this share of the patch's [E144] (no unit)
  double solved_share = 0.7;
  /// On_small_mesh is for coarse meshes of so many at most [E64] (unit: faces, obstacles included)
  std::size_t most_faces_for_all = 4000;
  /// Far parts are tried again from rest on coarse meshes of so many at most [E59, E61] (unit: faces, obstacles
  /// included)
  std::size_t most_faces_to_retry = 4000;
  /// Parts that have at least this share of it all are tried again [E124, E145] (no unit)
  double least_motion_share = 0.1;
  /// Number of starts of each coarse mesh, with `until_solved` [E47, E48] (unit: starts)
  int starts = 3;
  /// These starts differ at random by so much at each coordinate, at most [E47, E48] (unit: mean edges of the coarse
  /// mesh)
  double start_distance = 0.2;
  /// Number of starts of the coarsest mesh, farther and farther away [E146] (unit: starts)
  int coarsest_starts = 30;
};

/// Untangles a patch from coarse to fine, by the untangler of its task.
///
/// 1. It is simplified until its edges are `options.factor` times as long; what is fixed is simplified too.
/// 2. The coarse mesh is untangled, by strategies that may be this one, so that what others leave is solved on a mesh
///    coarser still, down to a handful of faces; and recovered.
/// 3. The removed vertices come back round by round, each where the exact test finds no new pair. After every round but
///    the last, strategies resolve what it brought, and a few steps of recovery make room for the next [E232].
///
/// The cost follows the number of faces, however deep the tangle is. Pairs of active triangles count, but for the
/// task's `tolerated` ones. A patch of which too many pairs are left, or that cannot be simplified, stays where it is.
CoarseResult solve_on_coarser_mesh(Patch& patch, const Task& task, const CoarseOptions& options);

}  // namespace unsnarl
