#include "scene/pair_census.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "scene/output_format.h"

namespace unsnarl {

bool PairCensus::Pairs::are_more_than(const Pairs& other) const {
  const auto is_more = [](const PairCounts& a, const PairCounts& b) {
    return a.total() > b.total() || a[PairClass::disjoint] > b[PairClass::disjoint];
  };
  return is_more(count_by_class(triangles), count_by_class(other.triangles)) || is_more(faces, other.faces);
}

PairCensus::PairCensus(const SurfaceView& surface, const PreparedSurface& prepared, const FindOptions& options,
                       Finders& finders, std::vector<IntersectingPair> at_rest)
    : surface_(surface), prepared_(prepared), options_(options), finders_(finders) {
  assert(finders.are_of(prepared.triangles()));
  if (!prepared.other_diagonals.triangles.empty()) any_diagonal_.emplace(prepared);
  before_ = of(std::move(at_rest), prepared.rest);
}

PairCensus::Pairs PairCensus::at(const Positions& x) {
  return x == prepared_.rest ? before_ : of(finders_.as_is.find(x), x);
}

PairCensus::Pairs PairCensus::of(std::vector<IntersectingPair> triangles, const Positions& x) {
  Pairs pairs;
  pairs.triangles = std::move(triangles);
  const std::vector<IntersectingPair> by_input = pairs_of_faces(prepared_.triangulation.polygon, pairs.triangles);
  pairs.of_faces = unite_face_pairs(by_other_cuts(x), by_input);
  std::set_difference(pairs.of_faces.begin(), pairs.of_faces.end(), by_input.begin(), by_input.end(),
                      std::back_inserter(pairs.by_other_cuts),
                      [](const auto& p, const auto& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  pairs.faces = count_by_class(pairs.of_faces);
  return pairs;
}

std::vector<IntersectingPair> PairCensus::by_other_cuts(const Positions& x) {
  std::vector<IntersectingPair> pairs;
  if (any_diagonal_) pairs = any_diagonal_->find(x);
  const auto read = as_read(x);
  return read ? unite_face_pairs(std::move(pairs), FacePairFinder(*read).find(x)) : pairs;
}

PairCounts PairCensus::allowed_at(const Positions& x) const {
  if (!prepared_.allowed.any()) return {};
  return count_by_class(find_allowed_pairs(prepared_, as_read(x), x));
}

std::vector<IntersectingPair> PairCensus::in_float32(const Positions& x) {
  const std::vector<IntersectingPair> by_input =
      pairs_of_faces(prepared_.triangulation.polygon, finders_.find_rounded(x));
  return unite_face_pairs(by_other_cuts(rounded_to_float32(x, prepared_.scale)), by_input);
}

bool PairCensus::is_embedded_in_float32(const Positions& x) {
  return fits_float32(x, prepared_.scale) && in_float32(x).empty();
}

}  // namespace unsnarl
