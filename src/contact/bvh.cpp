#include "contact/bvh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <limits>

#include "contact/bvh_traversal.h"
#include "geometry/parallel.h"

namespace unsnarl {
namespace {

/// Fewer boxes are split by one thread, since starting tasks costs more than it saves (unit: boxes)
constexpr Index parallel_threshold = 20000;
/// The traversal makes tasks of nodes with at most this many boxes (unit: boxes)
constexpr Index task_size = 1024;

struct BoxCenter {
  float at[3];
  Index box;
};

/// Returns how many of the `count` boxes below a node, more than a leaf holds, go to the left. All leaves but the last
/// are full.
Index left_count(Index count, Index leaf_size) {
  return (count / 2 + leaf_size - 1) / leaf_size * leaf_size;
}

/// Orders the boxes as the leaves of the tree: halves them again and again along the axis of the largest extent of
/// their centers. This takes longer than an order by Morton codes, but queries then visit far fewer nodes. By ids
/// within a leaf: what std::nth_element leaves depends on the standard library.
void split(std::span<BoxCenter> centers, Index leaf_size) {
  const auto count = static_cast<Index>(centers.size());
  if (count <= leaf_size) {
    std::sort(centers.begin(), centers.end(), [](const BoxCenter& a, const BoxCenter& b) { return a.box < b.box; });
    return;
  }
  std::array<float, 3> lo, hi;
  lo.fill(std::numeric_limits<float>::infinity());
  hi.fill(-std::numeric_limits<float>::infinity());
  for (const BoxCenter& center : centers)
    for (int k = 0; k < 3; ++k) lo[k] = std::min(lo[k], center.at[k]), hi[k] = std::max(hi[k], center.at[k]);
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
  const Index middle = left_count(count, leaf_size);
  std::nth_element(centers.begin(), centers.begin() + middle, centers.end(),
                   [axis](const BoxCenter& a, const BoxCenter& b) {
                     return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.box < b.box;
                   });
  const std::span<BoxCenter> left = centers.first(middle), right = centers.subspan(middle);
  if (count < parallel_threshold) {
    split(left, leaf_size);
    split(right, leaf_size);
  } else {
    parallel_for(2, [&](int side) { split(side == 0 ? left : right, leaf_size); });
  }
}

}  // namespace

void Bvh::build(std::span<const Box> boxes) {
  const Index n = static_cast<Index>(boxes.size());
  nodes_.clear();
  leaves_.clear();
  tasks_.clear();
  order_.resize(n);
  boxes_.resize(n);
  active_.assign(static_cast<std::size_t>(n), 1);
  place_.clear();
  has_only_active_ = false;
  if (n == 0) return;
  Box bounds;
  for (const Box& box : boxes)
    if (const Vec3 center = box.center(); center.allFinite()) bounds.extend(center);
  if (!bounds.lo.allFinite()) bounds.extend(Vec3(Vec3::Zero()));
  std::vector<BoxCenter> centers(n);
  for (Index i = 0; i < n; ++i) {
    Vec3 center = boxes[i].center() - bounds.lo;
    if (!center.allFinite()) center.setZero();  // an empty or infinite box may have any center
    centers[i] = {{static_cast<float>(center[0]), static_cast<float>(center[1]), static_cast<float>(center[2])}, i};
  }
  split(centers, leaf_size);
  for (Index i = 0; i < n; ++i) order_[i] = centers[i].box;
  nodes_.reserve(2 * (static_cast<std::size_t>(n) / leaf_size + 1));
  build_node(0, n);
  refit(boxes);
}

Index Bvh::build_node(Index begin, Index end) {
  const Index id = static_cast<Index>(nodes_.size());
  nodes_.push_back({{}, begin, end, 0, true});
  if (end - begin <= leaf_size) {
    leaves_.emplace_back();
    nodes_[id].right = -static_cast<Index>(leaves_.size());
  } else {
    const Index middle = begin + left_count(end - begin, leaf_size);
    const Index left = build_node(begin, middle);
    const Index right = build_node(middle, end);
    nodes_[id].right = right;
    if (end - begin > task_size) tasks_.emplace_back(left, right);
    if (end - begin > task_size && middle - begin <= task_size) tasks_.emplace_back(left, left);
    if (end - begin > task_size && end - middle <= task_size) tasks_.emplace_back(right, right);
  }
  if (id == 0 && end <= task_size) tasks_.emplace_back(0, 0);
  return id;
}

bool Bvh::overlaps_any(const Box& box) const {
  return find(box, [](Index) { return true; });
}

void Bvh::fit(Node& node) {
  node.box = RoundedBox();
  if (node.is_leaf()) {
    FourBoxes& leaf = leaves_[node.leaf()];
    for (Index k = node.begin; k < node.end; ++k) {
      const RoundedBox box(boxes_[k]);
      node.box.extend(box);
      leaf.set(k - node.begin, box);
    }
  } else {
    node.box.extend((&node)[1].box);
    node.box.extend(nodes_[node.right].box);
  }
}

void Bvh::flag(Node& node) {
  if (node.is_leaf()) {
    const auto end = active_.begin() + node.end;
    node.active = std::find_if(active_.begin() + node.begin, end, [](std::uint8_t w) { return w != 0; }) != end;
  } else {
    node.active = (&node)[1].active || nodes_[node.right].active;
  }
}

std::vector<Index> Bvh::places_of(std::span<const Index> boxes) {
  if (place_.empty()) {
    place_.resize(order_.size());
    for (Index k = 0; k < size(); ++k) place_[order_[k]] = k;
  }
  std::vector<Index> places(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) places[i] = place_[boxes[i]];
  std::sort(places.begin(), places.end());
  return places;
}

template <class Visit>
void Bvh::visit_above(std::span<const Index> places, Visit&& visit, Index id) {
  if (places.empty()) return;
  Node& node = nodes_[id];
  if (!node.is_leaf()) {
    const auto middle = std::lower_bound(places.begin(), places.end(), nodes_[node.right].begin);
    visit_above({places.begin(), middle}, visit, id + 1);
    visit_above({middle, places.end()}, visit, node.right);
  }
  visit(node);
}

void Bvh::set_active(std::span<const std::uint8_t> active) {
  assert(active.size() == order_.size());
  has_only_active_ = false;
  for (std::size_t k = 0; k < order_.size(); ++k) active_[k] = active[order_[k]];
  for (std::size_t id = nodes_.size(); id-- > 0;) flag(nodes_[id]);
}

void Bvh::set_only_active(std::span<const Index> active) {
  if (has_only_active_) {
    for (Index k : only_active_) active_[k] = 0;
    visit_above(only_active_, [](Node& node) { node.active = false; });
  } else {
    std::fill(active_.begin(), active_.end(), std::uint8_t{0});
    for (Node& node : nodes_) node.active = false;
  }
  has_only_active_ = true;
  only_active_ = places_of(active);
  for (Index k : only_active_) active_[k] = 1;
  visit_above(only_active_, [](Node& node) { node.active = true; });
}

void Bvh::refit(std::span<const Box> boxes) {
  assert(boxes.size() == order_.size());
  const Index n = size();
  for (Index k = 0; k < n; ++k) boxes_[k] = boxes[order_[k]];
  // Children come after their parent.
  for (std::size_t id = nodes_.size(); id-- > 0;) fit(nodes_[id]);
}

void Bvh::refit(std::span<const Box> boxes, std::span<const Index> moved) {
  assert(boxes.size() == order_.size());
  const std::vector<Index> places = places_of(moved);
  for (Index k : places) boxes_[k] = boxes[order_[k]];
  visit_above(places, [this](Node& node) { fit(node); });
}

}  // namespace unsnarl
