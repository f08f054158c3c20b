#include "energy/arap_triangle.h"

#include <cmath>

namespace unsnarl {
namespace {

// Below this ratio of the singular values of the fitted matrix, only its longer axis says where to turn: the triangle
// is a segment, at rest or now.
constexpr double rank_one_ratio = 1e-12;

}  // namespace

ArapTriangle::ArapTriangle(const Positions& rest, std::span<const Triangle> triangles, double weight)
    : triangles_(triangles.begin(), triangles.end()), weight_(weight) {
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

double ArapTriangle::triangle_energy(const Positions& x, Index t, Eigen::Matrix3d* forces) const {
  const Triangle& f = triangles_[t];
  const Eigen::Matrix<double, 2, 3>& e0 = rest_edges_[t];
  Eigen::Matrix3d e;
  for (int k = 0; k < 3; ++k) e.col(k) = x.col(f[(k + 1) % 3]) - x.col(f[k]);

  // Closest matrix with orthonormal columns to S = sum_k e_k e0_k^T, from the square root of C = S^T S in closed form.
  const Eigen::Matrix<double, 3, 2> s = e * e0.transpose();
  const double c00 = s.col(0).squaredNorm();
  const double c11 = s.col(1).squaredNorm();
  const double c01 = s.col(0).dot(s.col(1));
  const double root_det = s.col(0).cross(s.col(1)).norm();
  const double trace = c00 + c11;
  Eigen::Matrix<double, 3, 2> r;
  if (root_det > rank_one_ratio * trace) {
    const double root_trace = std::sqrt(trace + 2 * root_det);
    Eigen::Matrix2d inverse_root;
    inverse_root << c11 + root_det, -c01, -c01, c00 + root_det;
    r.noalias() = s * (inverse_root / (root_det * root_trace));
  } else if (trace > 0) {
    r = s / std::sqrt(trace);
  } else {
    r.setZero();
  }
  e.noalias() -= r * e0;
  if (forces) {
    for (int k = 0; k < 3; ++k) forces->col(k) = weight_ * (e.col((k + 2) % 3) - e.col(k));
  }
  return 0.5 * weight_ * e.squaredNorm();
}

double ArapTriangle::value(const Positions& x) const {
  double sum = 0;
  for (Index t = 0; t < size(); ++t) sum += triangle_energy(x, t, nullptr);
  return sum;
}

double ArapTriangle::value_and_gradient(const Positions& x, double scale, Positions& g) const {
  double sum = 0;
  Eigen::Matrix3d forces;
  for (Index t = 0; t < size(); ++t) {
    sum += triangle_energy(x, t, &forces);
    for (int k = 0; k < 3; ++k) g.col(triangles_[t][k]) += scale * forces.col(k);
  }
  return sum;
}

}  // namespace unsnarl
