#include "applications/isotopy/shrink_to_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "applications/isotopy/circles.h"
#include "applications/isotopy/corner_removal.h"
#include "applications/isotopy/general_position.h"
#include "geometry/portable_math.h"
#include "geometry/predicates.h"

namespace unsnarl {
namespace {

/// A curve that moves within a polygon shrinks to this part of the free space around its way; below half, nothing meets
/// (no unit)
constexpr double guest_size = 0.2;
/// Places in a triangle lie on a circle of this part of its incircle's radius (no unit)
constexpr double places_radius = 0.5;

double distance_of_segments(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  // They do not cross where this is called.
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)});
}

class Shrinking {
 public:
  Shrinking(const Polygons& polygons, std::span<const Index> parent, std::span<const double> sides,
            const std::function<bool()>& stop)
      : parent_(parent), sides_(sides), stop_(stop) {
    first_.push_back(0);
    for (const Points2& p : polygons) first_.push_back(first_.back() + static_cast<Index>(p.cols()));
    c_.x = joined_points(polygons);
    c_.is_corner.assign(first_.back(), 1);
    c_.is_kept.assign(first_.back(), 0);
    for (Index p = 0; p < count(); ++p) {
      const Index n = first_[p + 1] - first_[p];
      c_.count.push_back(n);
      for (Index k = 0; k < n; ++k) {
        c_.polygon.push_back(p);
        c_.before.push_back(first_[p] + (k + n - 1) % n);
        c_.after.push_back(first_[p] + (k + 1) % n);
      }
    }
  }

  TrianglesWay run() {
    add_ring();
    c_.x = in_general_position(c_, stop_);
    add_ring();
    while (!stop_()) {
      remove_all();
      const Index stuck = deepest_that_is_stuck();
      if (stuck < 0) break;
      gather_contents(stuck);
    }
    return std::move(made_);
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
  /// Ascending.
  std::vector<Index> corners_of(Index polygon) const {
    std::vector<Index> list;
    for (Index v = first_[polygon]; v < first_[polygon + 1]; ++v)
      if (c_.is_corner[v] != 0) list.push_back(v);
    return list;
  }

  /// The polygons as they are. Since the last ring they have moved, or corners of which no two are neighbours are gone.
  void add_ring() {
    Polygons ring;
    std::vector<std::vector<Index>> numbers;
    std::vector<std::vector<Rung>> rungs;
    for (Index p = 0; p < count(); ++p) {
      const std::vector<Index> corners = corners_of(p);
      Points2& points = ring.emplace_back(2, static_cast<Eigen::Index>(corners.size()));
      std::vector<Index>& list = numbers.emplace_back();
      for (std::size_t k = 0; k < corners.size(); ++k) {
        points.col(static_cast<Index>(k)) = c_.x.col(corners[k]);
        list.push_back(corners[k] - first_[p]);
      }
      if (!made_.corners.empty()) rungs.push_back(rungs_to_fewer(made_.corners.back()[p], list));
    }
    made_.stack.add(std::move(ring), std::move(rungs));
    made_.corners.push_back(std::move(numbers));
  }

  void remove(const CornerRemoval& removal) {
    const auto [before, corner, after] = removal;
    c_.is_corner[corner] = 0;
    c_.after[before] = after;
    c_.before[after] = before;
    --c_.count[c_.polygon[corner]];
  }

  void remove_all() {
    const std::vector<CornerRemoval> removals = remove_corners(c_, stop_);
    const std::vector<int> rounds = rounds_of(c_.x, removals, stop_);
    if (stop_()) return;
    const int last = rounds.empty() ? -1 : *std::max_element(rounds.begin(), rounds.end());
    std::vector<std::vector<CornerRemoval>> of_round(last + 1);
    for (std::size_t k = 0; k < removals.size(); ++k) of_round[rounds[k]].push_back(removals[k]);
    for (const std::vector<CornerRemoval>& round : of_round) {
      if (stop_()) return;
      for (const CornerRemoval& removal : round) remove(removal);
      add_ring();
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

  /// The curves in a polygon shrink and move, one after the other, to the triangle that is left of a triangulation.
  void gather_contents(Index host) {
    Corners all_free = c_;
    all_free.is_kept.assign(all_free.is_kept.size(), 0);
    const std::vector<CornerRemoval> ears = remove_ears(all_free, host, sides_[host], stop_);
    if (stop_()) return;
    std::vector<Index> left;
    const std::vector<Index> edges = corners_of(host);
    for (const Index v : edges)
      if (std::none_of(ears.begin(), ears.end(), [&](const CornerRemoval& e) { return e.corner == v; }))
        left.push_back(v);
    for (const Index v : left) c_.is_kept[v] = 1;
    const Incircle room = incircle_of(c_.x.col(left[0]), c_.x.col(left[1]), c_.x.col(left[2]));

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
      if (stop_()) return;
      std::vector<Vec2>& way = guests[g].way;
      const auto apart = [&](const Vec2& a, const Vec2& b) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t other = 0; other < guests.size(); ++other)
          if (other != g) least = std::min(least, distance_to_segment(standing[other], a, b));
        return least;
      };
      double best = -1, farthest = -1;
      std::size_t place = 0;
      for (std::size_t k = 0; k < guests.size(); ++k) {
        if (is_taken[k] != 0) continue;
        const Vec2 at = place_in(room, k, guests.size());
        // The farthest of the places that are as free is taken, so that the others stay reachable.
        const double d = apart(way.back(), at), far = (at - way.back()).norm();
        if (d > best || (d == best && far > farthest)) {
          best = d;
          farthest = far;
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
    add_ring();
    for (const Guest& guest : guests)
      for (std::size_t k = 0; k + 1 < guest.way.size(); ++k) {
        move_with_contents(guest.polygon, guest.way[k], 1, guest.way[k + 1] - guest.way[k]);
        add_ring();
      }
  }

  static Vec2 place_in(const Incircle& room, std::size_t k, std::size_t count) {
    if (count == 1) return room.middle;
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
    return room.middle + places_radius * room.radius * Vec2(portable::cos(angle), portable::sin(angle));
  }

  /// A triangle's way through the triangles of a triangulation, by the middles of the edges between them.
  Guest guest_of(Index polygon, const std::vector<CornerRemoval>& ears) const {
    Vec2 middle(0, 0);
    for (const Index v : corners_of(polygon)) middle += c_.x.col(v) / 3;
    Guest guest{polygon, 0, {middle}};
    for (const Index v : corners_of(polygon)) guest.reach = std::max(guest.reach, (c_.x.col(v) - middle).norm());
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

  std::span<const Index> parent_;
  std::span<const double> sides_;
  const std::function<bool()>& stop_;
  Corners c_;
  std::vector<Index> first_;  // points of the polygons, and the number of all
  TrianglesWay made_;
};

}  // namespace

TrianglesWay shrink_to_triangles(const Polygons& polygons, std::span<const Index> parent, std::span<const double> sides,
                                 const std::function<bool()>& stop) {
  return Shrinking(polygons, parent, sides, stop).run();
}

}  // namespace unsnarl
