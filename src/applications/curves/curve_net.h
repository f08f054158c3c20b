#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/curves.h"

namespace unsnarl {

/// One column a vertex: x, y.
using Points2 = Eigen::Matrix2Xd;
using Vec2 = Eigen::Vector2d;

/// The place on a segment nearest to p, as a fraction of it in [0, 1]; 0 for one without length.
inline double nearest_fraction(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double squared = d.squaredNorm();
  return squared > 0 ? std::clamp((p - a).dot(d) / squared, 0.0, 1.0) : 0.0;
}

inline double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  return (p - (a + nearest_fraction(p, a, b) * (b - a))).norm();
}

/// Curves as the solvers see them: vertices, which several curves may share, and chains of them.
struct CurveNet {
  struct Chain {
    std::vector<Index> vertices;
    bool closed = false;
    Index first_segment = 0;

    Index size() const { return static_cast<Index>(vertices.size()); }
    Index segment_count() const { return closed ? size() : size() - 1; }
    Index at(Index slot) const { return vertices[slot < size() ? slot : slot - size()]; }
  };

  Points2 rest;                      ///< where the vertices are in the input
  std::vector<Chain> chains;         ///< one a curve
  std::vector<Edge> segments;        ///< two vertices, in the order of the chain; chain after chain
  std::vector<Index> chain_of;       ///< one a segment
  std::vector<std::uint8_t> fixed;   ///< one a vertex: must not move
  std::vector<std::uint8_t> flags;   ///< one a vertex: fixed, and not only as an end of an open curve
  std::vector<std::uint8_t> pinned;  ///< fixed, or in more places than one: cannot change its place in a chain
  std::vector<double> weight;        ///< one a vertex: half the length of its segments at rest
  std::vector<double> room;          ///< one a vertex: more than this cannot be kept free around it; infinite: any
  double diagonal = 0;               ///< of the bounding box at rest

  Index slot_of(Index segment) const { return segment - chains[chain_of[segment]].first_segment; }
  Index vertex_count() const { return static_cast<Index>(rest.cols()); }
  Index segment_count() const { return static_cast<Index>(segments.size()); }
};

/// Curves on their way to be simple.
struct CurveState {
  Points2 x;                         ///< where the vertices are
  Points2 target;                    ///< where recovery pulls them to
  std::vector<std::uint8_t> turned;  ///< one a vertex: lies in a loop that was turned over
};

/// Places of the vertices along their chains, by the lengths of the segments at x.
struct ArcLengths {
  ArcLengths(const CurveNet& net, const Points2& x);
  /// Along the curve from vertex v to w, the shorter way around a closed one; infinite for vertices of two curves.
  double between(Index v, Index w) const;

  std::vector<double> arc;           ///< one a vertex: from the start of its chain
  std::vector<Index> chain_of;       ///< one a vertex, the last one of a shared vertex; -1: none
  std::vector<double> length;        ///< one a chain
  std::vector<std::uint8_t> closed;  ///< one a chain
};

/// Throws std::invalid_argument, naming curve and point, for what untangle_curves refuses.
void check_curves(std::span<const Curve> curves);

/// Adds a point to a curve where an open one ends on a segment, and finds the joints: an end of an open curve, and
/// every point within `distance` (plus the curve's tolerance) of it. Joined points take the same position, unless that
/// would leave a segment without length. Returns the joints; adds the number of points inserted.
std::vector<CurveJoint> join_ends(std::vector<Curve>& curves, double distance, std::size_t& inserted);

/// The joints whose points are at one position, bit for bit; one that is in several places becomes several, or none.
std::vector<CurveJoint> joints_at_one_position(std::span<const Curve> curves, std::span<const CurveJoint> joints);

/// Precondition: the points of a joint are at one position.
CurveNet make_net(std::span<const Curve> curves, std::span<const CurveJoint> joints, bool fix_ends);

/// The net with other chains of its vertices, as many and closed as before; segments and weights are made anew.
CurveNet with_chains(CurveNet net, std::vector<std::vector<Index>> chains);

/// The curves that the chains are now: with the positions x of their vertices, of which `fixed` says which the input
/// fixes; names and tolerances as in `curves`.
std::vector<Curve> with_positions(std::span<const Curve> curves, const CurveNet& net, const Points2& x);

/// The vertices that are in several places of chains, as joints of the curves that the chains are.
std::vector<CurveJoint> joints_of(const CurveNet& net);

/// "curve 3" or its name, for messages.
std::string name_of_curve(const Curve& curve, std::size_t number);

double diagonal_of(std::span<const Curve> curves);

}  // namespace unsnarl
