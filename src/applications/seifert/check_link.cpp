#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/box.h"
#include "geometry/triangle_intersection.h"
#include "unsnarl/link.h"

namespace unsnarl {
namespace {

/// Larger coordinates are refused: their squares and cubes overflow (unit: length)
constexpr double largest_coordinate = 1e70;

struct Segment {
  Index component = 0, point = 0, count = 0;
  Vec3 a, b;
  Box box;
};

std::vector<Segment> segments_of(const Link& link) {
  std::vector<Segment> segments;
  for (std::size_t c = 0; c < link.components.size(); ++c) {
    const std::vector<double>& p = link.components[c];
    const auto n = static_cast<Index>(p.size() / 3);
    const auto at = [&](Index k) { return Vec3(p[3 * k], p[3 * k + 1], p[3 * k + 2]); };
    for (Index k = 0; k < n; ++k) {
      Segment s{static_cast<Index>(c), k, n, at(k), at((k + 1) % n), {}};
      s.box.extend(s.a);
      s.box.extend(s.b);
      segments.push_back(s);
    }
  }
  return segments;
}

bool meet(const Segment& s, const Segment& t) {
  std::array<int, 3> shared{-1, -1, -1};
  if (s.component == t.component && (s.point + 1) % s.count == t.point) shared = {-1, 0, 0};
  if (s.component == t.component && (t.point + 1) % t.count == s.point) shared = {1, -1, -1};
  return degenerate_triangles_meet({s.a, s.b, s.b}, {t.a, t.b, t.b}, shared);
}

}  // namespace

std::size_t Link::point_count() const {
  std::size_t count = 0;
  for (const std::vector<double>& component : components) count += component.size() / 3;
  return count;
}

void check_link(const Link& link) {
  if (link.components.empty())
    throw std::invalid_argument("a link without components; give at least one closed polygon");
  for (std::size_t c = 0; c < link.components.size(); ++c) {
    const std::vector<double>& p = link.components[c];
    if (p.size() % 3 != 0)
      throw std::invalid_argument(fmt::format("component {} has {} numbers, not three a point", c, p.size()));
    if (p.size() < 9)
      throw std::invalid_argument(
          fmt::format("component {} has {} points; a closed polygon has three or more", c, p.size() / 3));
    for (std::size_t k = 0; k < p.size(); ++k)
      if (!(std::abs(p[k]) <= largest_coordinate))
        throw std::invalid_argument(
            fmt::format("point {} of component {} is not finite or beyond {}", k / 3, c, largest_coordinate));
  }
  const std::vector<Segment> segments = segments_of(link);
  for (const Segment& s : segments)
    if (s.a == s.b)
      throw std::invalid_argument(fmt::format("points {} and {} of component {} are one; leave out one of them",
                                              s.point, (s.point + 1) % s.count, s.component));
  std::vector<const Segment*> order;
  for (const Segment& s : segments) order.push_back(&s);
  std::stable_sort(order.begin(), order.end(),
                   [](const Segment* s, const Segment* t) { return s->box.lo[0] < t->box.lo[0]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && order[j]->box.lo[0] <= order[i]->box.hi[0]; ++j) {
      const Segment &s = *order[i], &t = *order[j];
      if (s.box.overlaps(t.box) && meet(s, t))
        throw std::invalid_argument(
            fmt::format("edge {} of component {} and edge {} of component {} touch; a link's edges meet "
                        "in their ends only",
                        s.point, s.component, t.point, t.component));
    }
}

}  // namespace unsnarl
