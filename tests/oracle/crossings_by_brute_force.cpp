#include "oracle/crossings_by_brute_force.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <map>
#include <vector>

namespace unsnarl::oracle {
namespace {

using Rational = boost::multiprecision::cpp_rational;

struct PlanePoint {
  Rational x, y;
  friend bool operator==(const PlanePoint& a, const PlanePoint& b) { return a.x == b.x && a.y == b.y; }
};

struct PlaneSegment {
  std::array<int, 2> id;
  std::array<PlanePoint, 2> p;
  std::array<double, 4> box;  // low and high x, low and high y
};

int orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const Rational det = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

Rational along(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.x - a.x) * (c.x - a.x) + (b.y - a.y) * (c.y - a.y);
}

/// p on the closed segment from a to b.
bool is_on(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  return orientation(a, b, p) == 0 && along(p, a, b) <= 0;
}

bool meet(const PlaneSegment& s, const PlaneSegment& t) {
  std::vector<std::array<int, 2>> shared;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (s.id[i] == t.id[j]) shared.push_back({i, j});
  if (shared.size() >= 2) return true;
  if (shared.size() == 1) {
    const PlanePoint &at = s.p[shared[0][0]], &p = s.p[1 - shared[0][0]], &q = t.p[1 - shared[0][1]];
    return orientation(at, p, q) == 0 && along(at, p, q) > 0;
  }
  if (is_on(s.p[0], t.p[0], t.p[1]) || is_on(s.p[1], t.p[0], t.p[1]) || is_on(t.p[0], s.p[0], s.p[1]) ||
      is_on(t.p[1], s.p[0], s.p[1]))
    return true;
  return orientation(s.p[0], s.p[1], t.p[0]) * orientation(s.p[0], s.p[1], t.p[1]) < 0 &&
         orientation(t.p[0], t.p[1], s.p[0]) * orientation(t.p[0], t.p[1], s.p[1]) < 0;
}

}  // namespace

std::size_t count_crossings(std::span<const Curve> curves, std::span<const CurveJoint> joints) {
  std::map<std::array<int, 2>, int> id_of;
  int ids = 0;
  for (const CurveJoint& joint : joints) {
    std::map<std::array<double, 2>, int> id_at;  // points of a joint that are not at one position are not one
    for (const auto& [c, k] : joint) {
      const auto [at, is_new] = id_at.try_emplace({curves[c].points[2 * k], curves[c].points[2 * k + 1]}, ids);
      ids += is_new;
      id_of[{c, k}] = at->second;
    }
  }
  std::vector<PlaneSegment> segments;
  for (int c = 0; c < static_cast<int>(curves.size()); ++c) {
    const auto n = static_cast<int>(curves[c].size());
    for (int k = 0; k < n; ++k)
      if (id_of.try_emplace({c, k}, ids).second) ++ids;
    for (int k = 0; k + (curves[c].closed ? 0 : 1) < n; ++k) {
      PlaneSegment s;
      for (int e = 0; e < 2; ++e) {
        const int v = (k + e) % n;
        s.id[e] = id_of[{c, v}];
        s.p[e] = {Rational(curves[c].points[2 * v]), Rational(curves[c].points[2 * v + 1])};
      }
      const double *a = &curves[c].points[2 * k], *b = &curves[c].points[2 * ((k + 1) % n)];
      s.box = {std::min(a[0], b[0]), std::max(a[0], b[0]), std::min(a[1], b[1]), std::max(a[1], b[1])};
      segments.push_back(std::move(s));
    }
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = i + 1; j < segments.size(); ++j) {
      const auto &a = segments[i].box, &b = segments[j].box;
      if (a[1] < b[0] || b[1] < a[0] || a[3] < b[2] || b[3] < a[2]) continue;
      count += meet(segments[i], segments[j]);
    }
  return count;
}

}  // namespace unsnarl::oracle
