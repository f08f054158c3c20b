#include "applications/isotopy/round_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "applications/isotopy/corner_removal.h"
#include "applications/isotopy/correspondence.h"
#include "geometry/portable_math.h"
#include "geometry/predicates.h"

namespace unsnarl {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;  ///< A full turn in radians (fixed by geometry)
/// What moves within a polygon shrinks to this part of the free space around its way (no unit)
constexpr double guest_size = 0.2;
/// Places in a triangle lie on a circle of this part of its incircle's radius (no unit)
constexpr double places_radius = 0.5;
/// What lies in a circle is drawn into this part of its radius; half is what discs.h asks for (no unit)
constexpr double contents_part = 0.4;
/// Points turn about the middle of a circle by at most this from state to state; below a quarter turn their order stays
/// (unit: turns)
constexpr double turn_a_state = 0.125;

double distance_of_segments(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto to_segment = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return (p - (q + nearest_fraction(p, q, r) * (r - q))).norm();
  };
  // They do not cross where this is called.
  return std::min({to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
}

struct Incircle {
  Vec2 middle;
  double radius = 0;
};

Incircle incircle_of(const std::array<Vec2, 3>& t) {
  const double a = (t[2] - t[1]).norm(), b = (t[0] - t[2]).norm(), c = (t[1] - t[0]).norm();
  const Vec2 u = t[1] - t[0], v = t[2] - t[0];
  return {(a * t[0] + b * t[1] + c * t[2]) / (a + b + c), std::abs(u.x() * v.y() - u.y() * v.x()) / (a + b + c)};
}

/// A triangle within a triangle of which it has the height and no smaller angle than both others allow: ends of the
/// longest edge come nearer to the foot of the height, to within what an equilateral triangle has.
std::array<Vec2, 3> stout(const std::array<Vec2, 3>& t) {
  int top = 0;
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    if (const double length = (t[(k + 2) % 3] - t[(k + 1) % 3]).norm(); length > longest) {
      longest = length;
      top = k;
    }
  std::array<Vec2, 3> made = t;
  const Vec2 a = t[(top + 1) % 3], b = t[(top + 2) % 3];
  const Vec2 foot = a + nearest_fraction(t[top], a, b) * (b - a);
  const double reach = (t[top] - foot).norm() / std::numbers::sqrt3;
  for (int k = 1; k <= 2; ++k) {
    Vec2& end = made[(top + k) % 3];
    const double off = (end - foot).norm();
    if (off > reach) end = foot + reach / off * (end - foot);
  }
  return made;
}

class Rounding {
 public:
  Rounding(const Polygons& exact, const std::vector<std::vector<IsotopyPlace>>& places, std::span<const Index> parent,
           std::span<const double> sides, const std::function<bool()>& stop)
      : parent_(parent), sides_(sides), stop_(stop) {
    Index n = 0;
    for (const auto& list : places) {
      first_.push_back(n);
      n += static_cast<Index>(list.size());
    }
    first_.push_back(n);
    c_.x.resize(2, n);
    c_.is_corner.assign(n, 0);
    c_.is_kept.assign(n, 0);
    c_.before.assign(n, 0);
    c_.after.assign(n, 0);
    c_.polygon.assign(n, 0);
    for (Index p = 0; p < count(); ++p) {
      c_.x.middleCols(first_[p], first_[p + 1] - first_[p]) = points_at(exact[p], places[p]);
      c_.count.push_back(static_cast<Index>(exact[p].cols()));
      Index last = -1;
      for (Index v = first_[p]; v < first_[p + 1]; ++v) {
        c_.polygon[v] = p;
        if (places[p][v - first_[p]].fraction != 0) continue;
        c_.is_corner[v] = 1;
        c_.before[v] = last;
        if (last >= 0) c_.after[last] = v;
        last = v;
      }
      const Index v = corner_from(first_[p]);
      c_.before[v] = last;
      c_.after[last] = v;
    }
  }

  std::vector<Polygons> run() {
    add_state();
    while (!stop_()) {
      remove_all();
      const Index stuck = deepest_that_is_stuck();
      if (stuck < 0) break;
      gather_contents(stuck);
    }
    if (!stop_()) make_circles();
    if (stop_()) return {};
    return std::move(states_);
  }

 private:
  Index count() const { return static_cast<Index>(first_.size()) - 1; }

  bool is_in(Index polygon, Index other) const {
    for (polygon = parent_[polygon]; polygon >= 0; polygon = parent_[polygon])
      if (polygon == other) return true;
    return false;
  }
  Index depth_of(Index polygon) const {
    Index depth = 0;
    for (; parent_[polygon] >= 0; polygon = parent_[polygon]) ++depth;
    return depth;
  }
  Index corner_from(Index v) const {
    while (c_.is_corner[v] == 0) ++v;
    return v;
  }
  /// The three corners of a polygon that has no more.
  std::array<Index, 3> corners_of(Index polygon) const {
    const Index v = corner_from(first_[polygon]);
    return {v, c_.after[v], c_.after[c_.after[v]]};
  }
  std::array<Vec2, 3> triangle_of(Index polygon) const {
    const auto [a, b, c] = corners_of(polygon);
    return {c_.x.col(a), c_.x.col(b), c_.x.col(c)};
  }
  Index next_in_polygon(Index v) const { return v + 1 < first_[c_.polygon[v] + 1] ? v + 1 : first_[c_.polygon[v]]; }

  /// The points on the edge from a corner to the next one, in order; they are evenly spaced, so that they never crowd.
  template <class Visit>
  void points_after(Index corner, Visit&& visit) const {
    const Index size = first_[c_.polygon[corner] + 1] - first_[c_.polygon[corner]], after = c_.after[corner];
    const double parts = after > corner ? after - corner : after - corner + size;
    Index k = 1;
    for (Index v = next_in_polygon(corner); v != after; v = next_in_polygon(v)) visit(v, k++ / parts);
  }

  void place_points_between(Index polygon) {
    for (const Index corner : corners_in_order(polygon))
      points_after(corner, [&](Index v, double part) {
        c_.x.col(v) = (1 - part) * c_.x.col(corner) + part * c_.x.col(c_.after[corner]);
      });
  }

  void add_state() {
    Polygons& state = states_.emplace_back();
    for (Index p = 0; p < count(); ++p) state.push_back(c_.x.middleCols(first_[p], first_[p + 1] - first_[p]));
  }

  void remove(const CornerRemoval& removal) {
    const auto [before, corner, after] = removal;
    c_.is_corner[corner] = 0;
    c_.after[before] = after;
    c_.before[after] = before;
    --c_.count[c_.polygon[corner]];
  }

  void remove_all() {
    const std::vector<CornerRemoval> removals = remove_corners(c_);
    const std::vector<int> rounds = rounds_of(c_.x, removals);
    const int last = rounds.empty() ? -1 : *std::max_element(rounds.begin(), rounds.end());
    std::vector<std::vector<CornerRemoval>> of_round(last + 1);
    for (std::size_t k = 0; k < removals.size(); ++k) of_round[rounds[k]].push_back(removals[k]);
    for (const std::vector<CornerRemoval>& round : of_round) {
      if (stop_()) return;
      for (const CornerRemoval& removal : round) remove(removal);
      for (Index p = 0; p < count(); ++p) place_points_between(p);
      add_state();
    }
  }

  Index deepest_that_is_stuck() const {
    Index deepest = -1;
    for (Index p = 0; p < count(); ++p)
      if (c_.count[p] > 3 && (deepest < 0 || depth_of(p) > depth_of(deepest))) deepest = p;
    return deepest;
  }

  /// Moves a polygon with all that lies in it: by a scale about a point, then by a shift.
  void move_with_contents(Index polygon, const Vec2& about, double scale, const Vec2& shift) {
    for (Index p = 0; p < count(); ++p)
      if (p == polygon || is_in(p, polygon))
        for (Index v = first_[p]; v < first_[p + 1]; ++v) c_.x.col(v) = about + scale * (c_.x.col(v) - about) + shift;
  }

  struct Guest {
    Index polygon = 0;
    double reach = 0;
    std::vector<Vec2> way;  // of its middle
  };

  /// What lies in a polygon shrinks and moves, one after the other, to the triangle that is left of a triangulation.
  void gather_contents(Index host) {
    Corners all_free = c_;
    all_free.is_kept.assign(all_free.is_kept.size(), 0);
    const std::vector<CornerRemoval> ears = remove_ears(all_free, host, sides_[host]);
    std::vector<Index> left;
    const std::vector<Index> edges = corners_in_order(host);
    for (const Index v : edges)
      if (std::none_of(ears.begin(), ears.end(), [&](const CornerRemoval& e) { return e.corner == v; }))
        left.push_back(v);
    for (const Index v : left) c_.is_kept[v] = 1;
    const Incircle room = incircle_of({c_.x.col(left[0]), c_.x.col(left[1]), c_.x.col(left[2])});

    std::vector<Guest> guests;
    for (Index p = 0; p < count(); ++p)
      if (parent_[p] == host) guests.push_back(guest_of(p, ears));
    // Those that are nearer go first, so that nobody stands in the way.
    std::stable_sort(guests.begin(), guests.end(), [](const Guest& a, const Guest& b) {
      if (a.way.size() != b.way.size()) return a.way.size() < b.way.size();
      return a.way.size() > 1 && (a.way[1] - a.way[0]).norm() < (b.way[1] - b.way[0]).norm();
    });
    double free = std::numeric_limits<double>::infinity();
    std::vector<Vec2> standing;
    for (const Guest& guest : guests) standing.push_back(guest.way.front());
    std::vector<std::uint8_t> is_taken(guests.size(), 0);
    for (std::size_t g = 0; g < guests.size(); ++g) {
      std::vector<Vec2>& way = guests[g].way;
      const auto apart = [&](const Vec2& a, const Vec2& b) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t other = 0; other < guests.size(); ++other)
          if (other != g)
            least = std::min(least, (standing[other] - (a + nearest_fraction(standing[other], a, b) * (b - a))).norm());
        return least;
      };
      double best = -1;
      std::size_t place = 0;
      for (std::size_t k = 0; k < guests.size(); ++k) {
        if (is_taken[k] != 0) continue;
        if (const double d = apart(way.back(), place_in(room, k, guests.size())); d > best) {
          best = d;
          place = k;
        }
      }
      is_taken[place] = 1;
      way.push_back(place_in(room, place, guests.size()));
      for (std::size_t k = 0; k + 1 < way.size(); ++k) {
        free = std::min(free, apart(way[k], way[k + 1]));
        for (const Index v : edges)
          free = std::min(free, distance_of_segments(way[k], way[k + 1], c_.x.col(v), c_.x.col(c_.after[v])));
      }
      standing[g] = way.back();
    }
    for (const Guest& guest : guests)
      move_with_contents(guest.polygon, guest.way.front(), std::min(1.0, guest_size * free / guest.reach), Vec2(0, 0));
    add_state();
    for (const Guest& guest : guests)
      for (std::size_t k = 0; k + 1 < guest.way.size(); ++k) {
        move_with_contents(guest.polygon, guest.way[k], 1, guest.way[k + 1] - guest.way[k]);
        add_state();
      }
  }

