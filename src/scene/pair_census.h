#pragma once

#include <optional>
#include <vector>

#include "scene/face_pairs.h"
#include "scene/finders.h"
#include "scene/prepared_surface.h"
#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Counts the intersecting pairs of a surface at positions reached by a repair, as its file will be read: with polygons
/// triangulated as in the input, and as a program that reads the result triangulates them. Its arguments must outlive
/// it.
class PairCensus {
 public:
  struct Pairs {
    std::vector<IntersectingPair> triangles;      ///< of the input's cut, sorted
    std::vector<IntersectingPair> of_faces;       ///< by any cut that counts, sorted
    std::vector<IntersectingPair> by_other_cuts;  ///< of these: not by the input's cut
    PairCounts faces;                             ///< of of_faces

    /// More pairs than `other`, in total or of disjoint faces, by the input's cut or by any.
    bool are_more_than(const Pairs& other) const;
  };

  /// `finders`: of the prepared triangles. `at_rest`: the pairs of these at prepared.rest.
  PairCensus(const SurfaceView& surface, const PreparedSurface& prepared, const FindOptions& options, Finders& finders,
             std::vector<IntersectingPair> at_rest);

  const Pairs& before() const { return before_; }
  Pairs at(const Positions& x);
  /// The pairs of faces that are allowed, by any cut; no other function here counts them.
  PairCounts allowed_at(const Positions& x) const;
  /// Pairs of faces by any cut once the positions are rounded to float32; `x` must fit into it (fits_float32).
  std::vector<IntersectingPair> in_float32(const Positions& x);
  /// No two faces intersect once the positions are rounded to float32.
  bool is_embedded_in_float32(const Positions& x);

 private:
  Pairs of(std::vector<IntersectingPair> triangles, const Positions& x);
  std::vector<IntersectingPair> by_other_cuts(const Positions& x);
  std::optional<PreparedSurface> as_read(const Positions& x) const {
    return cut_anew(surface_, prepared_, options_, prepared_.scatter(surface_.positions, x));
  }

  const SurfaceView surface_;
  const PreparedSurface& prepared_;
  const FindOptions& options_;
  Finders& finders_;
  std::optional<FacePairFinder> any_diagonal_;
  Pairs before_;
};

}  // namespace unsnarl
