#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "applications/curves/curve_net.h"
#include "geometry/portable_math.h"
#include "geometry/splitmix.h"

namespace unsnarl {
namespace {

constexpr std::array<std::string_view, 6> kinds = {"waves", "walk", "star", "noise", "spiral", "chaos"};

/// The same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// In [0, 1).
  double operator()() { return splitmix_number(state_ += splitmix_step); }
  double between(double low, double high) { return low + (high - low) * (*this)(); }

 private:
  std::uint64_t state_;
};

constexpr double turn = 2 * std::numbers::pi;

/// A closed Catmull-Rom spline through the knots, at t in [0, 1).
Vec2 spline(const std::vector<Vec2>& knots, double t) {
  const auto n = knots.size();
  const double s = t * static_cast<double>(n);
  const auto k = static_cast<std::size_t>(s) % n;
  const double u = s - std::floor(s);
  const Vec2 &a = knots[(k + n - 1) % n], &b = knots[k], &c = knots[(k + 1) % n], &d = knots[(k + 2) % n];
  return 0.5 * (2 * b + (c - a) * u + (2 * a - 5 * b + 4 * c - d) * u * u + (3 * b - a - 3 * c + d) * u * u * u);
}

std::vector<Vec2> points_of(std::string_view kind, Random& random, int n) {
  std::vector<Vec2> p(n);
  const auto at = [&](auto&& curve) {
    for (int k = 0; k < n; ++k) p[k] = curve(static_cast<double>(k) / n);
  };
  if (kind == "waves") {
    const int waves = 2 + static_cast<int>(random() * 6);
    std::vector<std::array<double, 5>> w;  // frequency, amplitude and phase of x, of y
    for (int k = 1; k <= waves; ++k)
      w.push_back({double(k), random.between(-1, 1) / k, turn * random(), random.between(-1, 1) / k, turn * random()});
    at([&](double t) {
      Vec2 sum(0, 0);
      for (const auto& [f, ax, px, ay, py] : w)
        sum += Vec2(ax * portable::sin(turn * f * t + px), ay * portable::sin(turn * f * t + py));
      return sum;
    });
  } else if (kind == "walk") {
    std::vector<double> angle(n);
    double a = 0;
    for (double& value : angle) value = a += random.between(-1, 1) * 0.6;
    Vec2 sum(0, 0);
    for (int k = 0; k < n; ++k) p[k] = sum += Vec2(portable::cos(angle[k]), portable::sin(angle[k]));
    for (int k = 0; k < n; ++k) p[k] -= (k + 1.0) / n * sum;  // back to the start
  } else if (kind == "star") {
    std::vector<Vec2> knots(5 + static_cast<int>(random() * 16));
    for (Vec2& knot : knots) knot = {random.between(-1, 1), random.between(-1, 1)};
    at([&](double t) { return spline(knots, t); });
  } else if (kind == "noise") {
    const double amplitude = random.between(0.5, 4) * turn / n;
    at([&](double t) {
      const double up = amplitude * random.between(-1, 1), across = amplitude * random.between(-1, 1);
      return Vec2(portable::cos(turn * t) + across, portable::sin(turn * t) + up);
    });
  } else if (kind == "spiral") {
    const int turns = 2 + static_cast<int>(random() * 5);
    const double wobble = random.between(0.1, 0.5), phase = turn * random();
    const int frequency = 1 + static_cast<int>(random() * 4);
    at([&](double t) {
      const double r = 1 + wobble * portable::sin(turn * frequency * t + phase) + 0.3 * portable::cos(turn * t);
      return Vec2(r * portable::cos(turn * turns * t), r * portable::sin(turn * turns * t));
    });
  } else {
    at([&](double) {  // in turns: arguments of one call are taken in any order
      const double y = random(), x = random();
      return Vec2(x, y);
    });
  }
  return p;
}

}  // namespace

std::span<const std::string_view> random_curve_kinds() {
  return kinds;
}

Curve random_closed_curve(std::string_view kind, std::uint64_t seed, int points) {
  std::string all;
  bool known = false;
  for (const std::string_view name : kinds) {
    all += fmt::format("{}{}", all.empty() ? "" : ", ", name);
    known |= name == kind;
  }
  if (!known) throw std::invalid_argument(fmt::format("there is no kind '{}' of random curve; choose {}", kind, all));
  if (points < 8 || points > 100000) throw std::invalid_argument(fmt::format("{} points; give 8 to 100000", points));
  Random random(seed);
  Curve curve;
  curve.closed = true;
  for (const Vec2& p : points_of(kind, random, points)) curve.points.insert(curve.points.end(), {p.x(), p.y()});
  return curve;
}

}  // namespace unsnarl
