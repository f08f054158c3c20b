#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <span>
#include <vector>

#include "applications/routes/moving_obstacles.h"
#include "applications/routes/route_chains.h"
#include "applications/routes/segments.h"
#include "geometry/parallel_sums.h"

namespace unsnarl {

struct RouteEnergySettings {
  /// Stiffness of a route against bending. A free corner then turns no tighter than the radius: under the tension T, a
  /// rod of stiffness B that is folded over has a radius of at least sqrt(B / 4 T) (unit: tension radius^2)
  double stiffness = 4;
  double swelling = 1;  ///< Tubes have this share of their radius, in (0, 1] (no unit)
  /// Tubes push each other away from this far beyond the needed distance on [E200] (unit: needed distance)
  double cushion = 0.05;
  double contact = 0;  ///< weight of tubes that push each other; 0: they may overlap
  double turn = 1;     ///< Weight against turns that are too tight (no unit)
  /// Distances needed are never passed (the start must keep them); otherwise, passing them costs.
  bool strict = false;
  bool strict_turns = false;  ///< the same of the tightest turns
  double obstacle = 0.05;     ///< Weight of obstacles, whose distance is never passed (no unit)
  double turn_from = 0.85;    ///< Turns count from this on (unit: the tightest one allowed)
  /// Weight of the speed that is allowed, which is never passed (no unit)
  double pace = 0.05;
  double pace_from = 0.85;  ///< Speed counts from this on (unit: the one allowed)
};

/// How near routes are to what is not allowed.
struct RouteMargins {
  double contact = 2;  ///< smallest distance of segments / needed; 2: none is near
  double turn = 0;     ///< largest turn, 1: just allowed
};

/// Elastic curves under tension with tubes that push: sums of, in lengths,
/// - edges e of rest length h: |e|^2 / (2 h); bends: stiffness r^2 |second difference|^2 / (2 h^3);
/// - pairs of segments with needed distance R: (h_i h_j / R) contact p(d / R); in time only pairs of the same time, and
///   the mean of h_i and h_j in place of h_i h_j / R;
/// - pairs of segments and faces of obstacles: h obstacle p(d / r); p is quadratic or the barrier of Incremental
///   Potential Contact, 0 from 1 + cushion on;
/// - turns t (see RouteFindings::turn), h turn p, from `turn_from` on;
/// - edges beside the longest that an agent's speed allows, h pace p, from `pace_from` on.
/// The gradient is zero at pinned vertices, and in z for planar agents. Vertices where an agent stands move as one:
/// each has the mean of their gradients. There, neither bends nor turns count.
class RouteEnergy {
 public:
  RouteEnergy(const RouteChains& chains, const ObstacleTriangles& obstacles,
              std::span<const MovingObstacle> moving = {});

  RouteEnergySettings settings;  ///< after a change of distances, call forget_neighbours()
  void forget_neighbours() { near_at_.resize(3, 0); }

  /// Infinite where a distance or turn that must not be passed is.
  double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient);
  RouteMargins margins(const Eigen::VectorXd& x);
  /// Makes precondition() fit the curvature of the energy at x.
  void factorise(const Eigen::VectorXd& x);
  void precondition(const Eigen::VectorXd& v, Eigen::VectorXd& out) const;

 private:
  using Points = Eigen::Map<const Positions>;
  struct Pair {
    Index a, b;  // segments
  };
  /// A segment and a triangle, of an obstacle that stands or, in a piece of the segment's step, of one that moves.
  struct ObstaclePair {
    Index segment = 0;
    const std::array<Vec3, 3>* triangle = nullptr;
    const MovingObstacle::Piece* piece = nullptr;  // null: it stands
  };
  /// A value with its first two derivatives.
  struct Push {
    double value = 0, slope = 0, curvature = 0;
  };
  Push push_of(double excess, bool is_strict) const;
  double reach(Index segment) const;
  double slack(Index chain) const { return 0.25 * chains_.chains[chain].radius; }
  void find_neighbours(const Points& x);
  Closest closest_pair(const Points& x, const Pair& pair) const;
  /// Whether two pinned vertices are closest: that is looked at before, and does not change.
  bool is_constant(const Pair& pair, const Closest& closest) const;
  ClosestToTriangle closest_obstacle(const Points& x, const ObstaclePair& pair) const;
  /// The same of a segment from vertex v and a triangle.
  bool is_constant(Index v, const ClosestToTriangle& closest) const;
  double needed(const Pair& pair) const;
  /// Factor of a pair's energy. In space a segment is near many segments of another route, in time near one.
  double weight_of(const Pair& pair) const;
  double elastic(const Points& x, Positions& gradient) const;
  double turns(const Points& x, Positions& gradient) const;
  double paces(const Points& x, Positions& gradient) const;
  double contacts(const Points& x, Positions& gradient);
  double obstacles(const Points& x, Positions& gradient);

  const RouteChains& chains_;
  const ObstacleTriangles& triangles_;
  std::span<const MovingObstacle> moving_;
  Positions near_at_;  // where the pairs were found; empty: they are to be found anew
  std::vector<Pair> pairs_;
  std::vector<ObstaclePair> obstacle_pairs_;
  ScatteredSum sum_;
  std::vector<Index> free_;  // number of each vertex among those not pinned, one for those of a stand; or -1
  Index free_count_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace unsnarl
