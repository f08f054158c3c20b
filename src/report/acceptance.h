#pragma once

#include <optional>
#include <vector>

#include "scene/diagnose.h"
#include "scene/face_pairs.h"
#include "scene/finders.h"
#include "scene/prepared_surface.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// The acceptance test: compares positions of a surface with its input. Polygons count as the input is cut and as a
/// program cuts them that reads the result. Its arguments must outlive it.
class Acceptance {
 public:
  /// `finders`: of the prepared triangles.
  Acceptance(const SurfaceView& surface, const PreparedSurface& prepared, const Diagnosis& diagnosis,
             const RepairOptions& options, Finders& finders);

  struct Pairs {
    std::vector<IntersectingPair> triangles;      ///< of the input's cut, sorted
    std::vector<IntersectingPair> of_faces;       ///< by any cut that counts, sorted
    std::vector<IntersectingPair> by_other_cuts;  ///< of these: not by the input's cut
    PairCounts faces;
  };
  Pairs pairs_at(const Positions& x);
  /// No two faces intersect once the positions are rounded to float32.
  bool is_embedded_in_float32(const Positions& x);

  /// A pair of the input that need not be resolved: an obstruction, of a class that the goal leaves out, or between
  /// components that are repaired each as if alone.
  bool is_tolerated(const IntersectingPair& pair) const;
  /// Why a pair of faces that meets by another cut alone need not be resolved, if that is so. No motion parts two
  /// triangles on the same three vertices.
  std::optional<LeftReason> tolerance_by_other_cuts(const IntersectingPair& pair) const;
  /// More pairs than the input, in total or of disjoint faces.
  bool is_worse(const Pairs& pairs) const;
  /// embedded, obstructed, reduced or no_progress. Where float32 was asked for, embedded means in float32 too.
  Status status(const Pairs& pairs, const Positions& x);

 private:
  std::vector<IntersectingPair> pairs_by_other_cuts(const Positions& x);
  /// Pairs of faces by any cut once the positions are rounded to float32.
  std::vector<IntersectingPair> pairs_in_float32(const Positions& x);

  const SurfaceView surface_;
  const PreparedSurface& prepared_;
  const Diagnosis& diagnosis_;
  const RepairOptions& options_;
  Finders& finders_;
  std::optional<FacePairFinder> any_diagonal_;
  Pairs before_;
};

}  // namespace unsnarl
