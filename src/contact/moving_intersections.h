#pragma once

#include <span>
#include <utility>
#include <vector>

#include "contact/motion_frames.h"
#include "contact/near_pairs.h"
#include "contact/vertex_fans.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Finds all intersecting pairs of a set of triangles that moves as a whole, a little at a time. Triangles that share a
/// vertex are decided fan by fan, the others where they are near each other and their motion since they were last found
/// apart may have brought them together.
class MovingIntersections {
 public:
  /// Pairs of two triangles >= active_count are skipped. The span must outlive this.
  MovingIntersections(std::span<const Triangle> triangles, Index active_count, Index vertex_count)
      : MovingIntersections(triangles, active_count, VertexFans(triangles, active_count, vertex_count), {}) {}
  /// `fans`: of the same triangles. Pairs that pass through each other are skipped too.
  MovingIntersections(std::span<const Triangle> triangles, Index active_count, VertexFans fans, Passing passing)
      : triangles_(triangles),
        active_count_(active_count),
        passing_(passing),
        near_(triangles, active_count, passing),
        frames_(triangles),
        fans_(std::move(fans)) {}

  /// All intersecting pairs at x, a < b, sorted. Decided by exact predicates. Same result at any thread count.
  std::vector<IntersectingPair> find(const Positions& x);

 private:
  /// Adds those of the near pairs [begin, end); keeps the clearances of the others.
  void add_near(const Positions& x, Index begin, Index end, std::vector<IntersectingPair>& found);
  /// Adds the pairs that share one of the vertices [begin, end).
  void add_joined(const Positions& x, Index begin, Index end, std::vector<IntersectingPair>& found) const;

  std::span<const Triangle> triangles_;
  Index active_count_;
  Passing passing_;
  NearPairs near_;
  MotionFrames frames_;
  VertexFans fans_;
};

}  // namespace unsnarl
