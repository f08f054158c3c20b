#pragma once

#include <span>
#include <vector>

#include "contact/face_tree.h"
#include "energy/minkowski_penalty.h"
#include "mesh/adjacency.h"
#include "scene/patch.h"
#include "unsnarl/intersections.h"
#include "untangle/local/sheet_motion.h"

namespace unsnarl {

/// The Minkowski penalty (paper §3.2) of all pairs of a patch's triangles within a margin of each other
/// that do not pass through each other.
class PenaltyForce {
 public:
  /// `margin`: a length. The patch must outlive this.
  PenaltyForce(const Patch& patch, double margin);
  void set_margin(double margin);
  /// Adds the force on each vertex at x.
  void add(const Positions& x, Positions& force);
  const MinkowskiPenalty& penalty() const { return penalty_; }

 private:
  void gather_sorted(const std::vector<std::vector<MinkowskiPenalty::Pair>>& lists);

  std::span<const Triangle> triangles_;
  Passing passing_;
  double margin_;
  std::vector<Index> ends_;  // of the pairs of each first triangle
  MinkowskiPenalty penalty_;
  FaceTree tree_;
};

/// Depth of the deepest of these pairs, a length, without any margin.
double deepest_overlap(const Patch& patch, const Positions& x, std::span<const IntersectingPair> pairs);

/// Adds a force that pushes the two sheets of every intersection curve apart, and pairs without a curve by `penalty`.
void add_contour_force(const Patch& patch, const Positions& x, const EdgeTable& edges,
                       std::span<const IntersectingPair> pairs, const MinkowskiPenalty& penalty, SheetMotion motion,
                       Positions& force);

}  // namespace unsnarl
