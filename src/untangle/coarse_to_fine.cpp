#include "untangle/coarse_to_fine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "contact/intersection_finder.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"
#include "mesh/progressive_mesh.h"
#include "recover/recover_regions.h"
#include "scene/patch_progress.h"
#include "scene/trajectory.h"
#include "untangle/conflict_regions.h"
#include "untangle/escalation.h"
#include "untangle/far_parts.h"
#include "untangle/local_solver.h"
#include "untangle/shared_constants.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

using Removal = ProgressiveMesh::Removal;

/// Length in h of the patch: positions of what comes back are rounded to about this. Other numbers were not tried.
constexpr double grid_share = 0x1p-20;
/// Number of starts of the coarsest mesh, besides where it is: a handful of faces, which take milliseconds. With 10, as
/// many of twenty punctured surfaces are resolved.
constexpr int most_starts = 30;
/// Share of all motion, without unit, of a part that is tried again from rest on the way back, at least. 21 deep and
/// warped meshes end 4 % closer with it; with 0.05 as close, with 0.2 3 % (docs/performance.md).
constexpr double least_motion_share = 0.1;
/// Faces of the meshes on which this is done, at most. On these meshes it takes 3 % of the time, with 8000 8 %, and
/// they end as close; twenty others take 2 and 9 %, and end 4 and 5 % closer.
constexpr double most_faces_to_retry = 4000;

bool is_at(const Triangle& t, const Positions& x, const Positions& other) {
  return std::all_of(t.begin(), t.end(), [&](Index v) { return x.col(v) == other.col(v); });
}

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
Vec3 carried(const Removal& removal, double offset_share, const Positions& rest, const Positions& x) {
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
  /// So many, the first, leave the star room: where none is free, the vertex stays at one of these, since what crosses
  /// a star that is hardly there is not resolved by local strategies.
  std::size_t roomy = 0;
};

/// Positions of a patch: at rest, at the beginning of the strategy, and now.
struct States {
  const Positions& rest;
  const Positions& start;
  const Positions& x;
};

/// The places of a vertex: where the triangle of the fan carries the vertex, with less and less of its
/// offset from there; points of the fan closer and closer to the parent; and directions in which it may leave the
/// parent where the fan is folded up. Places that flip fewer faces of the star come before others. Last come points of
/// the fan so close to the parent that the new star is hardly more than the fan, which is embedded: one of them is
/// mostly free where layers are near (other shares were not tried). `grid`: positions become multiples of it.
Places places_for(const Removal& removal, std::span<const Triangle> star, const States& states, double grid) {
  const auto& [rest, start, x] = states;
  Places result;
  std::vector<Place>& places = result.list;
  const auto add = [&](const Vec3& p) { places.push_back({(p / grid).array().round().matrix() * grid}); };
  if (is_at(removal.corners, x, start))
    places.push_back({start.col(removal.vertex)});
  else if (is_at(removal.corners, x, rest))
    places.push_back({rest.col(removal.vertex)});
  else
    add(carried(removal, 1, rest, x));
  for (const double share : {0.5, 0.25, 0.0}) add(carried(removal, share, rest, x));

  const Vec3 on_fan = point_on_fan(x, removal), parent = x.col(removal.parent);
  std::vector<Vec3> middles;  // of the sides of the fan
  Vec3 middle = Vec3::Zero();
  for (const Triangle& t : star) {
    Vec3 m = Vec3::Zero();
    for (const Index v : t)
      if (v != removal.vertex) m += 0.5 * x.col(v);
    middle += m / static_cast<double>(star.size());
    if (std::find(t.begin(), t.end(), removal.parent) == t.end()) middles.push_back(m);
  }
  for (const double share : {0.5, 0.25, 0.125, 0.03}) {
    add(parent + share * (on_fan - parent));
    add(parent + share * (middle - parent));
  }
  for (const Vec3& m : middles) add(parent + 0.1 * (m - parent));
  const double near = 0.02 * (on_fan - parent).norm();
  for (int corner = 0; corner < 8; ++corner)
    add(parent + near * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));

  result.roomy = places.size();
  for (const double share : {0.01, 0.003, 0.001}) {
    add(parent + share * (on_fan - parent));
    add(parent + share * (middle - parent));
    for (const Vec3& m : middles) add(parent + share * (m - parent));
  }

  for (Place& place : places)
    for (const Triangle& t : star) {
      const auto at = [&, &x = x](Index v) { return v == removal.vertex ? place.position : Vec3(x.col(v)); };
      const Vec3 a = at(t[0]), b = at(t[1]), c = at(t[2]);
      place.flipped += (b - a).cross(c - a).dot(area_vector(rest, t)) < 0;
    }
  const auto flips_fewer = [](const Place& p, const Place& q) { return p.flipped < q.flipped; };
  const auto close = places.begin() + static_cast<std::ptrdiff_t>(result.roomy);
  std::stable_sort(places.begin(), close, flips_fewer);
  std::stable_sort(close, places.end(), flips_fewer);
  return result;
}

