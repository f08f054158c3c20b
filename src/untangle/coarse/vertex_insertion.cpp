#include "untangle/coarse/vertex_insertion.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "untangle/coarse/coarse_level.h"

namespace unsnarl {
namespace {

using Removal = ProgressiveMesh::Removal;

/// Axes of a triangle: along its first side, across it, and its normal. Zero where it has no area.
Eigen::Matrix3d frame_of(const Positions& x, const Triangle& t) {
  const Vec3 side = x.col(t[1]) - x.col(t[0]), normal = area_vector(x, t);
  const double length = side.norm(), area = normal.norm();
  if (!(length > 0) || !(area > 0)) return Eigen::Matrix3d::Zero();
  Eigen::Matrix3d frame;
  frame.col(0) = side / length;
  frame.col(2) = normal / area;
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

/// The point of the fan where the removed vertex lay.
Vec3 point_on_fan(const Positions& x, const Removal& removal) {
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < 3; ++k) p += removal.weights[k] * x.col(removal.corners[k]);
  return p;
}

/// The place to which the triangle of the fan carries the vertex: its offset from the triangle turns with that.
Vec3 prolongated(const Removal& removal, double offset_share, const Positions& rest, const Positions& x) {
  const Vec3 offset = rest.col(removal.vertex) - point_on_fan(rest, removal);
  const Vec3 turned = frame_of(x, removal.corners) * (frame_of(rest, removal.corners).transpose() * offset);
  return point_on_fan(x, removal) + offset_share * turned;
}

/// A place to which a vertex that comes back may go.
struct Place {
  Vec3 position;
  int flipped = 0;  // faces of the star that would be turned against their rest normals
};

/// The places to be tried, the best first.
struct Places {
  std::vector<Place> list;
  /// The first `with_space` places leave the star room. If none is free, the vertex stays at one of them, since local
  /// strategies do not resolve what crosses a star that is hardly there.
  std::size_t with_space = 0;
};

/// Positions of a patch: at rest, at the beginning of the strategy, and now.
struct States {
  const Positions& rest;
  const Positions& start;
  const Positions& x;
};

// A vertex that comes back is tried at shares of the way from its parent to points of the fan: a half, and each
// `closer` times the last one, down to closest_share. [E55, E56]

/// Ratio of a share and the one tried before it (no unit)
constexpr double closer = 0.2;
/// Least share of the way that is tried (no unit)
constexpr double closest_share = 5e-4;
/// Share of the way: the new star has space down to this (no unit)
constexpr double least_space = 0.01;

/// The triangles around a vertex that comes back, as they are without it.
struct Fan {
  Vec3 parent, vertex, middle;     ///< the parent, where the vertex lay, and the mean of the sides' middles
  std::vector<Vec3> side_middles;  ///< of the sides that do not touch the parent
};

Fan fan_of(const Removal& removal, std::span<const Triangle> star, const Positions& x) {
  Fan fan{x.col(removal.parent), point_on_fan(x, removal), Vec3::Zero(), {}};
  for (const Triangle& t : star) {
    Vec3 side = Vec3::Zero();
    for (const Index v : t)
      if (v != removal.vertex) side += 0.5 * x.col(v);
    fan.middle += side / static_cast<double>(star.size());
    if (std::find(t.begin(), t.end(), removal.parent) == t.end()) fan.side_middles.push_back(side);
  }
  return fan;
}

/// Where the triangle of the fan carries the vertex, with its offset from there, half of it and none. A triangle that
/// has not moved carries it to where it was.
void add_carried_places(const Removal& removal, const States& states, std::vector<Place>& places) {
  const auto& [rest, start, x] = states;
  if (is_at(removal.corners, x, start))
    places.push_back({start.col(removal.vertex)});
  else if (is_at(removal.corners, x, rest))
    places.push_back({rest.col(removal.vertex)});
  else
    places.push_back({prolongated(removal, 1, rest, x)});
  for (const double share : {0.5, 0.0}) places.push_back({prolongated(removal, share, rest, x)});
}

/// Points of the fan closer and closer to the parent, and eight directions in which the vertex may leave the parent of
/// a folded fan; then (beyond `with_space`) points so close that the new star is hardly more than the fan, which is
/// embedded: one of them is mostly free between close layers.
void add_places_near_parent(const Fan& fan, Places& places) {
  const auto add = [&](const Vec3& p) { places.list.push_back({p}); };
  const auto add_towards = [&](const Vec3& p, double share) { add(fan.parent + share * (p - fan.parent)); };
  double share = 0.5, near = 0;
  for (; share > least_space; share *= closer) {
    add_towards(fan.vertex, share);
    add_towards(fan.middle, share);
    near = share * (fan.vertex - fan.parent).norm();
  }
  for (int corner = 0; corner < 8; ++corner)
    add(fan.parent + near * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
  places.with_space = places.list.size();
  for (; share > closest_share; share *= closer) {
    add_towards(fan.vertex, share);
    add_towards(fan.middle, share);
    for (const Vec3& middle : fan.side_middles) add_towards(middle, share);
  }
}

int count_flipped(const Removal& removal, std::span<const Triangle> star, const Vec3& position, const States& states) {
  int flipped = 0;
  for (const Triangle& t : star) {
    const auto at = [&](Index v) { return v == removal.vertex ? position : Vec3(states.x.col(v)); };
    const Vec3 a = at(t[0]), b = at(t[1]), c = at(t[2]);
    flipped += (b - a).cross(c - a).dot(area_vector(states.rest, t)) < 0;
  }
  return flipped;
}

/// The places of a vertex. Of those with space, and of the others, places that flip fewer faces of the star come first.
Places places_for(const Removal& removal, std::span<const Triangle> star, const States& states) {
  Places places;
  add_carried_places(removal, states, places.list);
  add_places_near_parent(fan_of(removal, star, states.x), places);
  for (Place& place : places.list) place.flipped = count_flipped(removal, star, place.position, states);
  const auto flips_fewer = [](const Place& p, const Place& q) { return p.flipped < q.flipped; };
  const auto close = places.list.begin() + static_cast<std::ptrdiff_t>(places.with_space);
  std::stable_sort(places.list.begin(), close, flips_fewer);
  std::stable_sort(close, places.list.end(), flips_fewer);
  return places;
}

/// Puts vertices back, each at the first of its places where its star is in no new pair.
class Insertion {
 public:
  /// `triangles`: the mesh with these vertices; `finder`: of its pairs that count; star_of: of each triangle the number
  /// of the vertex in whose star it is, or -1.
  Insertion(std::span<const Removal> removals, std::vector<Places> places, const std::vector<Triangle>& triangles,
            std::span<const Index> star_of, IntersectionFinder finder, const Positions& start)
      : removals_(removals),
        places_(std::move(places)),
        triangles_(triangles),
        star_of_(star_of),
        start_(start),
        finder_(std::move(finder)),
        searches_(removals.size()) {}

  void run(Positions& x) {
    std::vector<std::size_t> moving(searches_.size());
    std::iota(moving.begin(), moving.end(), std::size_t{0});
    find_places(moving, x);
    // Those that found none try again now that all others stay where they are.
    std::erase_if(moving, [&](std::size_t r) { return !searches_[r].failed; });
    if (!moving.empty()) find_places(moving, x);
    // The others have found their places now: some of the better ones may be free.
    for (const int place : {0, 2, 4}) offer(place, x);
  }

  /// Is this vertex elsewhere than at its best place?
  bool is_displaced(std::size_t r) const { return searches_[r].at > 0; }

 private:
  struct PlaceSearch {
    int at = 0, best = 0;
    std::size_t pairs = 0, fewest = std::numeric_limits<std::size_t>::max();
    bool failed = false;  // no place is free: it stays at the one with the fewest pairs, of those with space
  };

  void put(std::size_t r, int place, Positions& x) const {
    x.col(removals_[r].vertex) = places_[r].list[place].position;
  }

  /// Pairs of the stars. Those that were there at the start, where nothing has moved, do not count.
  void count_pairs(const Positions& x) {
    for (PlaceSearch& search : searches_) search.pairs = 0;
    for (const IntersectingPair& pair : finder_.find(x)) {
      if (is_at(triangles_[pair.a], x, start_) && is_at(triangles_[pair.b], x, start_)) continue;
      for (const Index face : {pair.a, pair.b})
        if (star_of_[face] >= 0) ++searches_[star_of_[face]].pairs;
    }
  }

  /// Each of these vertices goes to the first of its places where its star is in no new pair; the others stay.
  void find_places(std::span<const std::size_t> moving, Positions& x) {
    for (const std::size_t r : moving) {
      searches_[r] = {};
      put(r, 0, x);
    }
    while (advance(moving, x)) {
    }
  }

  /// Those of them with pairs go to their next places. False where there are none.
  bool advance(std::span<const std::size_t> moving, Positions& x) {
    count_pairs(x);
    bool any = false;
    for (const std::size_t r : moving) {
      PlaceSearch& search = searches_[r];
      if (search.failed) continue;
      if (static_cast<std::size_t>(search.at) < places_[r].with_space && search.pairs < search.fewest) {
        search.fewest = search.pairs;
        search.best = search.at;
      }
      if (search.pairs == 0) continue;
      any = true;
      search.failed = ++search.at == static_cast<int>(places_[r].list.size());
      if (search.failed) search.at = search.best;
      put(r, search.at, x);
    }
    return any;
  }

  /// Puts those that are at worse places at this one, and back where that brings pairs.
  void offer(int place, Positions& x) {
    std::vector<std::uint8_t> is_trying(searches_.size(), 0);
    for (std::size_t r = 0; r < searches_.size(); ++r) {
      if (searches_[r].at <= place) continue;
      is_trying[r] = 1;
      put(r, place, x);
    }
    for (bool any = true; any;) {
      any = false;
      count_pairs(x);
      for (std::size_t r = 0; r < searches_.size(); ++r) {
        if (!is_trying[r] || searches_[r].pairs == 0) continue;
        any = true;
        is_trying[r] = 0;
        put(r, searches_[r].at, x);
      }
    }
    for (std::size_t r = 0; r < searches_.size(); ++r)
      if (is_trying[r]) searches_[r].at = place, searches_[r].failed = false;
  }

  std::span<const Removal> removals_;
  std::vector<Places> places_;
  const std::vector<Triangle>& triangles_;
  std::span<const Index> star_of_;
  const Positions& start_;
  IntersectionFinder finder_;
  std::vector<PlaceSearch> searches_;
};

/// Finds the pairs of active triangles of a mesh; `triangles` and `parts`: those of the mesh.
IntersectionFinder finder_of(std::span<const Triangle> triangles, std::span<const Index> parts,
                             const ProgressiveMesh& mesh, const Patch& patch) {
  const Passing passing = parts.empty() ? Passing() : Passing({}, parts, *patch.parts);
  return {triangles, static_cast<Index>(mesh.count_below(patch.active_count)), passing};
}

}  // namespace

bool is_at(const Triangle& t, const Positions& x, const Positions& other) {
  return std::all_of(t.begin(), t.end(), [&](Index v) { return x.col(v) == other.col(v); });
}

std::vector<Removal> insert_vertices(const Patch& patch, const ProgressiveMesh& mesh,
                                     const std::vector<Removal>& removals, Positions& x) {
  std::vector<Index> star_of_face(patch.triangles.size(), -1), star_of;
  std::vector<Places> places;
  for (std::size_t r = 0; r < removals.size(); ++r) {
    std::vector<Triangle> star;
    for (const Index t : removals[r].star) {
      star_of_face[t] = static_cast<Index>(r);
      star.push_back(mesh[t]);
    }
    const Index v = removals[r].vertex;
    places.push_back(v < patch.free_count ? places_for(removals[r], star, {patch.rest, patch.x, x})
                                          : Places{{{patch.x.col(v)}}, 1});
  }
  for (const Index t : mesh.faces()) star_of.push_back(star_of_face[t]);
  const std::vector<Triangle> triangles = mesh.triangles();
  const std::vector<Index> parts = parts_of(mesh, patch);
  Insertion insertion(removals, std::move(places), triangles, star_of, finder_of(triangles, parts, mesh, patch),
                      patch.x);
  insertion.run(x);
  std::vector<Removal> displaced;
  for (std::size_t r = 0; r < removals.size(); ++r)
    if (insertion.is_displaced(r)) displaced.push_back(removals[r]);
  return displaced;
}

void offer_better_places(const Patch& patch, const ProgressiveMesh& mesh, const std::vector<Removal>& displaced,
                         Positions& x) {
  const std::vector<Triangle> triangles = mesh.triangles();
  std::vector<Index> number(patch.vertices.size(), -1);
  for (std::size_t r = 0; r < displaced.size(); ++r) number[displaced[r].vertex] = static_cast<Index>(r);
  const std::vector<Index> parts = parts_of(mesh, patch);
  IntersectionFinder finder = finder_of(triangles, parts, mesh, patch);
  for (const double share : {1.0, 0.5}) {
    const Positions before = x;
    std::vector<std::uint8_t> is_trying(displaced.size(), 1);
    for (const Removal& removal : displaced)
      x.col(removal.vertex) += share * (prolongated(removal, 1, patch.rest, before) - before.col(removal.vertex));
    for (bool any = true; any;) {
      any = false;
      for (const IntersectingPair& pair : finder.find(x))
        for (const Index face : {pair.a, pair.b})
          for (const Index v : triangles[face]) {
            if (number[v] < 0 || !is_trying[number[v]]) continue;
            any = true;
            is_trying[number[v]] = 0;
            x.col(v) = before.col(v);
          }
    }
  }
}

}  // namespace unsnarl
