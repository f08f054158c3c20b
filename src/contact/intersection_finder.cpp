#include "contact/intersection_finder.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <mutex>
#include <utility>

#include "contact/stop_check.h"
#include "geometry/parallel_lists.h"
#include "geometry/triangle_intersection.h"

namespace unsnarl {
namespace {

/// Triangles that moved are looked up one by one where they are fewer than this share of all, or of the active ones (no
/// unit)
constexpr double few_moved = 0.25;
/// A surface that moved as a whole this many times is expected to do so again (unit: times)
constexpr int seldom = 2;
/// A task of the tree hands over pairs in blocks of this size (unit: pairs)
constexpr std::size_t pairs_a_block = 1024;
/// Pairs of overlapping boxes that are decided between two looks at the clock, about a tenth of a second (unit: pairs)
constexpr std::uint32_t pairs_between_looks = 1 << 18;

bool is_few(std::size_t count, std::size_t of) {
  return static_cast<double>(count) < few_moved * static_cast<double>(of);
}

TrianglePoints rotated(const Positions& x, const Triangle& t, int first) {
  return {x.col(t[first]), x.col(t[(first + 1) % 3]), x.col(t[(first + 2) % 3])};
}

/// Whether two triangles share a vertex of an unfolded fan, so that they do not intersect. Without branches: most pairs
/// of a check come here, in no order, so that branches would be mispredicted.
bool share_an_unfolded_fan(const VertexFans& fans, const Triangle& a, const Triangle& b) {
  bool share = false;
  for (Index v : a) share |= ((v == b[0]) | (v == b[1]) | (v == b[2])) & fans.is_unfolded(v);
  return share;
}

}  // namespace

bool intersects(const Positions& x, const Triangle& a, const Triangle& b, PairClass& kind) {
  // Nearly all pairs of a check share one vertex or none; these cases are decided first.
  unsigned equal = 0;  // bit 3 k + l: corner k of a is corner l of b
  for (unsigned k = 0; k < 3; ++k)
    for (unsigned l = 0; l < 3; ++l) equal |= static_cast<unsigned>(a[k] == b[l]) << (3 * k + l);
  std::array<int, 3> shared = {-1, -1, -1};  // corner of b that corner k of a is
  Meeting meeting;
  if (equal == 0) {
    kind = PairClass::disjoint;
    meeting = triangles_meet(rotated(x, a, 0), rotated(x, b, 0));
  } else if ((equal & (equal - 1)) == 0) {  // a single bit; counting bits is a call on older processors
    const int bit = std::countr_zero(equal), corner_a = bit / 3, corner_b = bit % 3;
    shared[corner_a] = corner_b;
    kind = PairClass::one_vertex;
    meeting = triangles_meet_beyond_vertex(rotated(x, a, corner_a), rotated(x, b, corner_b));
  } else {
    int shared_count = 0, corner_a = 0, corner_b = 0, sum_a = 0, sum_b = 0;
    for (int k = 0; k < 3; ++k) {
      const unsigned row = equal >> (3 * k) & 7;
      if (row == 0) continue;
      const int l = std::countr_zero(row);
      shared[k] = l;
      corner_a = k, corner_b = l;
      sum_a += k, sum_b += l;
      ++shared_count;
    }
    if (shared_count >= 2 && (uses_a_vertex_twice(a) || uses_a_vertex_twice(b))) {
      kind = PairClass::degenerate;
      return degenerate_triangles_meet(rotated(x, a, 0), rotated(x, b, 0), shared);
    }
    if (shared_count == 3) {
      kind = PairClass::duplicate;
      return true;
    }
    if (shared_count == 1) {  // with a vertex that b uses twice
      kind = PairClass::one_vertex;
      meeting = triangles_meet_beyond_vertex(rotated(x, a, corner_a), rotated(x, b, corner_b));
    } else {
      kind = PairClass::folded;
      const int apex_a = 3 - sum_a, apex_b = 3 - sum_b;
      const Vec3 u = x.col(a[(apex_a + 1) % 3]), v = x.col(a[(apex_a + 2) % 3]);
      meeting = triangles_fold_flat({u, v, x.col(a[apex_a])}, {u, v, x.col(b[apex_b])});
    }
  }
  if (meeting != Meeting::ask_degenerate) return meeting == Meeting::yes;
  kind = PairClass::degenerate;
  return degenerate_triangles_meet(rotated(x, a, 0), rotated(x, b, 0), shared);
}

IntersectionFinder::IntersectionFinder(std::span<const Triangle> triangles, Passing passing)
    : IntersectionFinder(triangles, static_cast<Index>(triangles.size()), passing) {}

IntersectionFinder::IntersectionFinder(std::span<const Triangle> triangles, Index active_count, Passing passing)
    : triangles_(triangles), active_count_(active_count), passing_(passing), tree_(triangles, active_count) {}

void IntersectionFinder::begin_change() {
  if (is_changing_) {
    const bool expects_small_steps = expects_small_steps_;
    *this = IntersectionFinder(triangles_, active_count_, passing_);
    expects_small_steps_ = expects_small_steps;
  }
  is_changing_ = true;
}

void IntersectionFinder::move(const Positions& x) {
  begin_change();
  note(x);
  update_tree();
  end_change();
}

void IntersectionFinder::move(const Positions& x, std::span<const Index> triangles) {
  if (is_changing_ || x_.cols() != x.cols()) return move(x);
  begin_change();
  for (Index t : triangles) {
    for (Index v : triangles_[t]) x_.col(v) = x.col(v);
    undecided_.add(t);
    outside_tree_.add(t);
  }
  update_tree();
  end_change();
}

void IntersectionFinder::start_from(const Positions& x, std::vector<IntersectingPair> pairs) {
  begin_change();
  note(x);
  update_tree();
  undecided_.clear();
  is_all_undecided_ = false;
  pairs_ = std::move(pairs);
  end_change();
}

void IntersectionFinder::note(const Positions& x) {
  if (x_.cols() != x.cols()) {
    x_ = x;
    tree_.update(x);
    undecided_.reset(triangles_.size());
    outside_tree_.reset(triangles_.size());
    is_all_undecided_ = true;
    return;
  }
  std::vector<std::uint8_t> vertex_moved(static_cast<std::size_t>(x.cols()));
  bool any = false;
  for (Index v = 0; v < x.cols(); ++v) {
    vertex_moved[v] = x.col(v) != x_.col(v);
    any |= vertex_moved[v] != 0;
  }
  if (!any) return;
  x_ = x;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& corners = triangles_[t];
    if (!(vertex_moved[corners[0]] | vertex_moved[corners[1]] | vertex_moved[corners[2]])) continue;
    undecided_.add(static_cast<Index>(t));
    outside_tree_.add(static_cast<Index>(t));
  }
}

