#include "contact/smallest_gap.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "contact/bvh.h"
#include "contact/distances.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

/// The first search looks so many mean edges far, each one after it so many times farther than the one before: most
/// surfaces have something as near as the first, and few need more than four.
constexpr double first_reach = 0.01, growth = 8;

bool share_a_vertex(const Triangle& s, const Triangle& t) {
  return std::any_of(s.begin(), s.end(), [&](Index v) { return std::find(t.begin(), t.end(), v) != t.end(); });
}

/// Of triangles that do not intersect.
double distance(const Positions& x, const Triangle& s, const Triangle& t) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = x.col(s[i]), q = x.col(t[i]);
    nearest = std::min({nearest, closest_vertex_face(p, x.col(t[0]), x.col(t[1]), x.col(t[2])).distance,
                        closest_vertex_face(q, x.col(s[0]), x.col(s[1]), x.col(s[2])).distance});
    for (int j = 0; j < 3; ++j)
      nearest =
          std::min(nearest, closest_edge_edge(p, x.col(s[(i + 1) % 3]), x.col(t[j]), x.col(t[(j + 1) % 3])).distance);
  }
  return nearest;
}

}  // namespace

SmallestGap smallest_gap(std::span<const Triangle> triangles, const Positions& x, std::span<const Index> group) {
  SmallestGap none;
  none.distance = std::numeric_limits<double>::infinity();
  if (triangles.empty()) return none;
  Box all;
  std::vector<Box> boxes(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    boxes[t] = box_of(x, triangles[t]);
    all.extend(boxes[t]);
  }
  const double diagonal = all.diagonal();
  double reach = std::max(first_reach * mean_edge_length(x, triangles), 1e-12 * diagonal);
  for (;; reach *= growth) {
    std::vector<Box> wide = boxes;
    for (Box& box : wide) box = box.inflated(reach / 2);
    const Bvh bvh(wide);
    // A list a task, merged in their order: the same at any number of threads.
    std::vector<SmallestGap> found(static_cast<std::size_t>(bvh.task_count()), none);
    bvh.self_pairs_parallel([&](Index task, Index i, Index j) {
      if (!group.empty() && group[i] == group[j]) return;
      if (share_a_vertex(triangles[i], triangles[j])) return;
      const double d = distance(x, triangles[i], triangles[j]);
      if (d < found[task].distance) found[task] = {d, std::min(i, j), std::max(i, j)};
    });
    SmallestGap smallest = none;
    for (const SmallestGap& gap : found)
      if (gap.distance < smallest.distance) smallest = gap;
    // All that is within reach has been looked at.
    if (smallest.distance <= reach || reach > diagonal) return smallest;
  }
}

}  // namespace unsnarl
