#pragma once

#include <optional>
#include <vector>

#include "contact/intersection_finder.h"
#include "repair/diagnose.h"
#include "repair/face_pairs.h"
#include "repair/prepared_surface.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// Says what positions of a surface are worth against its input. What it is given must outlive it.
class Judge {
 public:
  Judge(const PreparedSurface& prepared, const Diagnosis& diagnosis, const RepairOptions& options);

  struct Pairs {
    std::vector<IntersectingPair> triangles;  ///< sorted
    PairCounts faces;
    bool by_other_diagonals = false;  ///< some faces intersect for other diagonals than those that were cut along
  };
  Pairs pairs_at(const Positions& x);

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
  IntersectionFinder finder_;
  std::optional<FacePairFinder> any_cut_;
  Pairs before_;
};

}  // namespace unsnarl
