#include "energy/arap_triangle.h"

#include <cmath>

namespace unsnarl {
namespace {

/// Below this ratio of the singular values of the fitted matrix the triangle is a segment, now or at rest, and only its
/// longer axis says where to turn (no unit)
constexpr double rank_one_ratio = 1e-12;

}  // namespace

ArapTriangle::ArapTriangle(const Positions& rest, std::span<const Triangle> triangles, double rotation_damping)
    : triangles_(triangles.begin(), triangles.end()), rotation_damping_(rotation_damping) {
  rest_edges_.reserve(triangles_.size());
  for (const Triangle& t : triangles_) {
    Eigen::Matrix3d e;
    for (int k = 0; k < 3; ++k) e.col(k) = rest.col(t[(k + 1) % 3]) - rest.col(t[k]);
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (e.col(k).squaredNorm() > e.col(longest).squaredNorm()) longest = k;
    }
    Vec3 u = e.col(longest);
    const double length = u.norm();
    u = length > 0 ? Vec3(u / length) : Vec3::UnitX();
    const Vec3 next = e.col((longest + 1) % 3);
    Vec3 v = next - next.dot(u) * u;
    const double height = v.norm();
    // Any second axis does for a triangle without area: its edges have no part along it.
    v = height > 0 ? Vec3(v / height) : u.unitOrthogonal();
    Eigen::Matrix<double, 2, 3> flat;
    for (int k = 0; k < 3; ++k) flat.col(k) = Eigen::Vector2d(e.col(k).dot(u), e.col(k).dot(v));
    rest_edges_.push_back(flat);
  }
}

Eigen::Matrix<double, 3, 2> ArapTriangle::fitted_rotation(const Eigen::Matrix3d& edges, Index t) const {
  // Closest matrix with orthonormal columns to S = sum_k e_k e0_k^T, from the square root of C = S^T S in closed form.
  const Eigen::Matrix<double, 3, 2> s = edges * rest_edges_[t].transpose();
  const double c00 = s.col(0).squaredNorm();
  const double c11 = s.col(1).squaredNorm();
  const double c01 = s.col(0).dot(s.col(1));
  const double root_det = s.col(0).cross(s.col(1)).norm();
  const double trace = c00 + c11;
  if (root_det > rank_one_ratio * trace) {
    const double root_trace = std::sqrt(trace + 2 * root_det);
    Eigen::Matrix2d inverse_root;
    inverse_root << c11 + root_det, -c01, -c01, c00 + root_det;
    return s * (inverse_root / (root_det * root_trace));
  }
  if (trace > 0) return s / std::sqrt(trace);
  return Eigen::Matrix<double, 3, 2>::Zero();
}

Eigen::Matrix3d ArapTriangle::edges(const Positions& x, Index t) const {
  const Triangle& f = triangles_[t];
  Eigen::Matrix3d e;
  for (int k = 0; k < 3; ++k) e.col(k) = x.col(f[(k + 1) % 3]) - x.col(f[k]);
  return e;
}

double ArapTriangle::value(const Positions& x, Index t) const {
  Eigen::Matrix3d e = edges(x, t);
  e -= fitted_rotation(e, t) * rest_edges_[t];
  return 0.5 * edge_weight * e.squaredNorm();
}

double ArapTriangle::linearise(const Positions& x, Index t, double weight, Positions& gradient,
                               HessianTerms& hessian) const {
  Eigen::Matrix3d e = edges(x, t);
  HessianTerms::Strain& strain = hessian.strains.emplace_back();
  strain.vertices = triangles_[t];
  strain.rotation = fitted_rotation(e, t);
  strain.turn = HessianTerms::Strain::turn_of(rest_edges_[t]);
  strain.stiffness = weight * edge_weight;
  strain.uniform = rotation_damping_;
  e -= strain.rotation * rest_edges_[t];
  for (int k = 0; k < 3; ++k) gradient.col(triangles_[t][k]) += weight * edge_weight * (e.col((k + 2) % 3) - e.col(k));
  return 0.5 * weight * edge_weight * e.squaredNorm();
}

}  // namespace unsnarl
