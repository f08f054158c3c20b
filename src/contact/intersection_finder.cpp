#include "contact/intersection_finder.h"

#include <algorithm>
#include <iterator>

#include "geometry/parallel_lists.h"
#include "geometry/triangle_intersection.h"

namespace unsnarl {
namespace {

/// Share of the triangles below which those that moved are worth telling apart.
constexpr double few = 0.25;

TrianglePoints rotated(const Positions& x, const Triangle& t, int first) {
  return {x.col(t[first]), x.col(t[(first + 1) % 3]), x.col(t[(first + 2) % 3])};
}

bool uses_a_vertex_twice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace

bool intersects(const Positions& x, const Triangle& a, const Triangle& b, PairClass& kind) {
  std::array<int, 3> shared = {-1, -1, -1};  // corner of b that corner k of a is
  int shared_count = 0, corner_a = 0, corner_b = 0, sum_a = 0, sum_b = 0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      if (a[k] == b[l]) {
        shared[k] = l;
        corner_a = k, corner_b = l;
        sum_a += k, sum_b += l;
        ++shared_count;
        break;
      }
  if (shared_count >= 2 && (uses_a_vertex_twice(a) || uses_a_vertex_twice(b))) {
    kind = PairClass::degenerate;
    return degenerate_triangles_meet(rotated(x, a, 0), rotated(x, b, 0), shared);
  }
  if (shared_count == 3) {
    kind = PairClass::duplicate;
    return true;
  }
  Meeting meeting;
  if (shared_count == 0) {
    kind = PairClass::disjoint;
    meeting = triangles_meet(rotated(x, a, 0), rotated(x, b, 0));
  } else if (shared_count == 1) {
    kind = PairClass::one_vertex;
    meeting = triangles_meet_beyond_vertex(rotated(x, a, corner_a), rotated(x, b, corner_b));
  } else {
    kind = PairClass::folded;
    const int apex_a = 3 - sum_a, apex_b = 3 - sum_b;
    const Vec3 u = x.col(a[(apex_a + 1) % 3]), v = x.col(a[(apex_a + 2) % 3]);
    meeting = triangles_fold_flat({u, v, x.col(a[apex_a])}, {u, v, x.col(b[apex_b])});
  }
  if (meeting != Meeting::ask_degenerate) return meeting == Meeting::yes;
  kind = PairClass::degenerate;
  return degenerate_triangles_meet(rotated(x, a, 0), rotated(x, b, 0), shared);
}

IntersectionFinder::IntersectionFinder(std::span<const Triangle> triangles)
    : IntersectionFinder(triangles, static_cast<Index>(triangles.size())) {}

IntersectionFinder::IntersectionFinder(std::span<const Triangle> triangles, Index active_count)
    : triangles_(triangles), active_count_(active_count), tree_(triangles, active_count) {}

bool IntersectionFinder::flag_moved(const Positions& x) {
  if (last_x_.cols() != x.cols() || triangles_.empty()) return false;
  std::vector<std::uint8_t> vertex_moved(static_cast<std::size_t>(x.cols()));
  for (Index v = 0; v < x.cols(); ++v) vertex_moved[v] = x.col(v) != last_x_.col(v);
  moved_.resize(triangles_.size());
  std::size_t count = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& corners = triangles_[t];
    moved_[t] = vertex_moved[corners[0]] | vertex_moved[corners[1]] | vertex_moved[corners[2]];
    count += moved_[t];
  }
  return static_cast<double>(count) < few * static_cast<double>(triangles_.size());
}

std::vector<IntersectingPair> IntersectionFinder::decide(const Positions& x) {
  std::vector<std::vector<IntersectingPair>> found(tree_.task_count());
  tree_.self_pairs([&](Index task, Index i, Index j) {
    PairClass kind;
    if (i < active_count_ && intersects(x, triangles_[i], triangles_[j], kind)) found[task].push_back({i, j, kind});
  });
  std::vector<IntersectingPair> pairs;
  join_lists(found, pairs);
  return pairs;
}

std::vector<IntersectingPair> IntersectionFinder::find(const Positions& x) {
  const bool few_moved = flag_moved(x);
  tree_.update(x);
  if (few_moved)
    tree_.watch(moved_);
  else if (watches_moved_)
    tree_.watch();
  watches_moved_ = few_moved;
  std::vector<IntersectingPair> pairs = decide(x);
  if (few_moved)
    std::copy_if(last_pairs_.begin(), last_pairs_.end(), std::back_inserter(pairs),
                 [&](const IntersectingPair& pair) { return !moved_[pair.a] && !moved_[pair.b]; });
  std::sort(pairs.begin(), pairs.end());
  last_x_ = x;
  last_pairs_ = pairs;
  return pairs;
}

}  // namespace unsnarl
