#include "geometry/predicates.h"

namespace unsnarl {

int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  // The axis of the largest normal component is nearly always right; the others decide the exact cases.
  const Vec3 n = (b - a).cross(c - a).cwiseAbs();
  int first = 0;
  n.maxCoeff(&first);
  for (int k = 0; k < 3; ++k) {
    const int axis = (first + k) % 3;
    if (orient2d_dropping(axis, a, b, c) != 0) return axis;
  }
  return -1;
}

}  // namespace unsnarl
