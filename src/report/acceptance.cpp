#include "report/acceptance.h"

#include <algorithm>

#include "mesh/areas.h"

namespace unsnarl {

Acceptance::Acceptance(const PreparedSurface& prepared, const Diagnosis& diagnosis, const RepairOptions& options,
                       Finders& finders)
    : prepared_(prepared), diagnosis_(diagnosis), options_(options), finders_(finders) {
  if (!prepared.other_diagonals.triangles.empty()) any_diagonal_.emplace(prepared);
  before_ = pairs_at(prepared.rest);
}

Acceptance::Pairs Acceptance::pairs_at(const Positions& x) {
  Pairs pairs;
  pairs.triangles = x == prepared_.rest ? diagnosis_.pairs : finders_.as_is.find(x);
  pairs.of_faces = pairs_of_faces(prepared_.triangulation.polygon, pairs.triangles);
  if (any_diagonal_) {
    std::vector<IntersectingPair> of_any_diagonal = any_diagonal_->find(x);
    pairs.by_other_diagonals = of_any_diagonal.size() > pairs.of_faces.size();
    pairs.of_faces = std::move(of_any_diagonal);
  }
  pairs.faces = count_by_class(pairs.of_faces);
  return pairs;
}

bool Acceptance::is_embedded_in_float32(const Positions& x) {
  if (!fits_float32(x)) return false;
  return any_diagonal_ ? any_diagonal_->find(rounded_to_float32(x)).empty() : finders_.find_rounded(x).empty();
}

bool Acceptance::is_tolerated(const IntersectingPair& pair) const {
  return (options_.goal == Goal::disjoint && pair.kind != PairClass::disjoint) ||
         (options_.each_component && are_of_two_components(diagnosis_.components, pair)) ||
         std::binary_search(diagnosis_.obstructed.begin(), diagnosis_.obstructed.end(), pair);
}

bool Acceptance::is_worse(const Pairs& pairs) const {
  const auto is_more = [](const PairCounts& a, const PairCounts& b) {
    return a.total() > b.total() || a[PairClass::disjoint] > b[PairClass::disjoint];
  };
  return is_more(count_by_class(pairs.triangles), count_by_class(before_.triangles)) ||
         is_more(pairs.faces, before_.faces);
}

Status Acceptance::status(const Pairs& pairs, const Positions& x) const {
  const auto is_fine = [&](const IntersectingPair& pair) { return is_tolerated(pair); };
  const bool is_done = std::all_of(pairs.triangles.begin(), pairs.triangles.end(), is_fine) &&
                       !pairs.by_other_diagonals && count_lost_areas(prepared_.rest, x, prepared_.triangles()) == 0;
  if (!is_done) return pairs.faces.total() < before_.faces.total() ? Status::reduced : Status::no_progress;
  const bool none_left = options_.goal == Goal::all ? pairs.faces.total() == 0 : pairs.faces[PairClass::disjoint] == 0;
  return none_left ? Status::embedded : Status::obstructed;
}

}  // namespace unsnarl
