#include "report/acceptance.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mesh/areas.h"

namespace unsnarl {

Acceptance::Acceptance(const SurfaceView& surface, const PreparedSurface& prepared, const Diagnosis& diagnosis,
                       const RepairOptions& options, Finders& finders)
    : surface_(surface), prepared_(prepared), diagnosis_(diagnosis), options_(options), finders_(finders) {
  if (!prepared.other_diagonals.triangles.empty()) any_diagonal_.emplace(prepared);
  before_ = pairs_at(prepared.rest);
}

Acceptance::Pairs Acceptance::pairs_at(const Positions& x) {
  Pairs pairs;
  pairs.triangles = x == prepared_.rest ? diagnosis_.pairs : finders_.as_is.find(x);
  const std::vector<IntersectingPair> by_input = pairs_of_faces(prepared_.triangulation.polygon, pairs.triangles);
  pairs.of_faces = unite_face_pairs(pairs_by_other_cuts(x), by_input);
  std::set_difference(pairs.of_faces.begin(), pairs.of_faces.end(), by_input.begin(), by_input.end(),
                      std::back_inserter(pairs.by_other_cuts),
                      [](const auto& p, const auto& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  pairs.faces = count_by_class(pairs.of_faces);
  return pairs;
}

std::vector<IntersectingPair> Acceptance::pairs_by_other_cuts(const Positions& x) {
  std::vector<IntersectingPair> pairs;
  if (any_diagonal_) pairs = any_diagonal_->find(x);
  const auto read = cut_anew(surface_, prepared_, options_.find, prepared_.scatter(surface_.positions, x));
  return read ? unite_face_pairs(std::move(pairs), FacePairFinder(*read).find(x)) : pairs;
}

std::vector<IntersectingPair> Acceptance::pairs_in_float32(const Positions& x) {
  const std::vector<IntersectingPair> by_input =
      pairs_of_faces(prepared_.triangulation.polygon, finders_.find_rounded(x));
  return unite_face_pairs(pairs_by_other_cuts(rounded_to_float32(x, prepared_.scale)), by_input);
}

bool Acceptance::is_embedded_in_float32(const Positions& x) {
  return fits_float32(x, prepared_.scale) && pairs_in_float32(x).empty();
}

bool Acceptance::is_tolerated(const IntersectingPair& pair) const {
  return (options_.goal == Goal::disjoint && pair.kind != PairClass::disjoint) ||
         (options_.each_component && are_of_two_components(diagnosis_.components, pair)) ||
         std::binary_search(diagnosis_.obstructed.begin(), diagnosis_.obstructed.end(), pair);
}

std::optional<LeftReason> Acceptance::tolerance_by_other_cuts(const IntersectingPair& pair) const {
  const auto component_of = [&](Index f) {
    return component_of_face(surface_, prepared_.weld_map, diagnosis_.components, f);
  };
  const Index component = component_of(pair.a);
  const bool is_of_one = component == component_of(pair.b);
  if (is_of_one && diagnosis_.components.list[component].obstructed()) return LeftReason::closed_non_orientable;
  if (pair.kind == PairClass::duplicate) return LeftReason::duplicate_faces;
  if (!is_of_one && options_.each_component) return LeftReason::between_components;
  if (options_.goal == Goal::disjoint && pair.kind != PairClass::disjoint) return LeftReason::goal;
  return std::nullopt;
}

bool Acceptance::is_worse(const Pairs& pairs) const {
  const auto is_more = [](const PairCounts& a, const PairCounts& b) {
    return a.total() > b.total() || a[PairClass::disjoint] > b[PairClass::disjoint];
  };
  return is_more(count_by_class(pairs.triangles), count_by_class(before_.triangles)) ||
         is_more(pairs.faces, before_.faces);
}

Status Acceptance::status(const Pairs& pairs, const Positions& x) {
  const auto is_fine = [&](const IntersectingPair& pair) { return is_tolerated(pair); };
  const auto is_fine_too = [&](const IntersectingPair& pair) { return tolerance_by_other_cuts(pair).has_value(); };
  const bool is_done = std::all_of(pairs.triangles.begin(), pairs.triangles.end(), is_fine) &&
                       std::all_of(pairs.by_other_cuts.begin(), pairs.by_other_cuts.end(), is_fine_too) &&
                       count_lost_areas(prepared_.rest, x, prepared_.triangles()) == 0;
  const auto is_reached = [&](const PairCounts& left) {
    return options_.goal == Goal::all ? left.total() == 0 : left[PairClass::disjoint] == 0;
  };
  const auto holds_in_float32 = [&] {
    return fits_float32(x, prepared_.scale) && is_reached(count_by_class(pairs_in_float32(x)));
  };
  if (is_done && !is_reached(pairs.faces)) return Status::obstructed;
  if (is_done && (options_.precision != Precision::float32 || holds_in_float32())) return Status::embedded;
  return pairs.faces.total() < before_.faces.total() ? Status::reduced : Status::no_progress;
}

}  // namespace unsnarl