/// Puts vertices back, each at the first of its places where its star is in no new pair.
class Insertion {
 public:
  /// `triangles`: the mesh with these vertices, the first `active_count` of which count; star_of: of each triangle the
  /// number of the vertex in whose star it is, or -1.
  Insertion(std::span<const Removal> removals, std::vector<Places> places, const std::vector<Triangle>& triangles,
            std::span<const Index> star_of, Index active_count, const Positions& start)
      : removals_(removals),
        places_(std::move(places)),
        triangles_(triangles),
        star_of_(star_of),
        start_(start),
        finder_(triangles, active_count),
        tries_(removals.size()) {}

  void run(Positions& x) {
    std::vector<std::size_t> moving(tries_.size());
    std::iota(moving.begin(), moving.end(), std::size_t{0});
    find_places(moving, x);
    // Those that found none try again now that all others stay where they are.
    std::erase_if(moving, [&](std::size_t r) { return !tries_[r].failed; });
    if (!moving.empty()) find_places(moving, x);
    // The others have found their places now: some of the better ones may be free.
    for (const int place : {0, 2, 4}) offer(place, x);
  }

  /// Is this vertex elsewhere than at its best place?
  bool is_displaced(std::size_t r) const { return tries_[r].at > 0; }

 private:
  struct Try {
    int at = 0, best = 0;
    std::size_t pairs = 0, fewest = std::numeric_limits<std::size_t>::max();
    bool failed = false;  // no place is free: it stays at the roomy one with the fewest pairs
  };

  void put(std::size_t r, int place, Positions& x) const {
    x.col(removals_[r].vertex) = places_[r].list[place].position;
  }

  /// Pairs of the stars. Those that were there at the start, where nothing has moved, do not count.
  void count_pairs(const Positions& x) {
    for (Try& t : tries_) t.pairs = 0;
    for (const IntersectingPair& pair : finder_.find(x)) {
      if (is_at(triangles_[pair.a], x, start_) && is_at(triangles_[pair.b], x, start_)) continue;
      for (const Index face : {pair.a, pair.b})
        if (star_of_[face] >= 0) ++tries_[star_of_[face]].pairs;
    }
  }

  /// Each of these vertices goes to the first of its places where its star is in no new pair; the others stay.
  void find_places(std::span<const std::size_t> moving, Positions& x) {
    for (const std::size_t r : moving) {
      tries_[r] = {};
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
      Try& t = tries_[r];
      if (t.failed) continue;
      if (static_cast<std::size_t>(t.at) < places_[r].roomy && t.pairs < t.fewest) {
        t.fewest = t.pairs;
        t.best = t.at;
      }
      if (t.pairs == 0) continue;
      any = true;
      t.failed = ++t.at == static_cast<int>(places_[r].list.size());
      if (t.failed) t.at = t.best;
      put(r, t.at, x);
    }
    return any;
  }

