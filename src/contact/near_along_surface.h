#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "geometry/types.h"
#include "mesh/adjacency.h"

namespace unsnarl {

/// Whether a way over the surface joins two triangles that does not leave a ball: however the surface is cut into
/// triangles. Ways go from triangle to triangle through the edges that reach into the ball.
class NearAlongSurface {
 public:
  /// `edges`: of the triangles. The arguments must outlive this.
  NearAlongSurface(std::span<const Triangle> triangles, const Positions& x, const EdgeTable& edges);

  /// Ways begin at this triangle from now on.
  void start(Index from);
  Index from() const { return from_; }
  /// Whether such a way leads to a triangle. Precondition: both triangles reach into the ball.
  bool joins(Index to, const Vec3& centre, double radius);
  /// The same of the ball around the middle of the first triangle; cheap where many are asked for.
  bool reaches(Index to, double radius);

 private:
  using Entry = std::pair<double, Index>;
  bool joins_exactly(Index to, const Vec3& centre, double radius);
  double distance_to(Index edge, const Vec3& point) const;

  std::span<const Triangle> triangles_;
  const Positions& x_;
  const EdgeTable& edges_;
  Index from_ = -1;
  Vec3 middle_ = Vec3::Zero();  // of the first triangle
  std::vector<double> radius_;  // per triangle: of the smallest ball around the middle so far; infinite: none yet
  std::vector<Index> met_;      // triangles with such a ball
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front_;
  std::vector<std::uint8_t> is_seen_;  // per triangle, while one ball is searched
  std::vector<Index> seen_;
};

}  // namespace unsnarl
