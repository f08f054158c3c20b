#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contact/face_tree.h"
#include "contact/moving_intersections.h"
#include "geometry/types.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Exact class of the pair of triangles (a, b), or nothing where they meet only in the hull of the vertices they share.
bool intersects(const Positions& x, const Triangle& a, const Triangle& b, PairClass& kind);

/// Finds which triangles of a set intersect, and which are near a place, while their vertices move. The tree is built
/// once. If few triangles move, the cost grows with their number, apart from one pass over all vertices and triangles.
class IntersectionFinder {
 public:
  /// Pairs of two triangles >= active_count are skipped (obstacles among themselves), and those that pass through each
  /// other. The triangles must outlive the finder.
  explicit IntersectionFinder(std::span<const Triangle> triangles, Passing passing = {});
  IntersectionFinder(std::span<const Triangle> triangles, Index active_count, Passing passing = {});

  /// Says that the surface will move as a whole, a little at a time: find() then lists the pairs that are near each
  /// other and follows them, which is faster and takes more memory than the surface itself.
  void expect_small_steps() { expects_small_steps_ = true; }

  /// All intersecting pairs at x, a < b, sorted. Decided by exact predicates; only triangles that moved since the last
  /// call are tested again. Same result at any thread count. Throws WorkStopped soon after `stop` says so.
  std::vector<IntersectingPair> find(const Positions& x, const std::function<bool()>& stop = {});

  /// What visit() calls.
  struct PairVisitor {
    std::function<bool(const IntersectingPair&)> keep;  ///< whether to take an intersecting pair; empty: take all
    std::function<void(std::span<const IntersectingPair>)> take;  ///< gets a block of pairs
    std::function<bool()> stop;                                   ///< may be empty
  };
  /// The same pairs in blocks and in no order, so that memory does not follow their number; none is remembered. `keep`
  /// is called by many threads, `take` by one at a time. Throws WorkStopped soon after `stop` says so.
  void visit(const Positions& x, const PairVisitor& visitor);

  /// Takes over that these are all intersecting pairs at x, as find() would return them.
  void start_from(const Positions& x, std::vector<IntersectingPair> pairs);

  /// Takes over the positions for query().
  void move(const Positions& x);
  /// The same where only these triangles (any order, with repetitions) may have moved.
  void move(const Positions& x, std::span<const Index> triangles);
  /// Appends the triangles whose boxes, where they are now, overlap one around `box`: all that reach into it, and some
  /// that only come near; each once, unsorted. Safe from many threads.
  void query(const Box& box, std::vector<Index>& found) const;

  std::span<const Triangle> triangles() const { return triangles_; }

 private:
  /// Triangles, each once, in the order in which they were added.
  class Some {
   public:
    void reset(std::size_t count) { items_.clear(), is_in_.assign(count, 0); }
    void add(Index t) {
      if (!is_in_[t]) items_.push_back(t);
      is_in_[t] = 1;
    }
    void clear() {
      for (Index t : items_) is_in_[t] = 0;
      items_.clear();
    }
    bool has(Index t) const { return is_in_[t] != 0; }
    std::span<const Index> items() const { return items_; }

   private:
    std::vector<Index> items_;
    std::vector<std::uint8_t> is_in_;
  };

  /// Every call that changes the state begins and ends with these. If an exception came between them, the next call
  /// discards the state and starts again.
  void begin_change();
  void end_change() { is_changing_ = false; }
  /// Takes over the positions; the tree is left as it is.
  void note(const Positions& x);
  void update_tree();
  /// The intersecting ones of the pairs that the tree visits, without those for which skip(i, j) is true.
  template <class Skip>
  std::vector<IntersectingPair> decide(const std::function<bool()>& stop, Skip&& skip) const;
  /// Calls found(task, pair) for those that intersect.
  template <class Skip, class Found>
  void decide_each(const std::function<bool()>& stop, Skip&& skip, Found&& found) const;
  /// Makes the tree and the fans ready for a look at all pairs, those that share a vertex fan by fan where that tells.
  void prepare_all();

  std::span<const Triangle> triangles_;
  Index active_count_;
  Passing passing_;
  bool expects_small_steps_ = false;
  bool is_changing_ = false;
  FaceTree tree_;
  Some outside_tree_;                          // triangles that have moved since it was updated
  Positions x_;                                // the present positions
  std::vector<IntersectingPair> pairs_;        // as they were last decided
  bool is_all_undecided_ = true;               // all pairs have to be decided again; otherwise
  Some undecided_;                             // the pairs of these triangles have to be
  bool has_only_undecided_active_ = false;     // the tree's active triangles are the undecided ones
  int decided_as_a_whole_ = 0;                 // how many times all pairs were decided
  std::optional<VertexFans> fans_;             // set when all pairs are decided for the first time
  std::optional<MovingIntersections> moving_;  // takes the fans over when that happens often
};

}  // namespace unsnarl