void IntersectionFinder::update_tree() {
  const std::span<const Index> moved = outside_tree_.items();
  if (moved.empty()) return;
  if (is_few(moved.size(), triangles_.size()))
    tree_.update(x_, moved);
  else
    tree_.update(x_);
  outside_tree_.clear();
}

void IntersectionFinder::query(const Box& box, std::vector<Index>& found) const {
  tree_.query(box, [&](Index t) { found.push_back(t); });
}

template <class Skip, class Found>
void IntersectionFinder::decide_each(const std::function<bool()>& stop, Skip&& skip, Found&& found) const {
  StopCheck check(stop, static_cast<std::size_t>(tree_.task_count()), pairs_between_looks);
  tree_.self_pairs([&](Index task, Index i, Index j) {
    check.step(task);
    if (i >= active_count_ || skip(i, j) || !passing_.meet(triangles_, i, j)) return;
    PairClass kind;
    if (intersects(x_, triangles_[i], triangles_[j], kind)) found(task, IntersectingPair{i, j, kind});
  });
}

template <class Skip>
std::vector<IntersectingPair> IntersectionFinder::decide(const std::function<bool()>& stop, Skip&& skip) const {
  std::vector<std::vector<IntersectingPair>> found(tree_.task_count());
  decide_each(stop, skip, [&](Index task, const IntersectingPair& pair) { found[task].push_back(pair); });
  std::vector<IntersectingPair> pairs;
  join_lists(std::move(found), pairs);
  return pairs;
}

void IntersectionFinder::prepare_all() {
  update_tree();
  if (has_only_undecided_active_) tree_.set_active();
  has_only_undecided_active_ = false;
  if (!fans_) fans_.emplace(triangles_, active_count_, static_cast<Index>(x_.cols()));
  fans_->update(x_);
}

void IntersectionFinder::visit(const Positions& x, const PairVisitor& visitor) {
  begin_change();
  note(x);
  prepare_all();
  is_all_undecided_ = true;
  std::mutex taking;
  std::vector<std::vector<IntersectingPair>> blocks(tree_.task_count());
  const auto hand_over = [&](std::vector<IntersectingPair>& block) {
    const std::lock_guard lock(taking);
    if (!block.empty()) visitor.take(block);
    block.clear();
  };
  decide_each(
      visitor.stop, [&](Index i, Index j) { return share_an_unfolded_fan(*fans_, triangles_[i], triangles_[j]); },
      [&](Index task, const IntersectingPair& pair) {
        if (visitor.keep && !visitor.keep(pair)) return;
        blocks[task].push_back(pair);
        if (blocks[task].size() == pairs_a_block) hand_over(blocks[task]);
      });
  for (std::vector<IntersectingPair>& block : blocks) hand_over(block);
  end_change();
}

std::vector<IntersectingPair> IntersectionFinder::find(const Positions& x, const std::function<bool()>& stop) {
  begin_change();
  note(x);
  const std::size_t undecided = undecided_.items().size();
  is_all_undecided_ |= undecided > 0 && !is_few(undecided, static_cast<std::size_t>(active_count_));
  if (is_all_undecided_ && expects_small_steps_ && decided_as_a_whole_ >= seldom && !tree_.is_turned()) {
    if (!moving_) moving_.emplace(triangles_, active_count_, std::move(*fans_), passing_);
    pairs_ = moving_->find(x_);
  } else if (is_all_undecided_) {
    ++decided_as_a_whole_;
    prepare_all();
    pairs_ =
        decide(stop, [&](Index i, Index j) { return share_an_unfolded_fan(*fans_, triangles_[i], triangles_[j]); });
  } else if (!undecided_.items().empty()) {
    update_tree();
    tree_.set_only_active(undecided_.items());
    has_only_undecided_active_ = true;
    std::vector<IntersectingPair> pairs = decide(stop, [](Index, Index) { return false; });
    std::copy_if(pairs_.begin(), pairs_.end(), std::back_inserter(pairs),
                 [&](const IntersectingPair& pair) { return !undecided_.has(pair.a) && !undecided_.has(pair.b); });
    pairs_ = std::move(pairs);
  }
  std::sort(pairs_.begin(), pairs_.end());
  undecided_.clear();
  is_all_undecided_ = false;
  end_change();
  return pairs_;
}

}  // namespace unsnarl