  std::vector<Index> corners_in_order(Index polygon) const {
    std::vector<Index> list{corner_from(first_[polygon])};
    for (Index v = c_.after[list[0]]; v != list[0]; v = c_.after[v]) list.push_back(v);
    return list;
  }

  static Vec2 place_in(const Incircle& room, std::size_t k, std::size_t count) {
    if (count == 1) return room.middle;
    const double angle = whole_turn * static_cast<double>(k) / static_cast<double>(count);
    return room.middle + places_radius * room.radius * Vec2(portable::cos(angle), portable::sin(angle));
  }

  /// A triangle's way through the triangles of a triangulation, by the middles of the edges between them.
  Guest guest_of(Index polygon, const std::vector<CornerRemoval>& ears) const {
    const std::array<Vec2, 3> t = triangle_of(polygon);
    Guest guest{polygon, 0, {(t[0] + t[1] + t[2]) / 3}};
    for (const Vec2& p : t) guest.reach = std::max(guest.reach, (p - guest.way[0]).norm());
    const auto holds = [&](const CornerRemoval& ear) {
      const Vec2 a = c_.x.col(ear.before), b = c_.x.col(ear.corner), c = c_.x.col(ear.after), p = guest.way[0];
      const auto side = [&](const Vec2& q, const Vec2& r) {
        return sides_[parent_[polygon]] * orient2d(q.x(), q.y(), r.x(), r.y(), p.x(), p.y());
      };
      return side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0;
    };
    auto ear = std::find_if(ears.begin(), ears.end(), holds);
    while (ear != ears.end()) {
      const Index a = ear->before, b = ear->after;
      guest.way.push_back(0.5 * (c_.x.col(a) + c_.x.col(b)));
      ear = std::find_if(ear + 1, ears.end(), [&](const CornerRemoval& next) {
        return (next.before == a && next.corner == b) || (next.corner == a && next.after == b);
      });
    }
    return guest;
  }

