#include "contact/moving_intersections.h"

#include <algorithm>

#include "contact/intersection_finder.h"
#include "geometry/parallel_lists.h"
#include "geometry/triangle_intersection.h"
#include "mesh/adjacency.h"

namespace unsnarl {
void MovingIntersections::add_near(const Positions& x, Index begin, Index end, std::vector<IntersectingPair>& found) {
  PairClass kind;
  for (NearPairs::Pair& pair : near_.pairs().subspan(begin, end - begin)) {
    const Index a = pair.a, b = pair.b;
    if (frames_.holds(a, b, pair.clearance)) continue;
    double apart = near_.gap(a, b);
    if (!(apart > 0)) apart = separation(points_of(x, triangles_[a]), points_of(x, triangles_[b]));
    if (apart > 0)
      pair.clearance = frames_.clearance(a, b, apart);
    else if (intersects(x, triangles_[a], triangles_[b], kind))
      found.push_back({a, b, kind});
  }
}

void MovingIntersections::add_joined(const Positions& x, Index begin, Index end,
                                     std::vector<IntersectingPair>& found) const {
  PairClass kind;
  for (Index v = begin; v < end; ++v) {
    if (fans_.is_unfolded(v)) continue;
    const std::span<const Index> at = fans_.triangles_at(v);
    for (std::size_t j = 1; j < at.size(); ++j)
      for (std::size_t i = 0; i < j && at[i] < active_count_; ++i) {
        const Triangle &a = triangles_[at[i]], &b = triangles_[at[j]];
        // A pair that shares two vertices is decided by the fan of either, or else at the first of them.
        if (!near_.overlap(at[i], at[j]) || !passing_.meet(triangles_, at[i], at[j])) continue;
        const bool elsewhere = std::any_of(
            a.begin(), a.end(), [&](Index u) { return u != v && has_corner(b, u) && (u < v || fans_.is_unfolded(u)); });
        if (!elsewhere && intersects(x, a, b, kind)) found.push_back({at[i], at[j], kind});
      }
  }
}

std::vector<IntersectingPair> MovingIntersections::find(const Positions& x) {
  near_.update(x);
  frames_.update(x);
  fans_.update(x);
  std::vector<IntersectingPair> pairs, joined;
  gather_in_chunks(static_cast<Index>(near_.pairs().size()), pairs,
                   [&](Index begin, Index end, auto& list) { add_near(x, begin, end, list); });
  gather_in_chunks(static_cast<Index>(x.cols()), joined,
                   [&](Index begin, Index end, auto& list) { add_joined(x, begin, end, list); });
  pairs.insert(pairs.end(), joined.begin(), joined.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace unsnarl
