#include "applications/isotopy/correspondence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// Corners of start and end become one point where they are closer than this along the curve (unit: mean distance of
/// points)
constexpr double one_corner = 0.25;
/// Places of a curve at which layings are compared (unit: places)
constexpr int laying_samples = 128;
/// A laying is better where what is left is smaller by more than rounding (no unit)
constexpr double better_laying = 1 - 1e-9;
constexpr double full_turn = 2 * std::numbers::pi;  ///< A full turn in radians (fixed by geometry)

/// The fraction of the length at which each point lies, and 1.
std::vector<double> fractions_of(const Points2& p) {
  const auto n = static_cast<Index>(p.cols());
  std::vector<double> at(n + 1, 0);
  for (Index k = 0; k < n; ++k) at[k + 1] = at[k] + (p.col((k + 1) % n) - p.col(k)).norm();
  const double length = at[n];
  for (double& x : at) x /= length;
  at[n] = 1;
  return at;
}

/// Points at equal distances along the polygon.
Points2 evenly(const Points2& p, int count) {
  const std::vector<double> at = fractions_of(p);
  const auto n = static_cast<Index>(p.cols());
  Points2 even(2, count);
  Index k = 0;
  for (int i = 0; i < count; ++i) {
    const double u = static_cast<double>(i) / count;
    while (k + 1 < n && at[k + 1] <= u) ++k;
    const double t = at[k + 1] > at[k] ? (u - at[k]) / (at[k + 1] - at[k]) : 0;
    even.col(i) = p.col(k) + t * (p.col((k + 1) % n) - p.col(k));
  }
  return even;
}

/// A corner of the start, of the end, or of both, at fractions u of the start and v of the end from its first place on.
struct Item {
  double u = 0, v = 0;
  Index on_start = -1, on_end = -1;
};

/// A closed polygon whose points are counted from one of its places on.
struct Laid {
  std::vector<double> at;     ///< ascending, from the place on, within [0, 1)
  std::vector<Index> corner;  ///< the number of each
};

Laid laid(const Points2& p, double first) {
  Laid made;
  const std::vector<double> whole = fractions_of(p);
  const auto n = static_cast<Index>(p.cols());
  Index begin = 0;
  while (begin < n && whole[begin] < first) ++begin;
  for (Index i = 0; i < n; ++i) {
    const Index k = (begin + i) % n;
    const double x = whole[k] - first;
    made.at.push_back(x < 0 ? x + 1 : x);
    made.corner.push_back(k);
  }
  return made;
}

/// All corners in order; the first item is point 0 of the start.
std::vector<Item> corners_of(const Points2& start, const Points2& end, double first, int least) {
  Laid a = laid(start, 0), b = laid(end, first);
  const double near = one_corner / std::max<double>(least, static_cast<double>(start.cols() + end.cols()));
  std::vector<Item> anchors{{0, 0, 0, -1}};
  std::size_t i = 1, j = 0;
  if (b.at[0] == 0) anchors[0].on_end = b.corner[j++];
  while (i < a.at.size() && j < b.at.size()) {
    if (std::abs(a.at[i] - b.at[j]) < near) {
      anchors.push_back({a.at[i], b.at[j], a.corner[i], b.corner[j]});
      ++i, ++j;
    } else {
      ++(a.at[i] < b.at[j] ? i : j);
    }
  }
  anchors.push_back({1, 1, -1, -1});
  std::vector<Item> items;
  i = 1, j = anchors[0].on_end >= 0 ? 1 : 0;
  for (std::size_t k = 0; k + 1 < anchors.size(); ++k) {
    const Item &from = anchors[k], &to = anchors[k + 1];
    items.push_back(from);
    const double slope = (to.v - from.v) / (to.u - from.u);
    while (true) {
      const bool more_a = i < a.at.size() && a.corner[i] != to.on_start && a.at[i] < to.u;
      const bool more_b = j < b.at.size() && b.corner[j] != to.on_end && b.at[j] < to.v;
      if (!more_a && !more_b) break;
      const double v_of_a = more_a ? from.v + slope * (a.at[i] - from.u) : 2;
      if (more_a && (!more_b || v_of_a < b.at[j])) {
        items.push_back({a.at[i], v_of_a, a.corner[i], -1});
        ++i;
      } else {
        items.push_back({from.u + (b.at[j] - from.v) / slope, b.at[j], -1, b.corner[j]});
        ++j;
      }
    }
    if (to.on_start >= 0) ++i;
    if (to.on_end >= 0) ++j;
  }
  return items;
}

