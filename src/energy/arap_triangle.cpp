#include "energy/arap_triangle.h"

#include <cmath>
#include <numbers>

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

double ArapTriangle::triangle_energy(const Positions& x, Index t) const {
  Eigen::Matrix3d e = edges(x, t);
  e -= fitted_rotation(e, t) * rest_edges_[t];
  return 0.5 * weight_ * e.squaredNorm();
}

// The three edge vectors sum to zero, so their squares are those of two orthonormal combinations:
// a = (e_0 - e_1) / sqrt 2 = (2 x_1 - x_0 - x_2) / sqrt 2,  b = (e_0 + e_1 - 2 e_2) / sqrt 6 = 3 (x_2 - x_0) / sqrt 6.
namespace {
constexpr double combine_a = std::numbers::sqrt2 / 2;
constexpr double combine_b = 1.2247448713915890;  // 3 / sqrt 6
constexpr double coefficient_a[3] = {-combine_a, 2 * combine_a, -combine_a};
constexpr double coefficient_b[3] = {-combine_b, 0, combine_b};
}  // namespace

double ArapTriangle::linearise(const Positions& x, Index t, Eigen::Matrix3d& forces, Strain& strain) const {
  Eigen::Matrix3d e = edges(x, t);
  const Eigen::Matrix<double, 2, 3>& e0 = rest_edges_[t];
  strain.rotation = fitted_rotation(e, t);
  const Eigen::Vector2d a = combine_a * (e0.col(0) - e0.col(1));
  const Eigen::Vector2d b = (e0.col(0) + e0.col(1) - 2 * e0.col(2)) * (combine_a / std::numbers::sqrt3);
  strain.turn = Eigen::Vector4d(-a[1], a[0], -b[1], b[0]).normalized();
  e -= strain.rotation * e0;
  for (int k = 0; k < 3; ++k) forces.col(k) = weight_ * (e.col((k + 2) % 3) - e.col(k));
  return 0.5 * weight_ * e.squaredNorm();
}

Eigen::Matrix3d ArapTriangle::Strain::apply(const Eigen::Matrix3d& v) const {
  const Vec3 a = combine_a * (2 * v.col(1) - v.col(0) - v.col(2));
  const Vec3 b = combine_b * (v.col(2) - v.col(0));
  Eigen::Vector4d y;
  y << rotation.transpose() * a, rotation.transpose() * b;
  y -= turn.dot(y) * turn;
  const Vec3 back_a = rotation * y.head<2>();
  const Vec3 back_b = rotation * y.tail<2>();
  Eigen::Matrix3d result;
  for (int k = 0; k < 3; ++k) result.col(k) = coefficient_a[k] * back_a + coefficient_b[k] * back_b;
  return result;
}

Eigen::Matrix3d ArapTriangle::Strain::block(int k) const {
  const double a = coefficient_a[k];
  const double b = coefficient_b[k];
  const Eigen::Vector2d t = a * turn.head<2>() + b * turn.tail<2>();
  return rotation * ((a * a + b * b) * Eigen::Matrix2d::Identity() - t * t.transpose()) * rotation.transpose();
}

double ArapTriangle::value(const Positions& x) const {
  double sum = 0;
  for (Index t = 0; t < size(); ++t) sum += triangle_energy(x, t);
  return sum;
}

double ArapTriangle::value_and_gradient(const Positions& x, double scale, Positions& g) const {
  double sum = 0;
  Eigen::Matrix3d forces;
  Strain strain;
  for (Index t = 0; t < size(); ++t) {
    sum += linearise(x, t, forces, strain);
    for (int k = 0; k < 3; ++k) g.col(triangles_[t][k]) += scale * forces.col(k);
  }
  return sum;
}

}  // namespace unsnarl
