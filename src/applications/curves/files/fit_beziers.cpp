#include "applications/curves/files/fit_beziers.h"

#include <algorithm>
#include <cmath>

namespace unsnarl {
namespace {

/// How far a curve may be from the segment of two neighbouring points (unit: tolerances)
constexpr double most_bulge = 5;
/// A cubic is at most this share of the greater distance of its controls from the chord away from it (fixed by algebra)
constexpr double bulge_of_handle = 0.75;
/// Handles of less than this share of the chord count as failed, as do those longer than the chord (unit: chord)
constexpr double least_handle = 1e-3;

constexpr int rounds = 4;  ///< Fits of one curve, with better parameters each time (unit: rounds)

Vec2 unit(const Vec2& v) {
  const double length = v.norm();
  return length > 0 ? Vec2(v / length) : Vec2(Vec2::Zero());
}

double sine_between(const Vec2& a, const Vec2& b) {
  return std::abs(a.x() * b.y() - a.y() * b.x());
}

class BezierFit {
 public:
  BezierFit(std::span<const Vec2> points, double tolerance) : points_(points), tolerance_(tolerance) {}

  void fit(std::size_t first, std::size_t last, const Vec2& arriving, const Vec2& leaving) {
    if (last == first + 1) {
      add_between_neighbours(first, arriving, leaving);
      return;
    }
    const std::size_t farthest = add_or_split(first, last, arriving, leaving);
    if (farthest == last) return;
    const Vec2 direction =
        unit(unit(points_[farthest] - points_[farthest - 1]) + unit(points_[farthest + 1] - points_[farthest]));
    fit(first, farthest, arriving, direction);
    fit(farthest, last, direction, leaving);
  }

  std::vector<FittedBezier> result;

 private:
  /// Adds one curve over these points where it comes near enough and returns `last`; else returns where to split. That
  /// is in the middle three quarters, so that splitting ends soon.
  std::size_t add_or_split(std::size_t first, std::size_t last, const Vec2& arriving, const Vec2& leaving) {
    const Vec2 a = points_[first], d = points_[last];
    std::vector<double> t = parameters(first, last);
    std::size_t farthest = first + 1;
    for (int round = 0; round < rounds; ++round) {
      const std::array<Vec2, 2> controls = best_controls(first, last, t, arriving, leaving);
      const std::array<Vec2, 4> curve{a, controls[0], controls[1], d};
      double largest = -1;
      for (std::size_t k = first + 1; k < last; ++k) {
        const double distance = approach(curve, points_[k], t[k - first]);
        if (distance > largest) {
          largest = distance;
          farthest = k;
        }
      }
      if (largest <= tolerance_ && is_near_segments(curve, first, last, t)) {
        result.push_back({last, controls});
        return last;
      }
    }
    const std::size_t eighth = std::max<std::size_t>(1, (last - first) / 8);
    return std::clamp(farthest, first + eighth, last - eighth);
  }

  /// Whether the curve, half-way between points, is within the greatest bulge of their segments.
  bool is_near_segments(const std::array<Vec2, 4>& curve, std::size_t first, std::size_t last,
                        std::span<const double> t) const {
    for (std::size_t k = first; k < last; ++k) {
      const Vec2 &a = points_[k], &b = points_[k + 1];
      const Vec2 place = place_at(curve, 0.5 * (t[k - first] + t[k + 1 - first]));
      if (distance_to_segment(place, a, b) > most_bulge * tolerance_) return false;
    }
    return true;
  }

  void add_between_neighbours(std::size_t first, const Vec2& arriving, const Vec2& leaving) {
    const Vec2 a = points_[first], d = points_[first + 1], along = unit(d - a);
    const double third = (d - a).norm() / 3;
    const auto handle = [&](const Vec2& direction) {
      const double sine = sine_between(direction, along) * bulge_of_handle;
      return sine * third > most_bulge * tolerance_ ? most_bulge * tolerance_ / sine : third;
    };
    result.push_back({first + 1, {a + handle(arriving) * arriving, d - handle(leaving) * leaving}});
  }

  static Vec2 place_at(const std::array<Vec2, 4>& curve, double t) {
    const double u = 1 - t;
    return u * u * u * curve[0] + 3 * t * u * u * curve[1] + 3 * t * t * u * curve[2] + t * t * t * curve[3];
  }

  /// The distance of a point from the place of a curve at t, which then goes one step of Newton's method nearer to it.
  static double approach(const std::array<Vec2, 4>& curve, const Vec2& point, double& t) {
    const Vec2 &a = curve[0], &b = curve[1], &c = curve[2], &d = curve[3];
    const double u = 1 - t;
    const Vec2 apart = place_at(curve, t) - point;
    const Vec2 first = 3 * (u * u * (b - a) + 2 * t * u * (c - b) + t * t * (d - c));
    const Vec2 second = 6 * (u * (a - 2 * b + c) + t * (b - 2 * c + d));
    const double slope = first.squaredNorm() + apart.dot(second);
    if (slope > 0) t = std::clamp(t - apart.dot(first) / slope, 0.0, 1.0);
    return apart.norm();
  }

  /// Parameters of the points first, ..., last in [0, 1], by the lengths of their segments.
  std::vector<double> parameters(std::size_t first, std::size_t last) const {
    std::vector<double> t{0};
    for (std::size_t k = first; k < last; ++k) t.push_back(t.back() + (points_[k + 1] - points_[k]).norm());
    for (double& at : t) at /= t.back();
    return t;
  }

  /// The controls with the given directions whose curve has the least sum of squared distances from the points, at
  /// their parameters.
  std::array<Vec2, 2> best_controls(std::size_t first, std::size_t last, std::span<const double> t,
                                    const Vec2& arriving, const Vec2& leaving) const {
    const Vec2 a = points_[first], d = points_[last];
    double c00 = 0, c01 = 0, c11 = 0, x0 = 0, x1 = 0;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double at = t[k - first], u = 1 - at;
      const double b1 = 3 * at * u * u, b2 = 3 * at * at * u;
      const Vec2 one = b1 * arriving, two = -b2 * leaving;
      const Vec2 rest = points_[k] - ((u * u * u + b1) * a + (at * at * at + b2) * d);
      c00 += one.squaredNorm();
      c01 += one.dot(two);
      c11 += two.squaredNorm();
      x0 += one.dot(rest);
      x1 += two.dot(rest);
    }
    const double determinant = c00 * c11 - c01 * c01, chord = (d - a).norm();
    double first_handle = (x0 * c11 - x1 * c01) / determinant, last_handle = (c00 * x1 - c01 * x0) / determinant;
    const auto is_usable = [&](double handle) { return handle > least_handle * chord && handle < chord; };
    if (!is_usable(first_handle) || !is_usable(last_handle)) first_handle = last_handle = chord / 3;
    return {a + first_handle * arriving, d - last_handle * leaving};
  }

  std::span<const Vec2> points_;
  double tolerance_;
};

}  // namespace

std::vector<FittedBezier> fit_beziers(std::span<const Vec2> points, const Vec2& arriving, const Vec2& leaving,
                                      double tolerance) {
  BezierFit fit(points, tolerance);
  const std::size_t last = points.size() - 1;
  const auto direction = [](const Vec2& given, const Vec2& segment) {
    return unit(given.squaredNorm() > 0 ? given : segment);
  };
  fit.fit(0, last, direction(arriving, points[1] - points[0]), direction(leaving, points[last] - points[last - 1]));
  return std::move(fit.result);
}

}  // namespace unsnarl
