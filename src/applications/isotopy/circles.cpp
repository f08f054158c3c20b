#include "applications/isotopy/circles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "applications/isotopy/correspondence.h"
#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

constexpr double circle_turn = 2 * std::numbers::pi;  ///< A full turn in radians (fixed by geometry)
/// The curves in a circle are drawn into this part of its radius; discs.h asks for less than half (no unit)
constexpr double contents_part = 0.4;
/// Points turn about the middle of a circle by at most this from ring to ring; below a quarter turn their order stays
/// (unit: turns)
constexpr double turn_a_ring = 0.125;

/// A triangle within a triangle, of the same height over its longest edge; the ends of that come nearer to the foot of
/// the height, to within what an equilateral triangle has.
Points2 stout(const Points2& triangle) {
  int top = 0;
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    if (const double length = (triangle.col((k + 2) % 3) - triangle.col((k + 1) % 3)).norm(); length > longest) {
      longest = length;
      top = k;
    }
  Points2 made = triangle;
  const Vec2 a = triangle.col((top + 1) % 3), b = triangle.col((top + 2) % 3), c = triangle.col(top);
  const Vec2 foot = a + nearest_fraction(c, a, b) * (b - a);
  const double reach = (c - foot).norm() / std::numbers::sqrt3;
  for (int k = 1; k <= 2; ++k) {
    const Vec2 end = triangle.col((top + k) % 3);
    const double off = (end - foot).norm();
    if (off > reach) made.col((top + k) % 3) = foot + reach / off * (end - foot);
  }
  return made;
}

/// The angles of points around a middle, without jumps.
std::vector<double> angles_of(const Points2& p, const Vec2& middle) {
  std::vector<double> angles;
  for (Index k = 0; k < p.cols(); ++k) {
    const Vec2 d = p.col(k) - middle;
    double angle = portable::atan2(d.y(), d.x());
    if (!angles.empty()) angle += circle_turn * std::floor((angles.back() - angle) / circle_turn + 0.5);
    angles.push_back(angle);
  }
  return angles;
}

/// The distance from the middle to the chords between points of a circle at these angles (unit: the radius).
double least_chord(const std::vector<double>& angles) {
  double least = 1;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double gap = angles[(k + 1) % angles.size()] - angles[k];
    least = std::min(least, std::abs(portable::cos(0.5 * gap)));
  }
  return least;
}

}  // namespace

Incircle incircle_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double by_a = (c - b).norm(), by_b = (a - c).norm(), by_c = (b - a).norm(), sum = by_a + by_b + by_c;
  const Vec2 u = b - a, v = c - a;
  return {(by_a * a + by_b * b + by_c * c) / sum, std::abs(u.x() * v.y() - u.y() * v.x()) / sum};
}

CirclesWay make_circles(Polygons triangles, std::span<const Index> parent, std::span<const double> sides, int count) {
  CirclesWay made;
  const auto size = static_cast<Index>(triangles.size());
  const auto depth_of = [&](Index p) {
    Index depth = 0;
    for (; parent[p] >= 0; p = parent[p]) ++depth;
    return depth;
  };
  const auto is_in = [&](Index p, Index other) {
    for (p = parent[p]; p >= 0; p = parent[p])
      if (p == other) return true;
    return false;
  };
  Polygons slim;
  for (const Points2& p : triangles) slim.push_back(stout(p));
  made.places = even_places(slim, std::vector<int>(triangles.size(), count));
  const auto add = [&](const Polygons& of) {
    Polygons& ring = made.rings.emplace_back();
    for (Index p = 0; p < size; ++p) ring.push_back(points_at(of[p], made.places[p]));
  };
  add(triangles);

  // The curves in a triangle are drawn to the middle of its circle, from the outermost triangles inward.
  std::vector<Index> order(size);
  for (Index p = 0; p < size; ++p) order[p] = p;
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return depth_of(a) < depth_of(b); });
  std::vector<Incircle> circles(size);
  std::vector<std::vector<double>> angles(size), even(size);
  int steps = 1;
  for (const Index p : order) {
    slim[p] = stout(triangles[p]);
    circles[p] = incircle_of(slim[p].col(0), slim[p].col(1), slim[p].col(2));
    angles[p] = angles_of(points_at(slim[p], made.places[p]), circles[p].middle);
    double ahead = 0;
    for (int k = 0; k < count; ++k) ahead += (angles[p][k] - sides[p] * circle_turn * k / count) / count;
    for (int k = 0; k < count; ++k) {
      even[p].push_back(ahead + sides[p] * circle_turn * k / count);
      steps = std::max(steps,
                       static_cast<int>(std::ceil(std::abs(even[p][k] - angles[p][k]) / (turn_a_ring * circle_turn))));
    }
    double reach = 0;
    for (Index q = 0; q < size; ++q)
      if (is_in(q, p))
        reach =
            std::max(reach, std::sqrt((triangles[q].colwise() - circles[p].middle).colwise().squaredNorm().maxCoeff()));
    const double part = contents_part * circles[p].radius * least_chord(angles[p]) / reach;
    if (!(reach > 0) || part >= 1) continue;
    for (Index q = 0; q < size; ++q)
      if (is_in(q, p))
        triangles[q] = (part * (triangles[q].colwise() - circles[p].middle)).colwise() + circles[p].middle;
  }
  add(triangles);
  add(slim);
  for (int step = 0; step <= steps; ++step) {
    const double t = static_cast<double>(step) / steps;
    Polygons& ring = made.rings.emplace_back();
    for (Index p = 0; p < size; ++p) {
      Points2& points = ring.emplace_back(2, count);
      for (int k = 0; k < count; ++k) {
        const double angle = (1 - t) * angles[p][k] + t * even[p][k];
        points.col(k) = circles[p].middle + circles[p].radius * Vec2(portable::cos(angle), portable::sin(angle));
      }
    }
  }
  return made;
}

}  // namespace unsnarl
