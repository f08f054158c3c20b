#include "applications/seifert/closed_tube.h"

#include <numbers>

#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// `e`, which is across `from`, turned as little as possible so that it is across `to`; both of unit length.
Vec3 turned_along(const Vec3& e, const Vec3& from, const Vec3& to) {
  return e - e.dot(to) / (1 + from.dot(to)) * (from + to);
}

}  // namespace

void add_closed_tube(const Positions& x, double radius, int sides, Surface& tube) {
  const auto n = static_cast<Index>(x.cols());
  const auto first = static_cast<Index>(tube.positions.size() / 3);
  const auto direction = [&](Index k) { return Vec3((x.col((k + 1) % n) - x.col(k % n)).normalized()); };
  Vec3 e = direction(n - 1).unitOrthogonal();
  for (Index k = 0; k < n; ++k) {
    const Vec3 before = direction(k + n - 1), after = direction(k), across = (before + after).normalized();
    const Vec3 u = turned_along(e, before, across).normalized(), v = across.cross(u);
    e = turned_along(e, before, after).normalized();
    for (int s = 0; s < sides; ++s) {
      const double angle = 2 * std::numbers::pi * s / sides;
      const Vec3 p = x.col(k) + radius * (portable::cos(angle) * u + portable::sin(angle) * v);
      tube.positions.insert(tube.positions.end(), p.begin(), p.end());
    }
  }
  const auto at = [&](Index k, int s) {
    return Vec3(Eigen::Map<const Vec3>(tube.positions.data() + 3 * (first + k * sides + s % sides)));
  };
  int shift = 0;  // the last ring meets the first one turned
  for (int s = 1; s < sides; ++s)
    if ((at(0, s) - at(n - 1, 0)).norm() < (at(0, shift) - at(n - 1, 0)).norm()) shift = s;
  for (Index k = 0; k < n; ++k)
    for (int s = 0; s < sides; ++s) {
      const Index ring = first + k * sides, next = first + (k + 1) % n * sides;
      const int turn = k + 1 == n ? shift : 0;
      const Index a = ring + s, b = ring + (s + 1) % sides;
      const Index c = next + (s + 1 + turn) % sides, d = next + (s + turn) % sides;
      tube.corners.insert(tube.corners.end(), {a, b, c, a, c, d});
    }
}

}  // namespace unsnarl
