#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "applications/knots/align_knots.h"
#include "applications/knots/knot_path.h"
#include "applications/knots/moving_polygon.h"
#include "applications/knots/strip.h"
#include "unsnarl/knot_isotopy.h"

namespace unsnarl {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument(what);
}

void check_pieces(const char* name, const std::vector<int>& pieces, std::size_t edges, std::size_t points) {
  if (pieces.size() != edges)
    refuse(fmt::format("{} has {} numbers, but the knot {} edges", name, pieces.size(), edges));
  std::size_t sum = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (pieces[k] < 1) refuse(fmt::format("{}[{}] is {}; give 1 or more", name, k, pieces[k]));
    sum += static_cast<std::size_t>(pieces[k]);
  }
  if (sum != points)
    refuse(fmt::format("the sum of {} is {}, but the rings between have {} points", name, sum, points));
}

/// Larger coordinates are refused, so that products of several are finite (unit: length)
constexpr double largest_ring_coordinate = 1e70;

void check_rings(const KnotIsotopy& isotopy) {
  const std::size_t count = isotopy.rings.size();
  if (count < 4) refuse(fmt::format("there are {} rings; an isotopy has four or more", count));
  for (std::size_t k = 0; k < count; ++k) {
    const KnotRing& ring = isotopy.rings[k];
    if (ring.points.size() < 9 || ring.points.size() % 3 != 0)
      refuse(fmt::format("ring {} has {} numbers; give three for each of three points or more", k, ring.points.size()));
    if (!std::all_of(ring.points.begin(), ring.points.end(),
                     [](double v) { return std::abs(v) <= largest_ring_coordinate; }))
      refuse(fmt::format("ring {} has a coordinate that is not finite or beyond 1e70", k));
    if (!(ring.time >= 0 && ring.time <= 1) || (k > 0 && !(ring.time > isotopy.rings[k - 1].time)))
      refuse(fmt::format("the time of ring {} is {}; times ascend from 0 to 1", k, ring.time));
    if (k > 1 && k + 1 < count && ring.points.size() != isotopy.rings[1].points.size())
      refuse(fmt::format("ring {} has {} points, but ring 1 has {}", k, ring.points.size() / 3,
                         isotopy.rings[1].points.size() / 3));
  }
  if (isotopy.rings.front().time != 0 || isotopy.rings.back().time != 1)
    refuse("the times do not begin with 0 and end with 1");
  const std::size_t points = isotopy.rings[1].points.size() / 3;
  if (points < 4) refuse("the rings between have fewer than four points");
  check_pieces("start_pieces", isotopy.start_pieces, isotopy.rings.front().points.size() / 3, points);
  check_pieces("end_pieces", isotopy.end_pieces, isotopy.rings.back().points.size() / 3, points);
  if (isotopy.end_first < 0 || static_cast<std::size_t>(isotopy.end_first) >= points)
    refuse(fmt::format("end_first is {}; give 0 to {}", isotopy.end_first, points - 1));
}

/// From ring k to the next.
std::vector<StripTriangle> strip_at(const KnotIsotopy& isotopy, std::size_t k) {
  if (k == 0) return strip_to_finer(isotopy.start_pieces);
  if (k + 2 == isotopy.rings.size()) return strip_from_finer(isotopy.end_pieces, isotopy.end_first);
  return straight_strip(static_cast<Index>(isotopy.rings[k].points.size() / 3));
}

}  // namespace

KnotIsotopyFindings check_knot_isotopy(const KnotIsotopy& isotopy, const Link& start, const Link& end) {
  check_rings(isotopy);
  if (start.components.size() != 1 || end.components.size() != 1) refuse("start and end have one component each");
  KnotIsotopyFindings findings;
  const Positions first = points_of(isotopy.rings.front().points), last = points_of(isotopy.rings.back().points);
  const auto is_same = [](const Positions& a, const Positions& b) { return a.cols() == b.cols() && a == b; };
  findings.ends_kept = is_same(first, points_of(start.components[0])) &&
                       is_same(last, reordered(points_of(end.components[0]), 0, isotopy.reversed));
  std::vector<Positions> rings;
  for (const KnotRing& ring : isotopy.rings) rings.push_back(points_of(ring.points));
  const double unit = exact_unit(rings);
  for (Positions& ring : rings) ring /= unit;
  const std::size_t strips = rings.size() - 1;
  for (std::size_t k = 0; k < strips; ++k) {
    const Positions &lower = rings[k], &upper = rings[k + 1];
    findings.meeting_triangles += meeting_pairs(lower, upper, strip_at(isotopy, k), SIZE_MAX).size();
    const Positions from = k == 0 ? with_pieces(lower, isotopy.start_pieces) : lower;
    const Positions to =
        k + 1 < strips
            ? upper
            : reordered(with_pieces(upper, isotopy.end_pieces),
                        (static_cast<Index>(lower.cols()) - isotopy.end_first) % static_cast<Index>(lower.cols()),
                        false);
    if (!stays_simple(from, to)) ++findings.unproven_motions;
  }
  return findings;
}

Link knot_isotopy_slice(const KnotIsotopy& isotopy, double time) {
  check_rings(isotopy);
  if (!(time >= 0 && time <= 1)) refuse(fmt::format("time is {}; give 0 to 1", time));
  std::size_t k = 0;
  while (k + 2 < isotopy.rings.size() && isotopy.rings[k + 1].time <= time) ++k;
  const KnotRing &from = isotopy.rings[k], &to = isotopy.rings[k + 1];
  const double t = (time - from.time) / (to.time - from.time);
  Link link;
  std::vector<double>& points = link.components.emplace_back();
  if (t <= 0 || t >= 1) {
    points = t <= 0 ? from.points : to.points;
    return link;
  }
  const std::size_t m = from.points.size() / 3, n = to.points.size() / 3;
  for (const StripTriangle& triangle : strip_at(isotopy, k)) {
    // The point at which the level cuts the side of the triangle that comes first along the polygon.
    const std::size_t a = static_cast<std::size_t>(triangle.on_lower ? triangle.edge : triangle.apex) % m;
    const std::size_t b = static_cast<std::size_t>(triangle.on_lower ? triangle.apex : triangle.edge) % n;
    for (int axis = 0; axis < 3; ++axis)
      points.push_back((1 - t) * from.points[3 * a + axis] + t * to.points[3 * b + axis]);
  }
  return link;
}

}  // namespace unsnarl