Item after(const std::vector<Item>& items, std::size_t k) {
  return k + 1 < items.size() ? items[k + 1] : Item{1, 1, -1, -1};
}

/// Into how many parts pieces of these lengths are cut until there are `count`: always the one whose parts are longest.
template <class Length>
std::vector<int> parts_by_length(std::size_t pieces, Length&& length, int count) {
  std::vector<int> parts(pieces, 1);
  std::priority_queue<std::pair<double, std::int64_t>> longest;
  for (std::size_t k = 0; k < pieces; ++k) longest.emplace(length(k), -static_cast<std::int64_t>(k));
  for (std::size_t made = pieces; made < static_cast<std::size_t>(count); ++made) {
    const auto k = static_cast<std::size_t>(-longest.top().second);
    longest.pop();
    ++parts[k];
    longest.emplace(length(k) / parts[k], -static_cast<std::int64_t>(k));
  }
  return parts;
}

/// Item k, then points that part the way to the next one evenly.
void add_parted(const std::vector<Item>& items, std::size_t k, int parts, std::vector<Item>& to) {
  const Item from = items[k], next = after(items, k);
  to.push_back(from);
  for (int i = 1; i < parts; ++i) {
    const double t = static_cast<double>(i) / parts;
    to.push_back({from.u + t * (next.u - from.u), from.v + t * (next.v - from.v), -1, -1});
  }
}

/// The places of items on a polygon: `whole` has the fractions of its corners, `edge` is where the first item lies.
template <class CornerOf, class FractionOf>
std::vector<IsotopyPlace> places_of(const std::vector<Item>& items, const std::vector<double>& whole, Index edge,
                                    CornerOf&& corner_of, FractionOf&& fraction_of) {
  std::vector<IsotopyPlace> places;
  for (const Item& item : items) {
    if (corner_of(item) >= 0) {
      edge = corner_of(item);
      places.push_back({edge, 0});
      continue;
    }
    double at = fraction_of(item);
    if (at > whole[edge + 1] && at >= 1) at -= 1;
    const double length = whole[edge + 1] - whole[edge];
    const double t = length > 0 ? (at - whole[edge]) / length : 0;
    places.push_back({edge, std::clamp(t, 0.0, 1 - 0x1p-53)});
  }
  return places;
}

}  // namespace

Points2 points_at(const Points2& polygon, std::span<const IsotopyPlace> places) {
  const auto n = static_cast<Index>(polygon.cols());
  Points2 made(2, static_cast<Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto [edge, fraction] = places[k];
    const Vec2 a = polygon.col(edge), b = polygon.col((edge + 1) % n);
    made.col(static_cast<Index>(k)) = fraction == 0 ? a : Vec2((1 - fraction) * a + fraction * b);
  }
  return made;
}

double first_fraction(const Points2& start, const Points2& end, Laying laying) {
  constexpr int n = laying_samples;
  Points2 a = evenly(start, n), b = evenly(end, n);
  if (laying == Laying::places) {
    a.colwise() -= Vec2(a.rowwise().mean());
    b.colwise() -= Vec2(b.rowwise().mean());
  } else {
    // The directions of edges, as numbers that grow by a full turn around the curve.
    const auto directions = [n](const Points2& p) {
      Points2 d(2, n);
      double angle = 0;
      for (int k = 0; k < n; ++k) {
        const Vec2 edge = p.col((k + 1) % n) - p.col(k);
        const double now = portable::atan2(edge.y(), edge.x());
        const double turns = k == 0 ? 0 : std::floor((angle - now) / full_turn + 0.5);
        angle = now + turns * full_turn;
        d.col(k) = Vec2(angle, 0);
      }
      return d;
    };
    a = directions(a);
    b = directions(b);
  }
  const double turn_of_b = [&] {
    if (laying == Laying::places) return 0.0;
    return b(0, n - 1) > b(0, 0) ? full_turn : -full_turn;
  }();
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int first = 0; first < n; ++first) {
    Vec2 sum(0, 0);
    double squares = 0;
    for (int k = 0; k < n; ++k) {
      Vec2 d = b.col((first + k) % n) - a.col(k);
      if (first + k >= n) d.x() += turn_of_b;
      sum += d;
      squares += d.squaredNorm();
    }
    const double left = squares - sum.squaredNorm() / n;
    if (left < least * better_laying) {
      least = left;
      best = first;
    }
  }
  // A corner of the end that is that near is meant.
  const double fraction = static_cast<double>(best) / n;
  double nearest = fraction, distance = 0.5 / n;
  for (const double at : fractions_of(end))
    if (std::abs(at - fraction) < distance) {
      distance = std::abs(at - fraction);
      nearest = at;
    }
  return nearest >= 1 ? 0 : nearest;
}

