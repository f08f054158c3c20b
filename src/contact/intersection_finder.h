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

/// Knows where the triangles of a set are while their vertices move: which of them intersect, and which are near a
/// place. The tree is built once; where few triangles move, the cost follows their number, but for a look at every
/// vertex and triangle.
class IntersectionFinder {
 public:
  /// Pairs of two triangles >= active_count are skipped (obstacles among themselves), and those of two groups. The
  /// triangles and groups must outlive the finder.
  explicit IntersectionFinder(std::span<const Triangle> triangles, VertexGroups groups = {});
  IntersectionFinder(std::span<const Triangle> triangles, Index active_count, VertexGroups groups = {});

  /// All intersecting pairs at x, a < b, sorted. Decided by exact predicates, anew for what has moved since the last
  /// time. Same result at any thread count. Throws WorkStopped soon after `stop` says so.
  std::vector<IntersectingPair> find(const Positions& x, const std::function<bool()>& stop = {});

  /// Takes part of visit().
  struct PairVisitor {
    std::function<bool(const IntersectingPair&)> keep;            ///< of those that intersect; empty: all
    std::function<void(std::span<const IntersectingPair>)> take;  ///< a block of those kept
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

  /// Every call that changes something begins and ends with these. Where an exception came between them, nothing of
  /// what is here can be trusted: the next call begins anew.
  void begin_change();
  void end_change() { is_changing_ = false; }
  /// Takes over the positions, but for the tree.
  void note(const Positions& x);
  void update_tree();
  /// Those pairs that the tree visits, but for those that skip(i, j) is true of.
  template <class Skip>
  std::vector<IntersectingPair> decide(const std::function<bool()>& stop, Skip&& skip) const;
  /// Calls found(task, pair) for those that intersect.
  template <class Skip, class Found>
  void decide_each(const std::function<bool()>& stop, Skip&& skip, Found&& found) const;
  /// Makes the tree and the fans ready for a look at all pairs, those that share a vertex fan by fan where that tells.
  void prepare_all();

  std::span<const Triangle> triangles_;
  Index active_count_;
  VertexGroups groups_;
  bool is_changing_ = false;
  FaceTree tree_;
  Some outside_tree_;                          // triangles that have moved since it was updated
  Positions x_;                                // now
  std::vector<IntersectingPair> pairs_;        // as they were last decided
  bool is_all_undecided_ = true;               // since then; or:
  Some undecided_;                             // triangles that have moved since then
  bool has_only_undecided_active_ = false;     // and not all active triangles
  int decided_as_a_whole_ = 0;                 // so many times
  std::optional<VertexFans> fans_;             // from the first of them on, or else in moving_
  std::optional<MovingIntersections> moving_;  // for more of these
};

}  // namespace unsnarl
