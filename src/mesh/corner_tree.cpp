#include "mesh/corner_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace unsnarl {
namespace {

/// Relative rounding error of a dozen operations here and as many in turn() (fixed by float64)
constexpr double rounding = 64 * 0x1p-53;
/// Absolute error that covers products which underflow (fixed by float64)
constexpr double underflow_guard = 1e-280;

/// What a linear function is at most in a box, and how far rounding may put that off.
struct Bound {
  double largest = 0, error = underflow_guard;
};

/// x -> gradient * (x - origin). `magnitude`: of each part of the gradient, before parts cancelled.
Bound bound_in(const Box& box, const Vec3& origin, const Vec3& gradient, const Vec3& magnitude) {
  Bound bound;
  for (int k = 0; k < 3; ++k) {
    const double lo = box.lo[k] - origin[k], hi = box.hi[k] - origin[k];
    bound.largest += std::max(gradient[k] * lo, gradient[k] * hi);
    bound.error += rounding * magnitude[k] * std::max(std::abs(lo), std::abs(hi));
  }
  return bound;
}

Vec3 magnitude_of_cross(const Vec3& a, const Vec3& b) {
  const Vec3 p = a.cwiseAbs(), q = b.cwiseAbs();
  return {p[1] * q[2] + p[2] * q[1], p[2] * q[0] + p[0] * q[2], p[0] * q[1] + p[1] * q[0]};
}

/// All points that a triangle covers as seen along the normal, for which turn() is the judge.
class Shadow {
 public:
  Shadow(const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& c)
      : normal_(normal), corners_{a, b, c}, doubled_area_(turn(normal, a, b, c)) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = corners_[(k + 1) % 3] - corners_[k];
      inwards_[k] = normal.cross(edge);
      magnitude_[k] = magnitude_of_cross(normal, edge);
      axis_[k] = Vec3::Unit(k).cross(normal);
      const double to_b = axis_[k].dot(b - a), to_c = axis_[k].dot(c - a);
      const double error = rounding * axis_[k].cwiseAbs().dot((b - a).cwiseAbs() + (c - a).cwiseAbs());
      reach_[k] = {std::min({0.0, to_b, to_c}) - error, std::max({0.0, to_b, to_c}) + error};
    }
  }

  bool contains(const Vec3& x) const {
    const auto& [a, b, c] = corners_;
    return turn(normal_, a, b, x) >= 0 && turn(normal_, b, c, x) >= 0 && turn(normal_, c, a, x) >= 0;
  }

  /// It contains no point of the box. Never true where numbers over- or underflow.
  bool misses(const Box& box) const {
    double error = 0;
    for (int k = 0; k < 3; ++k) {
      const Bound inside = bound_in(box, corners_[k], inwards_[k], magnitude_[k]);
      if (inside.largest < -inside.error) return true;
      error = std::max(error, inside.error);
    }
    // Boxes behind a corner or an edge may straddle all three sides. Of what is contained no barycentric coordinate is
    // below -slack, so it lies between the corners along any axis, but for so much.
    const double slack = 2 * error / doubled_area_;
    if (!(slack < 0.25)) return false;
    for (int k = 0; k < 3; ++k) {
      const Vec3 magnitude = axis_[k].cwiseAbs();
      const double margin = 3 * slack * (reach_[k][1] - reach_[k][0]);
      const Bound up = bound_in(box, corners_[0], axis_[k], magnitude);
      if (up.largest < reach_[k][0] - margin - up.error) return true;
      const Bound down = bound_in(box, corners_[0], -axis_[k], magnitude);
      if (down.largest < -reach_[k][1] - margin - down.error) return true;
    }
    return false;
  }

 private:
  Vec3 normal_;
  std::array<Vec3, 3> corners_;
  double doubled_area_;
  std::array<Vec3, 3> inwards_, magnitude_;     // of the three sides
  std::array<Vec3, 3> axis_;                    // at right angles to the normal
  std::array<std::array<double, 2>, 3> reach_;  // of the triangle along each, from its first corner
};

}  // namespace

double turn(const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 area = (b - a).cross(c - a);
  return normal[0] * area[0] + normal[1] * area[1] + normal[2] * area[2];
}