  /// Puts those that are at worse places at this one, and back where that brings pairs.
  void offer(int place, Positions& x) {
    std::vector<std::uint8_t> is_trying(tries_.size(), 0);
    for (std::size_t r = 0; r < tries_.size(); ++r) {
      if (tries_[r].at <= place) continue;
      is_trying[r] = 1;
      put(r, place, x);
    }
    for (bool any = true; any;) {
      any = false;
      count_pairs(x);
      for (std::size_t r = 0; r < tries_.size(); ++r) {
        if (!is_trying[r] || tries_[r].pairs == 0) continue;
        any = true;
        is_trying[r] = 0;
        put(r, tries_[r].at, x);
      }
    }
    for (std::size_t r = 0; r < tries_.size(); ++r)
      if (is_trying[r]) tries_[r].at = place, tries_[r].failed = false;
  }

  std::span<const Removal> removals_;
  std::vector<Places> places_;
  const std::vector<Triangle>& triangles_;
  std::span<const Index> star_of_;
  const Positions& start_;
  IntersectionFinder finder_;
  std::vector<Try> tries_;
};

class CoarseToFine {
 public:
  /// Gives up on the way back where a mesh keeps more than `most_pairs`.
  CoarseToFine(const Patch& patch, std::span<const IntersectingPair> tolerated, double most_pairs,
               const std::function<bool()>& stop)
      : patch_(patch),
        tolerated_(tolerated),
        stop_(stop),
        most_pairs_(most_pairs),
        mesh_(patch.triangles, ranks_of(patch, tolerated)),
        x_(patch.x),
        grid_(std::exp2(std::floor(std::log2(patch.edge_length * grid_share)))) {}

  /// Simplifies the patch until it has so many active faces, or as few as it can have. Returns how many it has.
  std::size_t coarsen(double faces) {
    while (static_cast<double>(active_faces()) > faces && !stopped())
      if (mesh_.coarsen(patch_.rest) == 0 && mesh_.coarsen(patch_.rest, CoarsenOptions::any_shape()) == 0) break;
    return active_faces();
  }

  /// Untangles and recovers the mesh as it is now. False: too many pairs are left. Adds to `iterations`.
  bool solve(int& iterations) {
    Level level = make_level();
    SceneIndex index(level.scene);
    const std::vector<IntersectingPair> pairs = index.find_pairs();
    const std::vector<IntersectingPair> tolerated = tolerated_on(level, pairs);
    const double all = static_cast<double>(blocking_pairs(pairs, tolerated).size());
    const auto tell = [&](const EscalationProgress& now) {
      if (!patch_.progress || !(all > 0)) return;
      const double before = static_cast<double>(patch_.progress->pairs_before);
      patch_.progress->pairs = static_cast<std::size_t>(before * std::clamp(now.pairs_now / all, 0.0, 1.0));
      note_done(0.5 * (1 - std::min(1.0, now.work_left / all)));
    };
    const EscalationResult untangled = untangle(level, index, tolerated, coarse_mesh_tiers(), tell);
    for (const RegionReport& region : untangled.regions) iterations += region.iterations;
    if (static_cast<double>(untangled.left.size()) > few_left * all) return false;
    recover(level, index, {});
    take_over(level);
    return true;
  }

  /// The same from other starts, farther and farther from where the mesh is.
  bool solve_from_elsewhere(int& iterations) {
    const double size = (patch_.rest.rowwise().maxCoeff() - patch_.rest.rowwise().minCoeff()).norm();
    for (int start = 1; start <= most_starts && !stopped(); ++start) {
      x_ = patch_.x;
      for (Index v = 0; v < patch_.free_count; ++v)
        for (int k = 0; k < 3; ++k)
          x_(k, v) += size * start / most_starts * jitter_of(start * patch_.free_count + v, k);
      if (solve(iterations)) return true;
    }
    return false;
  }

  /// Puts all vertices back. False: what they bring cannot be resolved.
  bool refine() {
    const double rounds = static_cast<double>(mesh_.round_count());
    while (mesh_.round_count() > 0) {
      refine_once();
      note_done(1 - 0.5 * static_cast<double>(mesh_.round_count()) / rounds);
      if (mesh_.round_count() == 0 || stopped()) continue;
      if (!make_room()) return false;
      offer_better_places();
    }
    return true;
  }

