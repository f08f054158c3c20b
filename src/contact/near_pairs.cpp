#include "contact/near_pairs.h"

#include <algorithm>

#include "geometry/parallel_lists.h"
#include "geometry/parallel_sums.h"
#include "mesh/adjacency.h"

namespace unsnarl {
namespace {

/// A task of a parallel loop has this many triangles (unit: triangles)
constexpr Index triangles_a_task = 2048;
/// A box is enlarged to hold its triangle for this many motions like the last one (unit: motions)
constexpr double motions = 12;
/// A box is enlarged by at least this much (unit: mean diagonal of the boxes)
constexpr double least_room = 0.03;
/// A box is enlarged by at most this much; a triangle that moves farther in one motion gets no room, since it would
/// leave the box at once (unit: mean diagonal of the boxes)
constexpr double most_room = 0.4;
/// Triangles that left their boxes are looked up one by one up to this share of all (no unit)
constexpr double few_left = 0.2;

bool contains(const Box& outer, const Box& inner) {
  return (outer.lo.array() <= inner.lo.array()).all() && (inner.hi.array() <= outer.hi.array()).all();
}

double motion(const Box& from, const Box& to) {
  return std::max((to.lo - from.lo).cwiseAbs().maxCoeff(), (to.hi - from.hi).cwiseAbs().maxCoeff());
}

}  // namespace

void NearPairs::update(const Positions& x) {
  const Index n = static_cast<Index>(triangles_.size());
  const bool is_new = boxes_.empty();
  boxes_.resize(n);
  padded_.resize(n);
  left_.resize(n);
  if (is_new) {
    for (Index t = 0; t < n; ++t) {
      boxes_[t] = box_of(x, triangles_[t]);
      length_ += boxes_[t].diagonal() / n;
    }
  }
  const double left = sum_in_chunks(n, triangles_a_task, [&](Index begin, Index end) {
    double count = 0;
    for (Index t = begin; t < end; ++t) {
      const Box box = box_of(x, triangles_[t]);
      left_[t] = is_new || !contains(padded_[t], box);
      if (left_[t]) {
        const double last = motion(boxes_[t], box) / length_;
        // Not a number where all boxes are points: no room then.
        padded_[t] = box.inflated(last <= most_room ? length_ * std::clamp(motions * last, least_room, most_room) : 0);
        ++count;
      }
      boxes_[t] = box;
    }
    return count;
  });
  if (left == 0) return;
  if (is_new) {
    bvh_.build(padded_);
    if (active_count_ < n) {
      std::vector<std::uint8_t> active(static_cast<std::size_t>(n), 0);
      std::fill(active.begin(), active.begin() + active_count_, std::uint8_t{1});
      bvh_.set_active(active);
    }
  } else {
    bvh_.refit(padded_);
  }
  if (left > few_left * n)
    look_for_all();
  else
    look_for_those_that_left();
}

bool NearPairs::is_wanted(Index a, Index b) const {
  return !share_a_vertex(triangles_[a], triangles_[b]) && passing_.meet(triangles_, a, b);
}

void NearPairs::look_for_all() {
  std::vector<Pair>().swap(pairs_);
  std::vector<std::vector<Pair>> found(bvh_.task_count());
  bvh_.self_pairs_parallel([&](Index task, Index i, Index j) {
    if (is_wanted(i, j)) found[task].push_back({std::min(i, j), std::max(i, j), {}});
  });
  join_lists(std::move(found), pairs_);
}

void NearPairs::look_for_those_that_left() {
  std::erase_if(pairs_, [&](const Pair& pair) { return left_[pair.a] || left_[pair.b]; });
  std::vector<Pair> found;
  gather_in_chunks(static_cast<Index>(triangles_.size()), found, [&](Index begin, Index end, std::vector<Pair>& list) {
    for (Index t = begin; t < end; ++t) {
      if (!left_[t]) continue;
      bvh_.query(padded_[t], [&](Index other) {
        // Two that left find each other twice.
        if (left_[other] && other <= t) return;
        if (t >= active_count_ && other >= active_count_) return;
        if (is_wanted(t, other)) list.push_back({std::min(t, other), std::max(t, other), {}});
      });
    }
  });
  pairs_.insert(pairs_.end(), found.begin(), found.end());
}

}  // namespace unsnarl
