#include "rigid/rigid_motion.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace unsnarl {

double RigidMotion::degrees() const {
  // From sine and cosine: either alone loses half of its digits near 0 or 180 degrees.
  const Vec3 axis(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0), rotation(1, 0) - rotation(0, 1));
  return std::atan2(axis.norm(), rotation.trace() - 1) * 180 / std::numbers::pi;
}

Eigen::Matrix3d rotation_by(const Vec3& w) {
  const double angle = w.norm();
  if (!(angle > 0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

namespace {

/// The motion that brings a to b, with the rotation that fits the covariance of `to` with `from` best.
RigidMotion motion_by_covariance(const Eigen::Matrix3d& covariance, const Vec3& a, const Vec3& b) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  const Eigen::Matrix3d v = svd.matrixV();
  if (u.determinant() * v.determinant() < 0) u.col(2) = -u.col(2);
  RigidMotion motion;
  motion.rotation = u * v.transpose();
  motion.translation = b - motion.rotation * a;
  return motion;
}

}  // namespace

RigidMotion best_rigid_motion(const Positions& from, const Positions& to) {
  if (from == to) return {};
  const Vec3 a = from.rowwise().mean(), b = to.rowwise().mean();
  return motion_by_covariance((to.colwise() - b) * (from.colwise() - a).transpose(), a, b);
}

RigidMotion best_rigid_motion(const Positions& from, const Positions& to, const Eigen::VectorXd& weights) {
  if (from == to) return {};
  const Vec3 a = from * weights / weights.sum(), b = to * weights / weights.sum();
  return motion_by_covariance((to.colwise() - b) * weights.asDiagonal() * (from.colwise() - a).transpose(), a, b);
}

}  // namespace unsnarl