Correspondence correspondence(const Polygons& start, const Polygons& end, std::span<const double> first, int least) {
  Correspondence made;
  for (std::size_t c = 0; c < start.size(); ++c) {
    const std::vector<Item> corners = corners_of(start[c], end[c], first[c], least);
    const auto length = [&](std::size_t k) {
      return std::max(after(corners, k).u - corners[k].u, after(corners, k).v - corners[k].v);
    };
    const std::vector<int> parts = parts_by_length(corners.size(), length, least);
    std::vector<Item> items;
    for (std::size_t k = 0; k < corners.size(); ++k) add_parted(corners, k, parts[k], items);
    const std::vector<double> a = fractions_of(start[c]), b = fractions_of(end[c]);
    Index edge = 0;
    while (edge + 1 < static_cast<Index>(end[c].cols()) && b[edge + 1] <= first[c]) ++edge;
    made.on_start.push_back(places_of(
        items, a, 0, [](const Item& i) { return i.on_start; }, [](const Item& i) { return i.u; }));
    made.on_end.push_back(places_of(
        items, b, edge, [](const Item& i) { return i.on_end; }, [&](const Item& i) { return first[c] + i.v; }));
  }
  return made;
}

std::vector<IsotopyPlace> places_along(const Points2& polygon, std::span<const Index> corners,
                                       const std::vector<IsotopyPlace>& on_other) {
  const auto n = static_cast<Index>(polygon.cols());
  const std::vector<double> at = fractions_of(polygon);
  std::vector<IsotopyPlace> places;
  for (const IsotopyPlace& place : on_other) {
    const Index from = corners[place.edge], to = corners[(static_cast<std::size_t>(place.edge) + 1) % corners.size()];
    const double way = to > from ? at[to] - at[from] : at[to] + 1 - at[from];
    double left = place.fraction * way;
    Index edge = from;
    while (edge + 1 != to && edge + 1 - n != to && left >= at[edge % n + 1] - at[edge % n]) {
      left -= at[edge % n + 1] - at[edge % n];
      ++edge;
    }
    const double length = at[edge % n + 1] - at[edge % n];
    places.push_back({edge % n, length > 0 ? std::clamp(left / length, 0.0, 1 - 0x1p-53) : 0.0});
  }
  return places;
}

std::vector<std::vector<IsotopyPlace>> even_places(const Polygons& polygons, std::span<const int> count) {
  std::vector<std::vector<IsotopyPlace>> places;
  for (std::size_t c = 0; c < polygons.size(); ++c) {
    const Points2& p = polygons[c];
    const auto n = static_cast<Index>(p.cols());
    const auto length = [&](std::size_t k) {
      return (p.col((static_cast<Index>(k) + 1) % n) - p.col(static_cast<Index>(k))).norm();
    };
    const std::vector<int> parts = parts_by_length(static_cast<std::size_t>(n), length, count[c]);
    std::vector<IsotopyPlace>& list = places.emplace_back();
    for (Index k = 0; k < n; ++k)
      for (int i = 0; i < parts[k]; ++i) list.push_back({k, static_cast<double>(i) / parts[k]});
  }
  return places;
}

}  // namespace unsnarl
