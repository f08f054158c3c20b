#include "applications/isotopy/corner_removal.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "geometry/predicates.h"

namespace unsnarl {
namespace {

constexpr double out_of_reach = std::numeric_limits<double>::infinity();
constexpr double most_key = std::numeric_limits<double>::max();  ///< Of corners that can be removed (fixed by float64)

Sign turn_at(const Vec2& a, const Vec2& b, const Vec2& c) {
  return orient2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y());
}

class RemovalOrder {
 public:
  /// `side`: of the polygons' insides to which corners may move, 1 or -1; 0: to both sides.
  RemovalOrder(Corners corners, double side, const std::function<bool()>& stop)
      : c_(std::move(corners)), side_(side), stop_(stop) {
    const auto n = static_cast<Index>(c_.x.cols());
    for (Index v = 0; v < n; ++v)
      if (c_.is_corner[v] != 0) there_.push_back(v);
    key_.assign(n, out_of_reach);
    hindered_by_.assign(n, -1);
    hinders_.resize(n);
    for (const Index v : there_) {
      if (stop_()) return;
      rate(v);
    }
  }

  std::vector<CornerRemoval> all() {
    std::vector<CornerRemoval> made;
    while (!queue_.empty() && !stop_()) {
      const Index v = queue_.begin()->second;
      const CornerRemoval removal{c_.before[v], v, c_.after[v]};
      made.push_back(removal);
      remove(removal);
    }
    return made;
  }

 private:
  void remove(const CornerRemoval& removal) {
    const auto [before, v, after] = removal;
    unqueue(v);
    c_.is_corner[v] = 0;
    c_.after[before] = after;
    c_.before[after] = before;
    const Index polygon = c_.polygon[v];
    --c_.count[polygon];
    if (++removed_ * 2 > there_.size()) {
      there_.erase(std::remove_if(there_.begin(), there_.end(), [&](Index w) { return c_.is_corner[w] == 0; }),
                   there_.end());
      removed_ = 0;
    }
    std::vector<Index> again = std::move(hinders_[v]);
    hinders_[v].clear();
    again.insert(again.end(), {before, after});
    if (c_.count[polygon] == 3)
      for (const Index w : {before, after, c_.after[after]}) again.push_back(w);
    std::sort(again.begin(), again.end());
    again.erase(std::unique(again.begin(), again.end()), again.end());
    for (const Index w : again)
      if (c_.is_corner[w] != 0 && (hindered_by_[w] == v || c_.polygon[w] == polygon)) rate(w);
  }

  void unqueue(Index v) {
    if (key_[v] < out_of_reach) queue_.erase({key_[v], v});
    key_[v] = out_of_reach;
  }

  /// By how much the polygon would be shorter without corner v, over the distance to the nearest other corner [E194].
  /// The key changes only as corners beside it are removed, or the nearest one is.
  void rate(Index v) {
    unqueue(v);
    hindered_by_[v] = -1;
    if (c_.count[c_.polygon[v]] <= 3 || c_.is_kept[v] != 0) return;
    const CornerRemoval removal{c_.before[v], v, c_.after[v]};
    const Vec2 a = c_.x.col(removal.before), b = c_.x.col(v), c = c_.x.col(removal.after);
    const Sign turn = turn_at(a, b, c);
    // Curves that move along ears need room in them; a simple polygon of four corners or more always has one that is
    // not flat.
    if (side_ != 0 && turn * side_ <= 0) return;
    const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    double nearest = out_of_reach;
    Index hindrance = -1;
    bool is_free = true;
    for (const Index w : there_) {
      if (c_.is_corner[w] == 0 || w == removal.before || w == v || w == removal.after) continue;
      const Vec2 p = c_.x.col(w);
      const double off_x = std::max(low.x() - p.x(), p.x() - high.x()),
                   off_y = std::max(low.y() - p.y(), p.y() - high.y());
      if (std::max(off_x, off_y) > nearest) continue;
      const bool is_within =
          turn != 0 && turn * turn_at(a, b, p) >= 0 && turn * turn_at(b, c, p) >= 0 && turn * turn_at(c, a, p) >= 0;
      const double distance =
          is_within
              ? 0
              : std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
      if (!is_within && distance >= nearest) continue;
      nearest = distance;
      hindrance = w;
      if (is_within) {
        is_free = false;
        break;
      }
    }
    if (hindrance >= 0) {
      hindered_by_[v] = hindrance;
      hinders_[hindrance].push_back(v);
    }
    if (!is_free) return;
    const double shorter = (b - a).norm() + (c - b).norm() - (c - a).norm();
    key_[v] = nearest > 0 ? std::min(shorter / nearest, most_key) : most_key;
    queue_.insert({key_[v], v});
  }

  Corners c_;
  double side_;
  const std::function<bool()>& stop_;
  std::vector<Index> there_;  // the corners, and some that are removed
  std::size_t removed_ = 0;   // of them
  std::vector<double> key_;
  std::vector<Index> hindered_by_;           // the corner nearest to the triangle of each
  std::vector<std::vector<Index>> hinders_;  // and the other way around
  std::set<std::pair<double, Index>> queue_;
};

/// Whether a line along a side of triangle a parts b from it, but for an end of both.
bool is_parted_by(const Points2& x, const CornerRemoval& a, const CornerRemoval& b) {
  const std::array<Index, 3> of_a{a.before, a.corner, a.after}, of_b{b.before, b.corner, b.after};
  for (int k = 0; k < 3; ++k) {
    const Index i = of_a[k], j = of_a[(k + 1) % 3];
    Sign outside = -turn_at(x.col(i), x.col(j), x.col(of_a[(k + 2) % 3]));
    bool parts = true;
    for (const Index w : of_b) {
      if ((w == i || w == j) && w != a.corner && w != b.corner) continue;
      const Sign side = turn_at(x.col(i), x.col(j), x.col(w));
      if (outside == 0) outside = side;
      parts = parts && side != 0 && side == outside;
    }
    if (parts) return true;
  }
  return false;
}

}  // namespace

std::vector<CornerRemoval> remove_corners(Corners corners, const std::function<bool()>& stop) {
  return RemovalOrder(std::move(corners), 0, stop).all();
}

std::vector<CornerRemoval> remove_ears(Corners corners, Index polygon, double side, const std::function<bool()>& stop) {
  for (std::size_t v = 0; v < corners.is_corner.size(); ++v)
    if (corners.polygon[v] != polygon) corners.is_corner[v] = 0;
  return RemovalOrder(std::move(corners), side, stop).all();
}

std::vector<int> rounds_of(const Points2& x, const std::vector<CornerRemoval>& removals,
                           const std::function<bool()>& stop) {
  struct Box {
    Vec2 low, high;
  };
  std::vector<Box> boxes;
  std::vector<int> rounds;
  for (std::size_t i = 0; i < removals.size(); ++i) {
    if (stop()) return {};
    const Vec2 a = x.col(removals[i].before), b = x.col(removals[i].corner), c = x.col(removals[i].after);
    const Box box{a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
    int round = 0;
    for (std::size_t j = 0; j < i; ++j) {
      if (rounds[j] < round) continue;
      const bool boxes_meet = box.low.x() <= boxes[j].high.x() && boxes[j].low.x() <= box.high.x() &&
                              box.low.y() <= boxes[j].high.y() && boxes[j].low.y() <= box.high.y();
      if (boxes_meet && !is_parted_by(x, removals[i], removals[j]) && !is_parted_by(x, removals[j], removals[i]))
        round = rounds[j] + 1;
    }
    boxes.push_back(box);
    rounds.push_back(round);
  }
  return rounds;
}

}  // namespace unsnarl
