#include "rigid/rigid_motion.h"

#include <algorithm>
#include <numbers>

#include "geometry/portable_math.h"
#include "geometry/rotation.h"

namespace unsnarl {

double RigidMotion::degrees() const {
  // From sine and cosine: either alone loses half of its digits near 0 or 180 degrees.
  const Vec3 axis(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0), rotation(1, 0) - rotation(0, 1));
  return portable::atan2(axis.norm(), rotation.trace() - 1) * 180 / std::numbers::pi;
}

namespace {

/// The motion that brings a to b, with the rotation that fits the covariance of `to` with `from` best.
RigidMotion motion_by_covariance(const Eigen::Matrix3d& covariance, const Vec3& a, const Vec3& b) {
  RigidMotion motion;
  motion.rotation = nearest_rotation(covariance);
  motion.translation = b - motion.rotation * a;
  return motion;
}

}  // namespace

RigidMotion best_rigid_motion(const Positions& from, const Positions& to) {
  if (from == to) return {};
  const Vec3 a = from.rowwise().mean(), b = to.rowwise().mean();
  return motion_by_covariance(Positions(to.colwise() - b).lazyProduct(Positions(from.colwise() - a).transpose()), a, b);
}

RigidMotion best_rigid_motion(const Positions& from, const Positions& to, const Eigen::VectorXd& weights) {
  if (from == to) return {};
  const Vec3 a = from * weights / weights.sum(), b = to * weights / weights.sum();
  return motion_by_covariance(
      Positions((to.colwise() - b) * weights.asDiagonal()).lazyProduct(Positions(from.colwise() - a).transpose()), a,
      b);
}

}  // namespace unsnarl