  /// The positions of the patch's vertices; those of vertices that are removed now mean nothing.
  const Positions& positions() const { return x_; }

 private:
  /// The mesh as it is now, as a scene of its own.
  struct Level {
    Scene scene;
    std::vector<Index> vertices;  // of the patch
  };

  /// Fixed vertices are collapsed onto each other only, and come back to where they are. Those of tolerated pairs stay,
  /// so that their faces are the same on every level.
  static std::vector<std::uint8_t> ranks_of(const Patch& patch, std::span<const IntersectingPair> tolerated) {
    std::vector<std::uint8_t> ranks(patch.vertices.size(), 1);
    std::fill(ranks.begin(), ranks.begin() + patch.free_count, std::uint8_t{0});
    for (const IntersectingPair& pair : tolerated)
      for (const Index t : {pair.a, pair.b})
        for (const Index v : patch.triangles[t]) ranks[v] = ProgressiveMesh::stays;
    return ranks;
  }

  bool stopped() const { return stop_ && stop_(); }
  /// The coarse mesh is the first half of the progress, the way back the other.
  void note_done(double share) const {
    if (patch_.progress) patch_.progress->done = std::max(patch_.progress->done.load(), share);
  }

  std::size_t active_faces() const {
    const std::span<const Index> faces = mesh_.faces();
    return static_cast<std::size_t>(std::lower_bound(faces.begin(), faces.end(), patch_.active_count) - faces.begin());
  }
  std::vector<Triangle> triangles() const {
    std::vector<Triangle> result;
    for (const Index t : mesh_.faces()) result.push_back(mesh_[t]);
    return result;
  }

  Level make_level() const {
    Level level;
    std::vector<Triangle> triangles = this->triangles();
    std::vector<Index> local(patch_.vertices.size(), -1);
    for (const Triangle& t : triangles)
      for (const Index v : t) local[v] = 0;
    for (Index v = 0; v < static_cast<Index>(local.size()); ++v)
      if (local[v] == 0) {
        local[v] = static_cast<Index>(level.vertices.size());
        level.vertices.push_back(v);
      }
    for (Triangle& t : triangles)
      for (Index& v : t) v = local[v];
    const auto n = static_cast<Index>(level.vertices.size());
    Positions rest(3, n), x(3, n);
    std::vector<std::uint8_t> fixed(level.vertices.size());
    for (Index k = 0; k < n; ++k) {
      const Index v = level.vertices[k];
      rest.col(k) = patch_.rest.col(v);
      x.col(k) = x_.col(v);
      fixed[k] = v >= patch_.free_count;
    }
    level.scene = make_scene(std::move(rest), std::move(triangles), std::move(fixed));
    level.scene.x = std::move(x);
    return level;
  }

