#include "energy/orientation_penalty.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/parallel_lists.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"

namespace unsnarl {

OrientationPenalty::OrientationPenalty(const Positions& rest, std::span<const Triangle> triangles,
                                       const Options& options)
    : triangles_of_vertex_(triangles_of_vertices(triangles, static_cast<Index>(rest.cols()))),
      activation_(options.activation),
      most_(1 + options.linear / options.activation) {
  triangles_.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    Kept kept;
    kept.corners = t;
    const Vec3 area = area_vector(rest, t);
    const double squared = area.squaredNorm();
    double longest = 0;  // edge
    for (int k = 0; k < 3; ++k) longest = std::max(longest, (rest.col(t[k]) - rest.col(t[(k + 1) % 3])).norm());
    if (squared > 0 && longest > 0 && std::isfinite(1 / squared)) {
      kept.normal = area / squared;
      kept.weight = std::sqrt(squared) / longest;
    }
    triangles_.push_back(kept);
  }
}

double OrientationPenalty::value(const Positions& x, Index t) const {
  const Kept& kept = triangles_[t];
  if (!(kept.weight > 0)) return 0;
  const double missing = 1 - kept.normal.dot(area_vector(x, kept.corners)) / activation_;
  const double most = std::min(missing, most_);
  return missing > 0 ? kept.weight * most * (missing - 0.5 * most) : 0;
}

double OrientationPenalty::linearise(const Positions& x, Index t, double weight, Positions& gradient,
                                     HessianTerms& hessian) const {
  const Kept& kept = triangles_[t];
  if (!(kept.weight > 0)) return 0;
  const double missing = 1 - kept.normal.dot(area_vector(x, kept.corners)) / activation_;
  if (!(missing > 0)) return 0;
  const double most = std::min(missing, most_);
  const double scale = weight * kept.weight;
  HessianTerms::RankOne& term = hessian.rank_ones.emplace_back();
  term.stiffness = scale / (activation_ * activation_) * (most / missing);
  for (int k = 0; k < 3; ++k) {
    const Vec3 opposite = x.col(kept.corners[(k + 2) % 3]) - x.col(kept.corners[(k + 1) % 3]);
    term.vertices[k] = kept.corners[k];
    term.g.col(k) = kept.normal.cross(opposite);
    gradient.col(kept.corners[k]) -= scale * most / activation_ * term.g.col(k);
  }
  return scale * most * (missing - 0.5 * most);
}

bool OrientationPenalty::is_flipped(const Positions& x, Index t) const {
  const Kept& kept = triangles_[t];
  return kept.weight > 0 && kept.normal.dot(area_vector(x, kept.corners)) < 0;
}

double OrientationPenalty::share_of_moved(const Positions& x, const Positions& p, const Kept& kept,
                                          std::array<Vec3, 3>& corners) {
  for (int k = 0; k < 3; ++k) corners[k] = x.col(kept.corners[k]) + p.col(kept.corners[k]);
  return kept.normal.dot((corners[1] - corners[0]).cross(corners[2] - corners[0]));
}

bool OrientationPenalty::project(const Positions& x, std::span<const Index> which, double share,
                                 std::span<const std::uint8_t> moves, Positions& p) const {
  bool any = false;
  std::array<Vec3, 3> corners, gradient;
  for (Index t : which) {
    const Kept& kept = triangles_[t];
    if (!(kept.weight > 0)) continue;
    const double now = kept.normal.dot(area_vector(x, kept.corners));
    if (!(now > 0)) continue;
    const double missing = share * now - share_of_moved(x, p, kept, corners);
    if (!(missing > 0)) continue;
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
      gradient[k] = kept.normal.cross(corners[(k + 2) % 3] - corners[(k + 1) % 3]);
      if (moves[kept.corners[k]]) squared += gradient[k].squaredNorm();
    }
    if (!(squared > 0)) continue;
    any = true;
    for (int k = 0; k < 3; ++k)
      if (moves[kept.corners[k]]) p.col(kept.corners[k]) += missing / squared * gradient[k];
  }
  return any;
}

bool OrientationPenalty::filter(const Positions& x, std::span<const Index> which, double share, double factor,
                                Positions& p) const {
  /// Rounds in which steps of flipping faces are multiplied by the factor, before they are set to zero (unit: rounds)
  constexpr int rounds = 30;
  const auto flips = [&](Index t) {
    const Kept& kept = triangles_[t];
    if (!(kept.weight > 0)) return false;
    const double now = kept.normal.dot(area_vector(x, kept.corners));
    if (!(now > 0)) return false;
    std::array<Vec3, 3> corners;
    return share_of_moved(x, p, kept, corners) < share * now;
  };
  std::vector<Index> flipping, changed;
  gather_in_chunks(static_cast<Index>(which.size()), flipping, [&](Index begin, Index end, std::vector<Index>& list) {
    std::copy_if(which.begin() + begin, which.begin() + end, std::back_inserter(list), flips);
  });
  if (flipping.empty()) return false;
  for (int round = 0; !flipping.empty(); ++round) {
    changed.clear();
    for (Index t : flipping)
      for (Index v : triangles_[t].corners) {
        p.col(v) *= round < rounds ? factor : 0;
        changed.insert(changed.end(), triangles_of_vertex_[v].begin(), triangles_of_vertex_[v].end());
      }
    sort_unique(changed);
    flipping.clear();
    std::copy_if(changed.begin(), changed.end(), std::back_inserter(flipping),
                 [&](Index t) { return std::binary_search(which.begin(), which.end(), t) && flips(t); });
  }
  return true;
}

}  // namespace unsnarl
