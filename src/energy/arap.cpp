#include "energy/arap.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/parallel.h"
#include "geometry/sort_unique.h"

namespace unsnarl {
namespace {

Eigen::Matrix3d from_quaternion(const Eigen::Vector4d& q) {  // w x y z, unit
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

/// Newton's method for the largest eigenvalue ends with a step shorter than this; |S| is scaled to 1 (no unit)
constexpr double root_tolerance = 1e-14;
constexpr int most_root_steps = 30;  ///< Steps of that method, at most (unit: steps)
/// The closed form is used where the product of the largest eigenvalue's gaps to the others is above this, a
/// decomposition elsewhere; |S| is scaled to 1 (no unit)
constexpr double safe_gap = 1e-5;
/// Fewer vertices are handled by one thread, since starting tasks costs more than it saves (unit: vertices)
constexpr Index parallel_threshold = 2000;

}  // namespace

// The rotation is the eigenvector, read as a quaternion, of the largest eigenvalue of a symmetric 4 x 4 matrix without
// trace (Horn 1987); Newton on its characteristic polynomial from above, then a column of the adjugate (Theobald 2005).
Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& s) {
  const double scale = s.norm();
  if (!(scale > 0)) return Eigen::Matrix3d::Identity();
  // trace(R^T S) with S = sum x rest^T: Horn's matrix of m = S^T.
  const double inverse = 1 / scale;
  const double xx = s(0, 0) * inverse, xy = s(1, 0) * inverse, xz = s(2, 0) * inverse;
  const double yx = s(0, 1) * inverse, yy = s(1, 1) * inverse, yz = s(2, 1) * inverse;
  const double zx = s(0, 2) * inverse, zy = s(1, 2) * inverse, zz = s(2, 2) * inverse;
  Eigen::Matrix4d k;
  k << xx + yy + zz, yz - zy, zx - xz, xy - yx,  //
      yz - zy, xx - yy - zz, xy + yx, zx + xz,   //
      zx - xz, xy + yx, yy - xx - zz, yz + zy,   //
      xy - yx, zx + xz, yz + zy, zz - xx - yy;
  /// The sum of three singular values with sum of squares 1 is at most sqrt(3) (fixed by algebra)
  constexpr double largest_root = 1.7320508075688774;
  // det(K - l I) = l^4 + c2 l^2 + c1 l + c0 with |S|_F = 1.
  const double c2 = -2;
  const double c1 = -8 * inverse * inverse * inverse * s.determinant();
  const double c0 = k.determinant();
  double l = largest_root;
  double slope = 0;
  bool converged = false;
  for (int i = 0; i < most_root_steps && !converged; ++i) {
    const double ll = l * l;
    slope = 4 * ll * l + 2 * c2 * l + c1;
    if (slope <= 0) break;
    const double step = (((ll + c2) * l + c1) * l + c0) / slope;
    l -= step;
    converged = std::abs(step) < root_tolerance;
  }
  // The slope at the root is the product of the gaps to the other eigenvalues.
  if (converged && slope > safe_gap) {
    Eigen::Matrix4d m = k;
    m.diagonal().array() -= l;
    // Columns of the adjugate of the rank 3 matrix m, all parallel to the eigenvector; the longest is the safest.
    const double a = m(2, 2) * m(3, 3) - m(2, 3) * m(2, 3), b = m(2, 1) * m(3, 3) - m(2, 3) * m(3, 1);
    const double c = m(2, 1) * m(3, 2) - m(2, 2) * m(3, 1), d = m(2, 0) * m(3, 3) - m(2, 3) * m(3, 0);
    const double e = m(2, 0) * m(3, 2) - m(2, 2) * m(3, 0), f = m(2, 0) * m(3, 1) - m(2, 1) * m(3, 0);
    const double a2 = m(0, 2) * m(1, 3) - m(0, 3) * m(1, 2), b2 = m(0, 1) * m(1, 3) - m(0, 3) * m(1, 1);
    const double c2_ = m(0, 1) * m(1, 2) - m(0, 2) * m(1, 1), d2 = m(0, 0) * m(1, 3) - m(0, 3) * m(1, 0);
    const double e2 = m(0, 0) * m(1, 2) - m(0, 2) * m(1, 0), f2 = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
    const std::array<Eigen::Vector4d, 4> columns{
        Eigen::Vector4d(m(1, 1) * a - m(1, 2) * b + m(1, 3) * c, -m(1, 0) * a + m(1, 2) * d - m(1, 3) * e,
                        m(1, 0) * b - m(1, 1) * d + m(1, 3) * f, -m(1, 0) * c + m(1, 1) * e - m(1, 2) * f),
        Eigen::Vector4d(-m(0, 1) * a + m(0, 2) * b - m(0, 3) * c, m(0, 0) * a - m(0, 2) * d + m(0, 3) * e,
                        -m(0, 0) * b + m(0, 1) * d - m(0, 3) * f, m(0, 0) * c - m(0, 1) * e + m(0, 2) * f),
        Eigen::Vector4d(m(3, 1) * a2 - m(3, 2) * b2 + m(3, 3) * c2_, -m(3, 0) * a2 + m(3, 2) * d2 - m(3, 3) * e2,
                        m(3, 0) * b2 - m(3, 1) * d2 + m(3, 3) * f2, -m(3, 0) * c2_ + m(3, 1) * e2 - m(3, 2) * f2),
        Eigen::Vector4d(-m(2, 1) * a2 + m(2, 2) * b2 - m(2, 3) * c2_, m(2, 0) * a2 - m(2, 2) * d2 + m(2, 3) * e2,
                        -m(2, 0) * b2 + m(2, 1) * d2 - m(2, 3) * f2, m(2, 0) * c2_ - m(2, 1) * e2 + m(2, 2) * f2)};
    int longest = 0;
    for (int i = 1; i < 4; ++i) {
      if (columns[i].squaredNorm() > columns[longest].squaredNorm()) longest = i;
    }
    return from_quaternion(columns[longest].normalized());
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(s * inverse, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

Arap::Arap(std::span<const Triangle> triangles, const Positions& rest, Index free_count) : free_count_(free_count) {
  const Index n = static_cast<Index>(rest.cols());
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const Index i = t[k], j = t[(k + 1) % 3];
      if (i != j) edges.push_back({std::min(i, j), std::max(i, j)});
    }
  sort_unique(edges);
  offsets_.assign(n + 1, 0);
  for (const auto& [i, j] : edges) ++offsets_[i + 1], ++offsets_[j + 1];
  for (Index i = 0; i < n; ++i) offsets_[i + 1] += offsets_[i];
  neighbours_.resize(offsets_.back());
  std::vector<Index> next(offsets_.begin(), offsets_.end() - 1);
  for (const auto& [i, j] : edges) {
    neighbours_[next[i]++] = j;
    neighbours_[next[j]++] = i;
  }
  rest_edges_.resize(3, offsets_.back());
  for (Index i = 0; i < n; ++i) {
    for (Index h = offsets_[i]; h < offsets_[i + 1]; ++h) rest_edges_.col(h) = rest.col(i) - rest.col(neighbours_[h]);
  }
  rotations_.assign(n, Eigen::Matrix3d::Identity());
}

double Arap::value_and_gradient(const Positions& x, Positions& gradient, double weight) {
  const Index n = static_cast<Index>(offsets_.size()) - 1;
  const auto rotate = [&](Index i) {
    Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
    for (Index h = offsets_[i]; h < offsets_[i + 1]; ++h) {
      const Vec3 moved = edge_weight * (x.col(i) - x.col(neighbours_[h]));
      s.noalias() += moved * rest_edges_.col(h).transpose();
    }
    rotations_[i] = closest_rotation(s);
  };
  const Index turning = std::min(n, free_count_);
  if (turning < parallel_threshold) {
    for (Index i = 0; i < turning; ++i) rotate(i);
  } else {
    parallel_for(turning, rotate);
  }
  double value = 0;
  for (Index i = 0; i < n; ++i) {
    Vec3 force = Vec3::Zero();
    for (Index h = offsets_[i]; h < offsets_[i + 1]; ++h) {
      const Index j = neighbours_[h];
      const Vec3 edge = x.col(i) - x.col(j);
      const Vec3 here = edge - rotations_[i] * rest_edges_.col(h);
      const Vec3 there = edge - rotations_[j] * rest_edges_.col(h);
      value += 0.5 * edge_weight * here.squaredNorm();
      force += edge_weight * (here + there);
    }
    gradient.col(i) += weight * force;
  }
  return weight * value;
}

}  // namespace unsnarl
