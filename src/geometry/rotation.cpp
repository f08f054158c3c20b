#include "geometry/rotation.h"

#include <Eigen/SVD>

#include "geometry/portable_math.h"

namespace unsnarl {

Eigen::Matrix3d rotation_about(const Vec3& axis, double angle) {
  // Rodrigues' formula.
  const double c = portable::cos(angle);
  const Vec3 s = portable::sin(angle) * axis;
  Eigen::Matrix3d across;
  across << 0, -s[2], s[1], s[2], 0, -s[0], -s[1], s[0], 0;
  return c * Eigen::Matrix3d::Identity() + (1 - c) * axis * axis.transpose() + across;
}

Eigen::Matrix3d rotation_by(const Vec3& w) {
  const double angle = w.norm();
  if (!(angle > 0)) return Eigen::Matrix3d::Identity();
  return rotation_about(w / angle, angle);
}

Vec3 rotation_vector(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (!(sine > 0)) return Vec3::Zero();
  return 2 * portable::atan2(sine, q.w()) / sine * q.vec();
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  const Eigen::Matrix3d v = svd.matrixV();
  if (u.determinant() * v.determinant() < 0) u.col(2) = -u.col(2);  // of the least singular value
  return u * v.transpose();
}

}  // namespace unsnarl
