#include "contact/smallest_gap.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "contact/distances.h"
#include "contact/face_tree.h"
#include "geometry/box.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

/// How far apart the projections of two triangles onto a line are; negative: they overlap.
double gap_along(const Positions& x, const Triangle& s, const Triangle& t, const Vec3& direction) {
  const auto along = [&](Index v) { return direction.dot(x.col(v)); };
  const auto [s_least, s_most] = std::minmax({along(s[0]), along(s[1]), along(s[2])});
  const auto [t_least, t_most] = std::minmax({along(t[0]), along(t[1]), along(t[2])});
  return std::max(t_least - s_most, s_least - t_most);
}

/// The distance of two triangles that do not intersect.
double distance_of(const Positions& x, const Triangle& s, const Triangle& t) {
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

double squared_distance(const Box& a, const Box& b) {
  return (a.lo - b.hi).cwiseMax(b.lo - a.hi).cwiseMax(0).squaredNorm();
}

/// Branch and bound in a tree of boxes: pairs of nodes that are farther apart than the nearest pair so far, or that
/// hold only one group, are skipped.
class Search {
 public:
  Search(std::span<const Triangle> triangles, const Positions& x, std::span<const Index> group, Passing passing)
      : triangles_(triangles),
        x_(x),
        group_(group),
        passing_(passing),
        order_(triangles.size()),
        boxes_(triangles.size()) {
    nearest_.distance = std::numeric_limits<double>::infinity();
    if (triangles.empty()) return;
    std::iota(order_.begin(), order_.end(), Index{0});
    for (std::size_t t = 0; t < triangles.size(); ++t) boxes_[t] = box_of(x, triangles[t]);
    nodes_.reserve(2 * triangles.size());
    build(0, static_cast<Index>(triangles.size()));
    visit_within(0);
  }

  const SmallestGap& nearest() const { return nearest_; }

 private:
  /// A leaf of the tree holds at most this many triangles (unit: triangles)
  static constexpr Index leaf_size = 4;
  struct Node {
    Box box;
    Index begin, end;   // order_[begin, end) is below it
    Index right;        // the left child is the next node; -1: a leaf
    Index first, last;  // the smallest and the largest group
    bool is_leaf() const { return right < 0; }
  };

  Index group(Index triangle) const { return group_.empty() ? triangle : group_[triangle]; }

  Index build(Index begin, Index end) {
    const Index id = static_cast<Index>(nodes_.size());
    Node node{{}, begin, end, -1, group(order_[begin]), group(order_[begin])};
    for (Index k = begin; k < end; ++k) {
      node.box.extend(boxes_[order_[k]]);
      node.first = std::min(node.first, group(order_[k]));
      node.last = std::max(node.last, group(order_[k]));
    }
    nodes_.push_back(node);
    if (end - begin <= leaf_size) {  // by id: what std::nth_element leaves depends on the standard library
      std::sort(order_.begin() + begin, order_.begin() + end);
      return id;
    }
    int axis = 0;
    (node.box.hi - node.box.lo).maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    const auto centre = [&](Index t) { return boxes_[t].lo[axis] + boxes_[t].hi[axis]; };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](Index s, Index t) { return std::pair(centre(s), s) < std::pair(centre(t), t); });
    build(begin, middle);
    const Index right = build(middle, end);
    nodes_[id].right = right;
    return id;
  }

  bool may_be_nearer(Index a, Index b) const {
    const Node &m = nodes_[a], &n = nodes_[b];
    const bool is_one_group = m.first == m.last && n.first == n.last && m.first == n.first;
    return !is_one_group && squared_distance(m.box, n.box) < nearest_.distance * nearest_.distance;
  }

  void visit_within(Index a) {
    const Node& node = nodes_[a];
    if (!may_be_nearer(a, a)) return;
    if (node.is_leaf()) {
      for (Index k = node.begin; k < node.end; ++k)
        for (Index l = k + 1; l < node.end; ++l) compare(order_[k], order_[l]);
      return;
    }
    visit_within(a + 1);
    visit_within(node.right);
    visit_between(a + 1, node.right);
  }

  void visit_between(Index a, Index b) {
    if (!may_be_nearer(a, b)) return;
    const Node &m = nodes_[a], &n = nodes_[b];
    if (m.is_leaf() && n.is_leaf()) {
      for (Index k = m.begin; k < m.end; ++k)
        for (Index l = n.begin; l < n.end; ++l) compare(order_[k], order_[l]);
      return;
    }
    // The larger one is split, its nearer half looked at first.
    const bool splits_a = n.is_leaf() || (!m.is_leaf() && m.box.diagonal() >= n.box.diagonal());
    const Index whole = splits_a ? b : a;
    Index near = splits_a ? a + 1 : b + 1, far = splits_a ? m.right : n.right;
    if (squared_distance(nodes_[far].box, nodes_[whole].box) < squared_distance(nodes_[near].box, nodes_[whole].box))
      std::swap(near, far);
    visit_between(near, whole);
    visit_between(far, whole);
  }

  void compare(Index s, Index t) {
    if (group(s) == group(t) || !passing_.meet(triangles_, s, t)) return;
    if (squared_distance(boxes_[s], boxes_[t]) >= nearest_.distance * nearest_.distance) return;
    if (share_a_vertex(triangles_[s], triangles_[t])) return;
    if (are_apart(x_, triangles_[s], triangles_[t], nearest_.distance)) return;
    const double d = distance_of(x_, triangles_[s], triangles_[t]);
    if (d < nearest_.distance) nearest_ = {d, std::min(s, t), std::max(s, t)};
  }

  std::span<const Triangle> triangles_;
  const Positions& x_;
  std::span<const Index> group_;
  Passing passing_;
  std::vector<Index> order_;
  std::vector<Box> boxes_;  // of the triangles
  std::vector<Node> nodes_;
  SmallestGap nearest_;
};

}  // namespace

bool are_apart(const Positions& x, const Triangle& s, const Triangle& t, double distance) {
  const Vec3 centres = x.col(t[0]) + x.col(t[1]) + x.col(t[2]) - x.col(s[0]) - x.col(s[1]) - x.col(s[2]);
  if (gap_along(x, s, t, centres.normalized()) >= distance) return true;
  for (const Triangle& face : {s, t}) {
    const Vec3 normal = area_vector(x, face).normalized();
    if (gap_along(x, s, t, normal) >= distance) return true;
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = x.col(face[(k + 1) % 3]) - x.col(face[k]);
      if (gap_along(x, s, t, normal.cross(edge).normalized()) >= distance) return true;
    }
  }
  return false;
}

SmallestGap smallest_gap(std::span<const Triangle> triangles, const Positions& x, std::span<const Index> group,
                         Passing passing) {
  return Search(triangles, x, group, passing).nearest();
}

std::vector<std::array<Index, 2>> pairs_closer_than(std::span<const Triangle> triangles, const Positions& x,
                                                    double distance) {
  FaceTree tree(triangles);
  tree.update(x, 0.5 * distance);
  std::vector<std::vector<std::array<Index, 2>>> found(static_cast<std::size_t>(tree.task_count()));
  tree.self_pairs([&](Index task, Index s, Index t) {
    if (share_a_vertex(triangles[s], triangles[t]) || are_apart(x, triangles[s], triangles[t], distance) ||
        distance_of(x, triangles[s], triangles[t]) >= distance)
      return;
    found[static_cast<std::size_t>(task)].push_back({s, t});
  });
  std::vector<std::array<Index, 2>> pairs;
  for (const auto& list : found) pairs.insert(pairs.end(), list.begin(), list.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace unsnarl
