#pragma once

#include <span>

#include "geometry/types.h"

namespace unsnarl {

/// p -> rotation p + translation.
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 translation = Vec3::Zero();

  Vec3 apply(const Vec3& p) const { return rotation * p + translation; }
  /// Angle of the rotation in degrees, in [0, 180].
  double degrees() const;
};

/// The rigid motion that brings `from` nearest to `to`, by the sum of squared distances (Kabsch; without reflections).
/// Columns that are equal in both give exactly the identity. Both have as many columns, at least one.
RigidMotion best_rigid_motion(const Positions& from, const Positions& to);
/// The same by the weighted sum. One weight a column, none negative, not all 0.
RigidMotion best_rigid_motion(const Positions& from, const Positions& to, const Eigen::VectorXd& weights);

}  // namespace unsnarl
