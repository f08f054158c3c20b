#pragma once

#include <span>
#include <vector>

#include "applications/routes/segments.h"

namespace unsnarl {

/// An obstacle that moves, in steps of time.
class MovingObstacle {
 public:
  MovingObstacle(const RoutePlan& plan, int obstacle, Index steps);

  /// A part of a step in which the obstacle moves evenly.
  struct Piece {
    double from = 0, to = 1;  // shares of the step
    Vec3 offset_from = Vec3::Zero(), offset_to = Vec3::Zero();
  };
  std::span<const Piece> pieces(Index step) const;

  const ObstacleTriangles& triangles() const { return triangles_; }
  /// Whether something that moves straight and evenly from p to q in this step stays at least this far away.
  bool is_clear(Index step, const Vec3& p, const Vec3& q, double distance) const;
  /// The box of all places where it is at some time.
  const Box& reach() const { return reach_; }

 private:
  ObstacleTriangles triangles_;
  std::vector<Piece> pieces_;
  std::vector<Index> first_piece_;  // of each step, and the end
  Box reach_;
};

/// Those obstacles of a plan that move and have faces.
std::vector<MovingObstacle> moving_obstacles(const RoutePlan& plan, Index steps);

/// From p to q as the obstacle sees it in this piece of the step.
std::array<Vec3, 2> seen_in(const MovingObstacle::Piece& piece, const Vec3& p, const Vec3& q);

}  // namespace unsnarl