  /// The pairs on a level that are not to be resolved: the tolerated ones, and where nothing may move.
  std::vector<IntersectingPair> tolerated_on(const Level& level, const std::vector<IntersectingPair>& pairs) const {
    const Scene& scene = level.scene;
    const auto is_fixed = [&](Index t) {
      return std::all_of(scene.triangles[t].begin(), scene.triangles[t].end(), [&](Index v) { return scene.fixed[v]; });
    };
    std::vector<IntersectingPair> result;
    std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(result),
                 [&](const IntersectingPair& pair) { return is_fixed(pair.a) && is_fixed(pair.b); });
    const std::span<const Index> faces = mesh_.faces();
    const auto number = [&](Index face) {
      return static_cast<Index>(std::lower_bound(faces.begin(), faces.end(), face) - faces.begin());
    };
    for (const IntersectingPair& pair : tolerated_) result.push_back({number(pair.a), number(pair.b), pair.kind});
    return sorted(std::move(result));
  }
  static std::vector<IntersectingPair> sorted(std::vector<IntersectingPair> pairs) {
    sort_unique(pairs);
    return pairs;
  }

  /// Untangles a level by the other strategies. This is where the escalation is entered anew.
  EscalationResult untangle(Level& level, SceneIndex& index, std::span<const IntersectingPair> tolerated,
                            std::span<const Tier> tiers,
                            const std::function<void(const EscalationProgress&)>& tell = {}) const {
    EscalationOptions escalation;
    escalation.stop = stop_;
    escalation.tiers = tiers;
    escalation.on_progress = tell;
    return escalate(level.scene, index, tolerated, escalation);
  }

  /// Recovers all that is not at rest, and some rings around it.
  void recover(Level& level, SceneIndex& index, const RecoverOptions& options) const {
    std::vector<Index> moved;
    for (Index v = 0; v < level.scene.vertex_count(); ++v)
      if (level.scene.x.col(v) != level.scene.rest.col(v)) moved.push_back(v);
    RecoverRegionsOptions recovery;
    recovery.recover = options;
    recovery.min_gap = [](std::span<const Index>) { return 0.0; };
    recovery.stop = stop_ ? stop_ : [] { return false; };
    Recorder nobody({}, level.scene.x);
    recover_regions(level.scene, index, {dilate(level.scene, moved, recovery_rings)}, recovery, nobody);
  }

  void take_over(const Level& level) {
    for (std::size_t k = 0; k < level.vertices.size(); ++k) x_.col(level.vertices[k]) = level.scene.x.col(k);
  }

  /// Resolves what the vertices that came back have brought, and recovers by a few steps, so that the next have room.
  /// False: more pairs are left than are worth going on with.
  bool make_room() {
    Level level = make_level();
    SceneIndex index(level.scene);
    const std::vector<IntersectingPair> pairs = index.find_pairs();
    std::vector<IntersectingPair> tolerated = tolerated_on(level, pairs);
    // Pairs that were not resolved on the coarsest mesh stay as they are.
    const auto is_unmoved = [&](Index t) { return is_at(mesh_[mesh_.faces()[t]], x_, patch_.x); };
    for (const IntersectingPair& pair : pairs)
      if (is_unmoved(pair.a) && is_unmoved(pair.b)) tolerated.push_back(pair);
    tolerated = sorted(std::move(tolerated));
    bool is_clean = true;
    if (pairs.size() > tolerated.size()) {
      const EscalationResult untangled = untangle(level, index, tolerated, local_tiers());
      if (static_cast<double>(untangled.left.size()) > most_pairs_) return false;
      is_clean = untangled.left.empty();
    }
    RecoverOptions steps;
    steps.last_activation = 0;
    steps.unflip_rounds = 0;
    recover(level, index, steps);
    const auto faces = static_cast<double>(level.scene.triangles.size());
    if (is_clean && faces <= most_faces_to_retry && faces / 2 >= retried_at_) {
      retried_at_ = faces;
      retry_far_parts(level, tolerated, steps);
    }
    take_over(level);
    return true;
  }

  /// Parts that are farther than an edge from rest are put back there, one after the other, and untangled from there,
  /// among what has made way for them since. What ends nearer to rest is kept.
  void retry_far_parts(Level& level, std::span<const IntersectingPair> tolerated, const RecoverOptions& steps) const {
    const double edge = mean_edge_length(level.scene.rest, level.scene.triangles);
    for (const std::vector<Index>& part : far_parts(level.scene, edge, least_motion_share)) {
      Level retried = level;
      for (const Index v : part) retried.scene.x.col(v) = retried.scene.rest.col(v);
      SceneIndex index(retried.scene);
      if (stopped() || !untangle(retried, index, tolerated, local_tiers()).left.empty()) continue;
      recover(retried, index, steps);
      if (total_motion(retried.scene) < total_motion(level.scene)) level = std::move(retried);
    }
  }

  /// Puts the vertices of the last round back.
  void refine_once() {
    const std::vector<Removal> removals = mesh_.refine();
    const std::vector<Triangle> triangles = this->triangles();
    std::vector<Index> star_of_face(patch_.triangles.size(), -1), star_of;
    std::vector<Places> places;
    for (std::size_t r = 0; r < removals.size(); ++r) {
      std::vector<Triangle> star;
      for (const Index t : removals[r].star) {
        star_of_face[t] = static_cast<Index>(r);
        star.push_back(mesh_[t]);
      }
      const Index v = removals[r].vertex;
      places.push_back(v < patch_.free_count ? places_for(removals[r], star, {patch_.rest, patch_.x, x_}, grid_)
                                             : Places{{{patch_.x.col(v)}}, 1});
    }
    for (const Index t : mesh_.faces()) star_of.push_back(star_of_face[t]);
    Insertion insertion(removals, std::move(places), triangles, star_of, static_cast<Index>(active_faces()), patch_.x);
    insertion.run(x_);
    for (std::size_t r = 0; r < removals.size(); ++r)
      if (insertion.is_displaced(r)) displaced_.push_back(removals[r]);
  }

  /// Vertices that were not put where their fans carry them go there, or half the way, now that there is room, where
  /// that brings no pair.
  void offer_better_places() {
    const std::vector<Triangle> triangles = this->triangles();
    std::vector<Index> number(patch_.vertices.size(), -1);
    for (std::size_t r = 0; r < displaced_.size(); ++r) number[displaced_[r].vertex] = static_cast<Index>(r);
    IntersectionFinder finder(triangles, static_cast<Index>(active_faces()));
    for (const double share : {1.0, 0.5}) {
      const Positions before = x_;
      std::vector<std::uint8_t> is_trying(displaced_.size(), 1);
      for (const Removal& removal : displaced_)
        x_.col(removal.vertex) += share * (carried(removal, 1, patch_.rest, before) - before.col(removal.vertex));
      for (bool any = true; any;) {
        any = false;
        for (const IntersectingPair& pair : finder.find(x_))
          for (const Index face : {pair.a, pair.b})
            for (const Index v : triangles[face]) {
              if (number[v] < 0 || !is_trying[number[v]]) continue;
              any = true;
              is_trying[number[v]] = 0;
              x_.col(v) = before.col(v);
            }
      }
    }
    displaced_.clear();
  }

  const Patch& patch_;
  std::span<const IntersectingPair> tolerated_;
  const std::function<bool()>& stop_;
  double most_pairs_;
  ProgressiveMesh mesh_;
  Positions x_;                     // of the patch's vertices; only those of the mesh as it is now mean anything
  double retried_at_ = 0;           // faces of the mesh on which far parts were last tried again
  std::vector<Removal> displaced_;  // since the last level: those that are not at their best places
  double grid_;
};

}  // namespace

