#pragma once

#include <optional>
#include <vector>

#include "scene/diagnose.h"
#include "scene/face_pairs.h"
#include "scene/finders.h"
#include "scene/prepared_surface.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// The acceptance test: compares positions of a surface with its input. Its arguments must outlive it.
class Acceptance {
 public:
  /// `finders`: of the prepared triangles.
  Acceptance(const PreparedSurface& prepared, const Diagnosis& diagnosis, const RepairOptions& options,
             Finders& finders);

  struct Pairs {
    std::vector<IntersectingPair> triangles;  ///< sorted
    std::vector<IntersectingPair> of_faces;   ///< sorted
    PairCounts faces;
    bool by_other_diagonals = false;  ///< some faces intersect only along the other diagonals of quads
  };
  Pairs pairs_at(const Positions& x);
  /// No two faces intersect once the positions are rounded to float32.
  bool is_embedded_in_float32(const Positions& x);

  /// A pair of the input that need not be resolved: an obstruction, of a class that the goal leaves out, or between
  /// components that are repaired one by one.
  bool is_tolerated(const IntersectingPair& pair) const;
  /// More pairs than the input, in total or of disjoint faces.
  bool is_worse(const Pairs& pairs) const;
  /// embedded, obstructed, reduced or no_progress.
  Status status(const Pairs& pairs, const Positions& x) const;

 private:
  const PreparedSurface& prepared_;
  const Diagnosis& diagnosis_;
  const RepairOptions& options_;
  Finders& finders_;
  std::optional<FacePairFinder> any_diagonal_;
  Pairs before_;
};

}  // namespace unsnarl
