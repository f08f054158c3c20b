#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "scene/patch.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Constants of solve_on_coarser_mesh(). h is the mean edge length of a level; a factor is a ratio of edge lengths.
struct CoarseToFineOptions {
  /// So many coarse meshes are solved, each coarser by `next_factor` than the one before, and the solution with the
  /// fewest pairs left, or else the nearest, is carried to the patch. 40 deep, warped and immersed surfaces: with one
  /// they end 4 % farther, with three as with two.
  int coarse_solutions = 2;
  double next_factor = 1.6;
  double least_faces = 200;  ///< of a coarse mesh
  double grid = 0x1p-20;     ///< h of the patch: positions of what comes back are rounded to about this
};

struct CoarseResult {
  bool clean = false;
  int iterations = 0;  ///< of the strategies that resolved something on the coarse mesh
  std::size_t pairs_left = 0;
};

/// Untangles a patch from coarse to fine. It is simplified until its edges are `factor` times as long, untangled and
/// recovered there, and then the removed vertices are put back round by round, each where the exact test finds no new
/// pair. After every round but the last, local strategies resolve what it brought, and a few steps of recovery make
/// room for the next. The cost follows the number of faces, however deep the tangle is. What is fixed is simplified too
/// (else its edge would keep the coarse mesh fine), and comes back to where it is. Pairs of active triangles count, but
/// the `tolerated` ones (of patch triangles, sorted). What cannot be resolved on the coarse mesh, or a patch that
/// cannot be simplified, stays where it is.
CoarseResult solve_on_coarser_mesh(Patch& patch, double factor, std::span<const IntersectingPair> tolerated,
                                   const std::function<bool()>& stop, const CoarseToFineOptions& options = {});

}  // namespace unsnarl