CoarseResult solve_on_coarser_mesh(Patch& patch, double factor, std::span<const IntersectingPair> tolerated,
                                   const std::function<bool()>& stop, CoarseMeshes meshes) {
  CoarseResult result;
  IntersectionFinder finder(patch.triangles, patch.active_count);
  const auto count_pairs = [&](const Positions& x) {
    const std::size_t count = blocking_pairs(finder.find(x), tolerated).size();
    record(patch, x, {.pairs = count});
    return count;
  };
  Positions best;
  const std::size_t before = result.pairs_left = count_pairs(patch.x);
  if (before == 0 || !(patch.edge_length > 0)) return result;
  const double most_left = few_left * static_cast<double>(before);
  auto faces = static_cast<std::size_t>(patch.active_count);
  for (double wanted = static_cast<double>(faces); !(stop && stop());) {
    wanted /= factor * factor;
    CoarseToFine solver(patch, tolerated, few_enough_to_keep * static_cast<double>(before), stop);
    const std::size_t finer = std::exchange(faces, solver.coarsen(wanted));
    const bool is_coarsest = faces == finer;
    if (is_coarsest && (meshes == CoarseMeshes::one || faces == static_cast<std::size_t>(patch.active_count))) break;
    const bool is_solved =
        is_coarsest ? solver.solve_from_elsewhere(result.iterations) : solver.solve(result.iterations);
    if (is_solved && solver.refine()) {
      const std::size_t left = count_pairs(solver.positions());
      if (left < result.pairs_left) {
        result.pairs_left = left;
        best = solver.positions();
      }
    }
    if (static_cast<double>(result.pairs_left) <= most_left || is_coarsest || meshes == CoarseMeshes::one) break;
  }
  if (result.pairs_left < before) patch.x = std::move(best);
  return result;
}

}  // namespace unsnarl