void CornerTree::build(std::span<const Index> corners, std::span<const Vec3> points) {
  corners_ = corners;
  points_ = points;
  const auto n = static_cast<Index>(points.size());
  is_gone_.assign(points.size(), 0);
  place_in_slot_.resize(points.size());
  slot_of_place_.resize(points.size());
  std::iota(place_in_slot_.begin(), place_in_slot_.end(), 0);
  leaves_ = static_cast<Index>(std::bit_ceil((points.size() + slots_in_leaf - 1) / slots_in_leaf));
  nodes_.assign(2 * static_cast<std::size_t>(leaves_), {});
  sort(1, 0, leaves_ * slots_in_leaf);
  for (Index slot = 0; slot < n; ++slot) slot_of_place_[place_in_slot_[slot]] = slot;
  for (Index i = 0; i < leaves_; ++i) nodes_[leaves_ + i] = leaf(i);
  for (Index node = leaves_; node-- > 1;) gather(node);
}

/// Sorts the slots of a node into its leaves.
void CornerTree::sort(Index node, Index begin, Index end) {
  const auto n = static_cast<Index>(points_.size());
  const Index middle = begin + (end - begin) / 2;
  const auto first = place_in_slot_.begin();
  if (node >= leaves_) {  // by place: what std::nth_element leaves depends on the standard library
    std::sort(first + std::min(begin, n), first + std::min(end, n));
    return;
  }
  if (middle >= n) return sort(2 * node, begin, middle);
  Box box;
  for (Index slot = begin; slot < std::min(end, n); ++slot) box.extend(points_[place_in_slot_[slot]]);
  int axis = 0;
  (box.hi - box.lo).maxCoeff(&axis);
  std::nth_element(first + begin, first + middle, first + std::min(end, n),
                   [&](Index a, Index b) { return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b); });
  sort(2 * node, begin, middle);
  sort(2 * node + 1, middle, end);
}

CornerTree::Node CornerTree::leaf(Index number) const {
  Node node;
  const Index end = std::min(static_cast<Index>(points_.size()), (number + 1) * slots_in_leaf);
  for (Index slot = number * slots_in_leaf; slot < end; ++slot) {
    const Index place = place_in_slot_[slot];
    if (!holds(place)) continue;
    node.box.extend(points_[place]);
    node.last = std::max(node.last, place);
  }
  return node;
}

void CornerTree::gather(Index node) {
  nodes_[node] = nodes_[2 * node];
  nodes_[node].box.extend(nodes_[2 * node + 1].box);
  nodes_[node].last = std::max(nodes_[node].last, nodes_[2 * node + 1].last);
}

void CornerTree::remove(Index place) {
  is_gone_[place] = 1;
  const Index number = slot_of_place_[place] / slots_in_leaf;
  nodes_[leaves_ + number] = leaf(number);
  for (Index node = (leaves_ + number) / 2; node > 0; node /= 2) gather(node);
}

Index CornerTree::find_inside(const Vec3& normal, Index a, Index b, Index c) const {
  const Shadow shadow(normal, points_[a], points_[b], points_[c]);
  const auto is_other_vertex = [&](Index place) {
    const Index v = corners_[place];
    return v != corners_[a] && v != corners_[b] && v != corners_[c];
  };
  std::array<Index, 64> open;  // one for each level of the tree, and one
  int count = 0;
  open[count++] = 1;
  while (count > 0) {
    const Index node = open[--count];
    if (node > 1 && (nodes_[node].last < 0 || shadow.misses(nodes_[node].box))) continue;
    if (node < leaves_) {
      const Index later = nodes_[2 * node].last > nodes_[2 * node + 1].last ? 2 * node : 2 * node + 1;
      open[count++] = later ^ 1;
      open[count++] = later;
      continue;
    }
    const Index begin = (node - leaves_) * slots_in_leaf;
    const Index end = std::min(static_cast<Index>(points_.size()), begin + slots_in_leaf);
    Index found = -1;
    for (Index slot = begin; slot < end; ++slot) {
      const Index place = place_in_slot_[slot];
      if (place > found && holds(place) && is_other_vertex(place) && shadow.contains(points_[place])) found = place;
    }
    if (found >= 0) return found;
  }
  return -1;
}

}  // namespace unsnarl
