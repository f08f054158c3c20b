#include "applications/knots/moving_polygon.h"

#include <cmath>

#include "applications/knots/triangles4.h"
#include "contact/bvh.h"
#include "geometry/predicates.h"

namespace unsnarl {
namespace {

/// The time is halved this many times before it is given up, to a millionth of the way (unit: halvings)
constexpr int most_time_halvings = 20;
/// Error of a point between two others, of a difference of two such, and of its product with a normal, relative to the
/// largest coordinate and the length of the normal: a dozen roundings (fixed by float64)
constexpr double rounding = 32 * detail::half_ulp;

class MovingPolygon {
 public:
  MovingPolygon(const Positions& from, const Positions& to, double tolerance) : from_(from), to_(to) {
    const double largest = std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
    error_ = rounding * largest + 4 * tolerance;
  }

  bool stays_simple() const {
    const auto n = static_cast<Index>(from_.cols());
    std::vector<Box> boxes(n);
    for (Index i = 0; i < n; ++i) {
      if (!keeps_corner(i, (i + 1) % n, (i + 2) % n, 0, 1, 0)) return false;
      for (const Index k : {i, (i + 1) % n}) {
        boxes[i].extend(Vec3(from_.col(k)));
        boxes[i].extend(Vec3(to_.col(k)));
      }
      boxes[i] = boxes[i].inflated(error_);
    }
    bool apart = true;
    Bvh(boxes).self_pairs([&](Index i, Index j) {
      if (!apart || (i + 1) % n == j || (j + 1) % n == i) return;
      apart = stay_apart(i, (i + 1) % n, j, (j + 1) % n, 0, 1, 0);
    });
    return apart;
  }

 private:
  Vec3 at(Index k, double time) const { return from_.col(k) + time * (to_.col(k) - from_.col(k)); }

  /// Whether some plane has all these vectors on one side.
  bool all_ahead(const std::array<Vec4, 9>& v, int count) const {
    std::array<double, 9> weights;
    const Vec4 n = nearest_to_origin(v, count, weights);
    for (int k = 0; k < count; ++k)
      if (!(n.dot(v[k]) > 2 * error_ * n.lpNorm<1>())) return false;
    return true;
  }

  bool stay_apart(Index a, Index b, Index c, Index d, double begin, double end, int depth) const {
    std::array<Vec4, 9> v;
    int count = 0;
    for (const double time : {begin, end})
      for (const Index p : {a, b})
        for (const Index q : {c, d}) v[count++] << at(p, time) - at(q, time), 0;
    if (all_ahead(v, count)) return true;
    const double middle = 0.5 * (begin + end);
    return depth < most_time_halvings && stay_apart(a, b, c, d, begin, middle, depth + 1) &&
           stay_apart(a, b, c, d, middle, end, depth + 1);
  }

  /// Whether edges ab and bc never lie on each other.
  bool keeps_corner(Index a, Index b, Index c, double begin, double end, int depth) const {
    std::array<Vec4, 9> v;
    int count = 0;
    for (const double time : {begin, end}) {
      v[count++] << at(b, time) - at(a, time), 0;
      v[count++] << at(c, time) - at(b, time), 0;
    }
    if (all_ahead(v, count)) return true;
    const double middle = 0.5 * (begin + end);
    return depth < most_time_halvings && keeps_corner(a, b, c, begin, middle, depth + 1) &&
           keeps_corner(a, b, c, middle, end, depth + 1);
  }

  const Positions &from_, &to_;
  double error_;
};

}  // namespace

bool stays_simple(const Positions& from, const Positions& to, double tolerance) {
  return MovingPolygon(from, to, tolerance).stays_simple();
}

}  // namespace unsnarl
