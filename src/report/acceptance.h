#pragma once

#include <optional>
#include <vector>

#include "scene/diagnose.h"
#include "scene/face_pairs.h"
#include "scene/finders.h"
#include "scene/prepared_surface.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// Says what positions of a surface are worth against its input. What it is given must outlive it.
class Acceptance {
 public:
  /// `finders`: of the prepared triangles.
  Acceptance(const PreparedSurface& prepared, const Diagnosis& diagnosis, const RepairOptions& options,
             Finders& finders);

  struct Pairs {
    std::vector<IntersectingPair> triangles;  ///< sorted
    std::vector<IntersectingPair> of_faces;   ///< sorted
    PairCounts faces;
    bool by_other_diagonals = false;  ///< some faces intersect for other diagonals than those that were cut along
  };
  Pairs pairs_at(const Positions& x);
  /// No two faces intersect once the positions are rounded to float32.
  bool is_embedded_in_float32(const Positions& x);

  /// A pair of the input that is not to be resolved: an obstruction, of a class or between components that do not
  /// count.
  bool is_set_aside(const IntersectingPair& pair) const;
  /// More pairs than the input, in all or of disjoint faces.
  bool is_worse(const Pairs& pairs) const;
  /// embedded, obstructed, reduced or no_progress.
  Status status(const Pairs& pairs, const Positions& x) const;

 private:
  const PreparedSurface& prepared_;
  const Diagnosis& diagnosis_;
  const RepairOptions& options_;
  Finders& finders_;
  std::optional<FacePairFinder> any_cut_;
  Pairs before_;
};

}  // namespace unsnarl
