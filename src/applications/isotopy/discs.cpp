#include "applications/isotopy/discs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

constexpr double turn = 2 * std::numbers::pi;  ///< A full turn in radians (fixed by geometry)
/// Discs that change places have at most this radius: a third for each, a third between (unit: their smallest distance
/// on the way)
constexpr double disc_of_distance = 1.0 / 3;
/// Ways around that are tried for discs that would meet (unit: ways)
constexpr int most_detours = 1000;
/// A way around is looked for where discs come closer on the way (unit: size of the place)
constexpr double least_way_rel = 1e-3;
/// Within another disc, ways around stay within this part of it (unit: its radius)
constexpr double detour_part = 0.5;
/// Within another disc, discs on their way are no larger than this (unit: its radius)
constexpr double guest_part = 0.2;

/// The smallest distance of two middles while each moves straight.
double smallest_distance(const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < from.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 a = from[i] - from[j], b = to[i] - to[j];
      least = std::min(least, distance_to_segment(Vec2(0, 0), a, b));
    }
  return least;
}

/// Inverse of the plastic number, which makes a sequence of low discrepancy (fixed by algebra)
constexpr double plastic_ratio = 0.7548776662;
constexpr double first_shift = 0.37;   ///< Shift of the sequence's first coordinate from disc to disc (no unit)
constexpr double second_shift = 0.61;  ///< Shift of the sequence's second coordinate from disc to disc (no unit)

/// A place by which each disc goes from one side to the other: the middle of its way if straight ways keep discs apart,
/// else, of a sequence of low discrepancy, what keeps them farthest apart. `host`: they stay in it, if its radius is
/// not 0.
std::vector<Vec2> places_between(const std::vector<Vec2>& a, const std::vector<Vec2>& b, const Disc& host,
                                 double size) {
  std::vector<Vec2> best;
  for (std::size_t c = 0; c < a.size(); ++c) best.push_back(0.5 * (a[c] + b[c]));
  double best_distance = smallest_distance(a, b);
  if (best_distance >= least_way_rel * size) return best;
  for (int k = 1; k <= most_detours; ++k) {
    std::vector<Vec2> way;
    for (std::size_t c = 0; c < a.size(); ++c) {
      const double s = std::fmod((k + first_shift * static_cast<double>(c)) * std::numbers::phi, 1),
                   t = std::fmod(k * plastic_ratio + second_shift * static_cast<double>(c), 1);
      Vec2 place = 0.5 * (a[c] + b[c]) + size * Vec2(s - 0.5, t - 0.5);
      const Vec2 off = place - host.middle;
      if (host.radius > 0 && off.norm() > detour_part * host.radius)
        place = host.middle + detour_part * host.radius / off.norm() * off;
      way.push_back(place);
    }
    const double distance = std::min(smallest_distance(a, way), smallest_distance(way, b));
    if (distance > best_distance) {
      best_distance = distance;
      best = way;
    }
  }
  return best;
}

}  // namespace

Points2 Disc::polygon(Index n, double side) const {
  Points2 p(2, n);
  for (Index k = 0; k < n; ++k) {
    const double angle = phase + side * turn * k / n;
    p.col(k) = middle + radius * Vec2(portable::cos(angle), portable::sin(angle));
  }
  return p;
}

Disc disc_within(const Points2& p, double side) {
  Disc disc;
  const auto n = static_cast<Index>(p.cols());
  disc.middle = p.rowwise().mean();
  disc.radius = std::numeric_limits<double>::infinity();
  double x = 0, y = 0;
  for (Index k = 0; k < n; ++k) {
    const Vec2 d = p.col(k) - disc.middle, a = p.col(k), b = p.col((k + 1) % n);
    const Vec2 foot = a + nearest_fraction(disc.middle, a, b) * (b - a);
    disc.radius = std::min(disc.radius, (foot - disc.middle).norm());
    const double ahead = portable::atan2(d.y(), d.x()) - side * turn * k / n;
    x += portable::cos(ahead);
    y += portable::sin(ahead);
  }
  disc.phase = portable::atan2(y, x);
  return disc;
}

std::vector<std::vector<Disc>> disc_ways(std::vector<Disc> discs, const std::vector<Disc>& to,
                                         std::span<const Index> parent, double size) {
  const auto count = static_cast<Index>(discs.size());
  // Parents come before what is in them.
  std::vector<Index> depth(count, 0);
  for (Index c = 0; c < count; ++c)
    for (Index p = parent[c]; p >= 0; p = parent[p]) ++depth[c];
  const auto is_within = [&](Index c, Index p) {
    for (; c >= 0; c = parent[c])
      if (c == p) return true;
    return false;
  };
  const auto move = [&](Index c, const Vec2& middle, double radius) {
    const Disc before = discs[c];
    for (Index d = 0; d < count; ++d)
      if (is_within(d, c)) {
        discs[d].middle = middle + radius / before.radius * (discs[d].middle - before.middle);
        discs[d].radius *= radius / before.radius;
      }
  };
  std::vector<std::vector<Disc>> states{discs};
  const Index deepest = *std::max_element(depth.begin(), depth.end());
  for (Index level = 0; level <= deepest; ++level) {
    struct Group {
      Index host;
      std::vector<Index> members;
      std::vector<Vec2> from, between, to;
      std::vector<double> small, radius;
    };
    std::vector<Group> groups;
    for (Index c = 0; c < count; ++c)
      if (depth[c] == level) {
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.host == parent[c]; });
        if (group == groups.end()) group = groups.insert(groups.end(), Group{parent[c], {}, {}, {}, {}, {}, {}});
        group->members.push_back(c);
      }
    for (Group& group : groups) {
      const bool is_hosted = group.host >= 0;
      const Disc host = is_hosted ? discs[group.host] : Disc{Vec2(0, 0), 0, 0};
      const double scale = is_hosted ? host.radius / to[group.host].radius : 1;
      for (const Index c : group.members) {
        group.from.push_back(discs[c].middle);
        group.to.push_back(is_hosted ? Vec2(host.middle + scale * (to[c].middle - to[group.host].middle))
                                     : to[c].middle);
        group.radius.push_back(scale * to[c].radius);
      }
      const double room = is_hosted ? host.radius : size;
      group.between = places_between(group.from, group.to, host, room);
      const double apart =
          std::min(smallest_distance(group.from, group.between), smallest_distance(group.between, group.to));
      for (std::size_t i = 0; i < group.members.size(); ++i)
        group.small.push_back(std::min({discs[group.members[i]].radius, group.radius[i], disc_of_distance * apart,
                                        is_hosted ? guest_part * host.radius : size}));
    }
    const auto all_go = [&](auto&& place_of, auto&& radius_of) {
      for (const Group& group : groups)
        for (std::size_t i = 0; i < group.members.size(); ++i)
          move(group.members[i], place_of(group)[i], radius_of(group)[i]);
      states.push_back(discs);
    };
    const auto small = [](const Group& g) { return g.small; };
    all_go([](const Group& g) { return g.from; }, small);
    all_go([](const Group& g) { return g.between; }, small);
    all_go([](const Group& g) { return g.to; }, small);
    all_go([](const Group& g) { return g.to; }, [](const Group& g) { return g.radius; });
  }
  return states;
}

}  // namespace unsnarl