  /// Triangles, each with what lies in it, become circles.
  void make_circles() {
    std::vector<Incircle> circles(count());
    std::vector<std::vector<double>> angles(count());
    // What lies in a triangle is drawn to the middle of the circle, from the outermost triangles inward.
    std::vector<Index> order(count());
    for (Index p = 0; p < count(); ++p) order[p] = p;
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return depth_of(a) < depth_of(b); });
    for (const Index p : order) {
      const std::array<Vec2, 3> slim = stout(triangle_of(p));
      const Incircle circle = incircle_of(slim);
      double reach = 0;
      for (Index q = 0; q < count(); ++q)
        if (is_in(q, p))
          for (const Vec2& v : triangle_of(q)) reach = std::max(reach, (v - circle.middle).norm());
      const double part = contents_part * circle.radius * least_chord(p, slim, circle) / reach;
      if (!(reach > 0) || part >= 1) continue;
      for (Index q = 0; q < count(); ++q)
        if (parent_[q] == p) move_with_contents(q, circle.middle, part, Vec2(0, 0));
    }
    add_state();
    for (Index p = 0; p < count(); ++p) {
      const std::array<Index, 3> at = corners_of(p);
      const std::array<Vec2, 3> slim = stout(triangle_of(p));
      for (int k = 0; k < 3; ++k) c_.x.col(at[k]) = slim[k];
      place_points_between(p);
      circles[p] = incircle_of(slim);
    }
    add_state();
    int steps = 1;
    std::vector<std::vector<double>> even(count());
    for (Index p = 0; p < count(); ++p) {
      const Index n = first_[p + 1] - first_[p];
      angles[p] = angles_of(p, circles[p].middle);
      double ahead = 0;
      for (Index k = 0; k < n; ++k) ahead += (angles[p][k] - sides_[p] * whole_turn * k / n) / n;
      for (Index k = 0; k < n; ++k) {
        even[p].push_back(ahead + sides_[p] * whole_turn * k / n);
        const double turns = std::abs(even[p][k] - angles[p][k]) / whole_turn;
        steps = std::max(steps, static_cast<int>(std::ceil(turns / turn_a_state)));
      }
    }
    for (int step = 0; step <= steps && !stop_(); ++step) {
      const double t = static_cast<double>(step) / steps;
      for (Index p = 0; p < count(); ++p)
        for (std::size_t k = 0; k < even[p].size(); ++k) {
          const double angle = (1 - t) * angles[p][k] + t * even[p][k];
          c_.x.col(first_[p] + static_cast<Index>(k)) =
              circles[p].middle + circles[p].radius * Vec2(portable::cos(angle), portable::sin(angle));
        }
      add_state();
    }
  }

  /// The angles of a polygon's points seen from a point in it, without jumps.
  std::vector<double> angles_of(Index polygon, const Vec2& middle) const {
    std::vector<double> angles;
    for (Index v = first_[polygon]; v < first_[polygon + 1]; ++v) {
      const Vec2 d = c_.x.col(v) - middle;
      double angle = portable::atan2(d.y(), d.x());
      if (!angles.empty()) angle += whole_turn * std::floor((angles.back() - angle) / whole_turn + 0.5);
      angles.push_back(angle);
    }
    return angles;
  }

  /// The distance from the middle of a circle to the chords between points at the angles that those of a triangle have
  /// (unit: the circle's radius).
  double least_chord(Index polygon, const std::array<Vec2, 3>& triangle, const Incircle& circle) const {
    double least = 1;
    const std::array<Index, 3> at = corners_of(polygon);
    for (int k = 0; k < 3; ++k) {
      const Vec2 a = triangle[k], b = triangle[(k + 1) % 3];
      Vec2 last = a - circle.middle;
      const auto look = [&](const Vec2& at_circle) {
        least = std::min(least, 0.5 * (last.normalized() + at_circle.normalized()).norm());
        last = at_circle;
      };
      points_after(at[k], [&](Index, double part) { look((1 - part) * a + part * b - circle.middle); });
      look(b - circle.middle);
    }
    return least;
  }

  std::span<const Index> parent_;
  std::span<const double> sides_;
  const std::function<bool()>& stop_;
  Corners c_;
  std::vector<Index> first_;  // points of the polygons, and the number of all
  std::vector<Polygons> states_;
};

}  // namespace

std::vector<Polygons> round_polygons(const Polygons& exact, const std::vector<std::vector<IsotopyPlace>>& places,
                                     std::span<const Index> parent, std::span<const double> sides,
                                     const std::function<bool()>& stop) {
  return Rounding(exact, places, parent, sides, stop).run();
}

}  // namespace unsnarl
