#include "applications/routes/proven_bounds.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/predicates.h"

namespace unsnarl {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using ExactVec = std::array<Rational, 3>;

/// Relative error of a handful of operations that each round once (fixed by float64)
constexpr double few_roundings = 16 * detail::half_ulp;

ExactVec exact(const Vec3& v) {
  return {Rational(v[0]), Rational(v[1]), Rational(v[2])};
}
ExactVec difference(const Vec3& a, const Vec3& b) {
  return {Rational(a[0]) - Rational(b[0]), Rational(a[1]) - Rational(b[1]), Rational(a[2]) - Rational(b[2])};
}
Rational dot(const ExactVec& a, const ExactVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

using Pairs = std::vector<std::pair<const Vec3*, const Vec3*>>;

/// Whether the gap across n is at least as wide as r + s: first - second of every pair goes beyond.
bool is_gap(const Pairs& pairs, const Vec3& n, double r, double s) {
  const ExactVec direction = exact(n);
  Rational gap;
  bool first = true;
  for (const auto& [p, q] : pairs) {
    const Rational along = dot(direction, difference(*p, *q));
    if (first || along < gap) gap = along;
    first = false;
  }
  const Rational reach = Rational(r) + Rational(s);
  return gap > 0 && gap * gap >= reach * reach * dot(direction, direction);
}

/// The gap / (r + s) less what floating point may have added to it, of which this is the relative error.
double gap_in_floating_point(const Pairs& pairs, const Vec3& direction, double r, double s, double error) {
  const double norm = direction.norm();
  if (!(norm > 0)) return 0;
  double gap = std::numeric_limits<double>::infinity();
  for (const auto& [p, q] : pairs) {
    const double along = direction.dot(*p - *q);
    const double magnitude = direction.cwiseAbs().dot(p->cwiseAbs() + q->cwiseAbs());
    gap = std::min(gap, along - error * magnitude);
  }
  return std::max(gap / (norm * (r + s)) * (1 - few_roundings), 0.0);
}

double proven_gap(const Pairs& pairs, const Vec3& direction, double r, double s) {
  const double bound = gap_in_floating_point(pairs, direction, r, s, few_roundings);
  return bound < 1 && direction.norm() > 0 && is_gap(pairs, direction, r, s) ? 1 : bound;
}

Pairs all_pairs(std::span<const Vec3> a, std::span<const Vec3> b) {
  Pairs pairs;
  for (const Vec3& p : a)
    for (const Vec3& q : b) pairs.emplace_back(&p, &q);
  return pairs;
}

/// Where what moves is at a time, exactly.
ExactVec offset_at(std::span<const RouteMove> motion, const Rational& time) {
  const auto after = std::find_if(motion.begin(), motion.end(), [&](const RouteMove& m) { return m.time > time; });
  const auto place = [](const RouteMove& m) { return exact(Vec3(m.offset[0], m.offset[1], m.offset[2])); };
  if (after == motion.begin()) return place(motion.front());
  if (after == motion.end()) return place(motion.back());
  const Rational from(std::prev(after)->time), share = (time - from) / (Rational(after->time) - from);
  const ExactVec a = place(*std::prev(after)), b = place(*after);
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

}  // namespace

double proven_clearance(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& direction, double r, double s) {
  return proven_gap(all_pairs(a, b), direction, r, s);
}

double proven_clearance_in_time(std::span<const Vec3, 2> a, std::span<const Vec3, 2> b, const Vec3& direction, double r,
                                double s) {
  return proven_gap({{&a[0], &b[0]}, {&a[1], &b[1]}}, direction, r, s);
}

std::vector<Vec3> seen_from(std::span<const RouteMove> motion, const Vec3& p, const Vec3& q, std::size_t k,
                            std::size_t steps, double duration) {
  const Rational step = Rational(duration) / Rational(steps), from = Rational(k) * step;
  std::vector<Rational> shares{0};
  for (const RouteMove& move : motion) {
    const Rational share = (Rational(move.time) - from) / step;
    if (share > 0 && share < 1) shares.push_back(share);
  }
  shares.emplace_back(1);
  std::vector<Vec3> way;
  const ExactVec a = exact(p), b = exact(q);
  for (const Rational& share : shares) {
    const ExactVec offset = offset_at(motion, from + share * step);
    Vec3& seen = way.emplace_back();
    for (int c = 0; c < 3; ++c) seen[c] = Rational(a[c] + share * (b[c] - a[c]) - offset[c]).convert_to<double>();
  }
  return way;
}

double proven_clearance_of_rounded(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& direction, double r) {
  return gap_in_floating_point(all_pairs(a, b), direction, r, 0, 2 * few_roundings);
}

bool is_as_far(const Vec3& a, const Vec3& b, double r, double s) {
  const ExactVec d = difference(a, b);
  const Rational reach = Rational(r) + Rational(s);
  return dot(d, d) >= reach * reach;
}

double proven_turn(const Vec3& a, const Vec3& b, const Vec3& c, double r) {
  // With u, v the edges and m the shorter one: tan(angle / 2) = |u x v| / (|u| |v| + u . v), so that the turn is at
  // most t where 2 r |u x v| <= t m (|u| |v| + u . v). All but |u| |v| is rational; a lower bound takes its place.
  const ExactVec u = difference(b, a), v = difference(c, b);
  const Rational uu = dot(u, u), vv = dot(v, v), uv = dot(u, v);
  const double lengths = std::sqrt(uu.convert_to<double>()) * std::sqrt(vv.convert_to<double>());
  Rational product(lengths);
  if (product * product > uu * vv) product = Rational(lengths * (1 - few_roundings));
  if (product * product > uu * vv || !(product + uv > 0)) return std::numeric_limits<double>::infinity();
  const Rational left = 4 * Rational(r) * Rational(r) * (uu * vv - uv * uv);  // |u x v|^2 by Lagrange's identity
  const Rational right = std::min(uu, vv) * (product + uv) * (product + uv);
  const double estimate = std::sqrt(Rational(left / right).convert_to<double>()) * (1 + few_roundings);
  return left <= right ? std::min(estimate, 1.0) : std::max(estimate, std::nextafter(1.0, 2.0));
}

double proven_speed(const Vec3& a, const Vec3& b, std::size_t steps, double duration, double allowed) {
  const ExactVec d = difference(a, b);
  const Rational done = dot(d, d) * Rational(steps) * Rational(steps);
  const Rational most = Rational(duration) * Rational(duration) * Rational(allowed) * Rational(allowed);
  const double estimate = std::sqrt(Rational(done / most).convert_to<double>()) * (1 + few_roundings);
  return done <= most ? std::min(estimate, 1.0) : std::max(estimate, std::nextafter(1.0, 2.0));
}

bool is_at_or_after(std::size_t k, std::size_t steps, double duration, double time) {
  return Rational(k) * Rational(duration) >= Rational(time) * Rational(steps);
}

bool is_at_or_before(std::size_t k, std::size_t steps, double duration, double time) {
  return Rational(k) * Rational(duration) <= Rational(time) * Rational(steps);
}

}  // namespace unsnarl
