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

struct CoarseOptions {
  double factor = 3;  ///< edges of the first coarse mesh are so many times as long
  CoarseMeshes meshes = CoarseMeshes::until_solved;
  std::span<const Tier> on_coarse_mesh = {};  ///< strategies that untangle the coarse mesh
  std::span<const Tier> on_small_mesh = {};   ///< those for what vertices that come back have brought, and on
  std::span<const Tier> on_large_mesh = {};   ///< meshes of many faces
};

/// Untangles a patch from coarse to fine, by the untangler of its task. It is simplified until its edges are
/// `options.factor` times as long, untangled there (by strategies that may be this one, so that what others leave is
/// solved on a mesh coarser still, down to a handful of faces), and recovered. Then the removed vertices are put back
/// round by round, each where the exact test finds no new pair. After every round but the last, strategies resolve what
/// it brought, and a few steps of recovery make room for the next. The cost follows the number of faces, however deep
/// the tangle is. What is fixed is simplified too (else its edge would keep the coarse mesh fine), and comes back to
/// where it is. Pairs of active triangles count, but the task's `tolerated` ones. A patch of which too many pairs are
/// left on the coarse mesh, or that cannot be simplified, stays where it is.
CoarseResult solve_on_coarser_mesh(Patch& patch, const Task& task, const CoarseOptions& options);

}  // namespace unsnarl
