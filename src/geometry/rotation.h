#pragma once

#include "geometry/types.h"

namespace unsnarl {

/// The rotation by an angle (radians) about an axis of length 1, counterclockwise seen from its tip. In place of
/// Eigen::AngleAxis, which takes sine and cosine from the C library (geometry/portable_math.h).
Eigen::Matrix3d rotation_about(const Vec3& axis, double angle);

/// The rotation about w by its length in radians.
Eigen::Matrix3d rotation_by(const Vec3& w);

/// Along the axis of a rotation, as long as its angle in radians, within [0, pi]: the w of rotation_by().
Vec3 rotation_vector(const Eigen::Matrix3d& rotation);

/// The rotation R that is nearest to a matrix, by the largest trace of R^T m (Kabsch; without reflections).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m);

}  // namespace unsnarl
