#include "energy/bending.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/portable_math.h"

namespace unsnarl {

std::vector<BendingHinge> bending_hinges_of(std::span<const Triangle> triangles, const EdgeTable& edges) {
  std::vector<BendingHinge> hinges;
  const auto opposite = [&](Index t, const Edge& e) -> Index {
    for (Index v : triangles[t]) {
      if (v != e[0] && v != e[1]) return v;
    }
    return -1;
  };
  for (Index e = 0; e < static_cast<Index>(edges.edges.size()); ++e) {
    const auto at = edges.triangles_of_edge[e];
    for (std::size_t k = 1; k < at.size(); ++k) {
      const Edge& edge = edges.edges[e];
      const Index c = opposite(at[k - 1], edge);
      const Index d = opposite(at[k], edge);
      if (c < 0 || d < 0 || c == d) continue;
      hinges.push_back({edge[0], edge[1], c, d});
    }
  }
  return hinges;
}

double bending_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  const Vec3 e = x1 - x0;
  const Vec3 n1 = e.cross(x2 - x0);
  const Vec3 n2 = (x3 - x0).cross(e);
  const double length = e.norm();
  if (!(length > 0)) return 0;
  return portable::atan2(n1.cross(n2).dot(e) / length, n1.dot(n2));
}

double bending_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3,
                     Eigen::Matrix<double, 3, 4>& gradient) {
  const Vec3 e = x1 - x0;
  const Vec3 n1 = e.cross(x2 - x0);
  const Vec3 n2 = (x3 - x0).cross(e);
  const double length = e.norm();
  const double n1_2 = n1.squaredNorm();
  const double n2_2 = n2.squaredNorm();
  if (!(length > 0) || !(n1_2 > 0) || !(n2_2 > 0)) {
    gradient.setZero();
    return 0;
  }
  const Vec3 axis = e / length;
  const Vec3 u1 = n1 / n1_2;
  const Vec3 u2 = n2 / n2_2;
  gradient.col(0) = -(x2 - x1).dot(axis) * u1 - (x3 - x1).dot(axis) * u2;
  gradient.col(1) = (x2 - x0).dot(axis) * u1 + (x3 - x0).dot(axis) * u2;
  gradient.col(2) = -length * u1;
  gradient.col(3) = -length * u2;
  return portable::atan2(n1.cross(n2).dot(axis), n1.dot(n2));
}

Bending::Bending(const Positions& rest, const Positions& start, std::span<const BendingHinge> hinges,
                 const Options& options) {
  constexpr double turn = 2 * std::numbers::pi;  ///< A full turn in radians (fixed by geometry)
  for (const BendingHinge& hinge : hinges) {
    const Vec3 x0 = rest.col(hinge[0]), x1 = rest.col(hinge[1]), x2 = rest.col(hinge[2]), x3 = rest.col(hinge[3]);
    const double length = (x1 - x0).norm();
    const double area1 = 0.5 * (x1 - x0).cross(x2 - x0).norm();
    const double area2 = 0.5 * (x1 - x0).cross(x3 - x0).norm();
    const double height = length > 0 ? 2 * std::min(area1, area2) / length : 0;
    if (!(height > options.sliver * options.edge_length)) continue;
    const double height_rel = height / options.edge_length;
    const double weight =
        std::min(3 * length * length / (area1 + area2), options.stiffness_cap * height_rel * height_rel);
    const double at_start =
        bending_angle(start.col(hinge[0]), start.col(hinge[1]), start.col(hinge[2]), start.col(hinge[3]));
    double angle = bending_angle(x0, x1, x2, x3);
    angle += turn * std::round((at_start - angle) / turn);
    hinges_.push_back(hinge);
    weights_.push_back(weight);
    rest_angles_.push_back(angle);
  }
}

double Bending::value(const Positions& x, Index e) const {
  const BendingHinge& h = hinges_[e];
  const double r = bending_angle(x.col(h[0]), x.col(h[1]), x.col(h[2]), x.col(h[3])) - rest_angles_[e];
  return 0.5 * weights_[e] * r * r;
}

double Bending::linearise(const Positions& x, Index e, double weight, Positions& gradient,
                          HessianTerms& hessian) const {
  const BendingHinge& h = hinges_[e];
  HessianTerms::RankOne& term = hessian.rank_ones.emplace_back();
  const double r = bending_angle(x.col(h[0]), x.col(h[1]), x.col(h[2]), x.col(h[3]), term.g) - rest_angles_[e];
  term.vertices = h;
  term.stiffness = weight * weights_[e];
  for (int k = 0; k < 4; ++k) gradient.col(h[k]) += term.stiffness * r * term.g.col(k);
  return 0.5 * term.stiffness * r * r;
}

}  // namespace unsnarl
