#include "untangle/local/separating_forces.h"

#include <algorithm>
#include <numeric>

#include "untangle/local/contours.h"

namespace unsnarl {

PenaltyForce::PenaltyForce(const Patch& patch, double margin)
    : triangles_(patch.triangles),
      passing_(patch.passing()),
      margin_(margin),
      penalty_(patch.triangles, {.margin = margin}),
      tree_(patch.triangles, patch.active_count) {}

void PenaltyForce::set_margin(double margin) {
  margin_ = margin;
  penalty_ = MinkowskiPenalty(triangles_, {.margin = margin});
}

void PenaltyForce::add(const Positions& x, Positions& force) {
  tree_.update(x, 0.5 * margin_);
  std::vector<std::vector<MinkowskiPenalty::Pair>> found(tree_.task_count());
  tree_.self_pairs([&](Index task, Index a, Index b) {
    if (passing_.meet(triangles_, a, b)) found[task].push_back({a, b});
  });
  gather_sorted(found);
  penalty_.value_and_gradient(x, force, -1);
}

/// The pairs of all lists, ascending: by their first triangles at once, then by the second ones of each.
void PenaltyForce::gather_sorted(const std::vector<std::vector<MinkowskiPenalty::Pair>>& lists) {
  ends_.assign(triangles_.size() + 1, 0);
  for (const auto& list : lists)
    for (const auto& [a, b] : list) ++ends_[a + 1];
  std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
  penalty_.pairs.resize(static_cast<std::size_t>(ends_.back()));
  for (const auto& list : lists)
    for (const auto& pair : list) penalty_.pairs[ends_[pair[0]]++] = pair;
  auto begin = penalty_.pairs.begin();
  for (std::size_t a = 0; a + 1 < ends_.size(); ++a) {
    const auto end = penalty_.pairs.begin() + ends_[a];
    std::sort(begin, end);
    begin = end;
  }
}

double deepest_overlap(const Patch& patch, const Positions& x, std::span<const IntersectingPair> pairs) {
  double deepest = 0;
  for (const IntersectingPair& pair : pairs)
    deepest = std::max(deepest, overlap_depth(x, patch.triangles[pair.a], patch.triangles[pair.b]));
  return deepest;
}

void add_contour_force(const Patch& patch, const Positions& x, const EdgeTable& edges,
                       std::span<const IntersectingPair> pairs, const MinkowskiPenalty& penalty, SheetMotion motion,
                       Positions& force) {
  const Contours contours = trace_contours(x, patch.triangles, edges, pairs);
  const std::vector<Vec3> pushes = sheet_pushes(contours, motion);
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    const Crossing& c = contours.crossings[i];
    const Vec3 push = c.side * pushes[i];  // of the edge
    const auto [u, v] = edges.edges[c.edge];
    force.col(u) += (1 - c.along) * push;
    force.col(v) += c.along * push;
    for (int k = 0; k < 3; ++k) force.col(patch.triangles[c.face][k]) -= c.weights[k] * push;
  }
  for (const IntersectingPair& pair : contours.uncrossed) {
    const Penetration p = penalty.evaluate(x, pair.a, pair.b);
    if (!(p.depth > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      force.col(patch.triangles[pair.a][k]) += p.weight_a[k] * p.normal;
      force.col(patch.triangles[pair.b][k]) -= p.weight_b[k] * p.normal;
    }
  }
}

}  // namespace unsnarl
