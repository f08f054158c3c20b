#include "untangle/coarse_to_fine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <array>
#include <optional>
#include <iterator>
#include <utility>
#include <vector>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "mesh/progressive_mesh.h"
#include "recover/recover_regions.h"
#include "scene/trajectory.h"
#include "untangle/conflict_regions.h"
#include "untangle/ladder.h"
#include "untangle/local_solver.h"

namespace unsnarl {
namespace {

const bool debug = std::getenv("CTF_DEBUG") != nullptr;
double env(const char* name, double value) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : value;
}

/// Pairs of which nothing may move.
std::vector<IntersectingPair> fixed_pairs(const Scene& scene, const std::vector<IntersectingPair>& pairs) {
  const auto is_fixed = [&](Index t) {
    return std::all_of(scene.triangles[t].begin(), scene.triangles[t].end(), [&](Index v) { return scene.fixed[v]; });
  };
  std::vector<IntersectingPair> result;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(result),
               [&](const IntersectingPair& pair) { return is_fixed(pair.a) && is_fixed(pair.b); });
  return result;
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

Vec3 point_of(const Positions& x, const ProgressiveMesh::Removal& removal) {
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < 3; ++k) p += removal.weights[k] * x.col(removal.corners[k]);
  return p;
}

/// Where a vertex that comes back may go, the best place first: where the triangle of the fan that it lay on carries it,
/// with less and less of its offset from there; points of the fan closer and closer to the parent; and such points of
/// the other triangles of the fan. Close to the parent the new star is hardly more than the fan, which is embedded.
std::vector<Vec3> places_for(const ProgressiveMesh::Removal& removal, std::span<const Triangle> star,
                             const Positions& rest, const Positions& x, double grid) {
  constexpr std::array<double, 4> details = {1, 0.5, 0.25, 0};
  constexpr std::array<double, 4> shares = {0.5, 0.25, 0.125, 0.03};
  std::vector<Vec3> places;
  // Multiples of a small power of two: what does not touch there is hardly ever closer than that.
  const auto add = [&](const Vec3& p) { places.push_back((p / grid).array().round().matrix() * grid); };
  const auto corner_motion = [&](Index v) { return x.col(v) == rest.col(v); };
  const Vec3 on_fan = point_of(x, removal), parent = x.col(removal.parent);
  const Vec3 offset = rest.col(removal.vertex) - point_of(rest, removal);
  const Vec3 turned = frame_of(x, removal.corners) * (frame_of(rest, removal.corners).transpose() * offset);
  if (std::all_of(removal.corners.begin(), removal.corners.end(), corner_motion))
    places.push_back(rest.col(removal.vertex));
  else
    add(on_fan + details[0] * turned);
  for (std::size_t k = 1; k < details.size(); ++k) add(on_fan + details[k] * turned);
  std::vector<Vec3> middles;
  Vec3 middle = Vec3::Zero();
  for (const Triangle& t : star) {
    Vec3 m = Vec3::Zero();
    for (const Index v : t)
      if (v != removal.vertex) m += 0.5 * x.col(v);
    middle += m / static_cast<double>(star.size());
    if (std::find(t.begin(), t.end(), removal.parent) == t.end()) middles.push_back(m);
  }
  for (const double share : shares) {
    add(parent + share * (on_fan - parent));
    add(parent + share * (middle - parent));
  }
  for (const Vec3& m : middles)
    for (const double share : {0.125, 0.015}) add(parent + share * (m - parent));
  // Where the fan is folded up, the vertex has to leave its parent in some other direction.
  double room = std::numeric_limits<double>::infinity();
  for (const Triangle& t : star)
    for (const Index v : t)
      if (v != removal.vertex && v != removal.parent) room = std::min(room, (x.col(v) - parent).norm());
  if (!star.empty())
    for (const double share : {0.1, 0.005})
      for (int i = 0; i < 27; ++i)
        if (i != 13) add(parent + share * room * Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized());
  return places;
}
constexpr int near_parent = 4;  // number of the first place near the parent

class CoarseToFine {
 public:
  CoarseToFine(Patch& patch, std::span<const IntersectingPair> tolerated, const std::function<bool()>& stop, const CoarseToFineOptions& options)
      : patch_(patch), tolerated_(tolerated), stop_(stop), options_(options), x_(patch.x), mesh_(patch.triangles, stays(patch, tolerated)) {
    grid_ = std::exp2(std::floor(std::log2(patch.edge_length)) - 20);
  }

  std::size_t active_faces() const {
    const auto faces = mesh_.faces();
    return static_cast<std::size_t>(std::lower_bound(faces.begin(), faces.end(), patch_.active_count) - faces.begin());
  }

  /// False where it cannot be simplified to twice as many.
  bool coarsen_to(std::size_t faces) {
    while (active_faces() > faces && !stopped()) {
      const std::size_t before = active_faces();
      const Index removed = mesh_.coarsen(patch_.rest);
      if (debug) std::fprintf(stderr, "  coarsen %zu -> %zu (%d)\n", before, active_faces(), removed);
      if (removed == 0 || static_cast<double>(active_faces()) > 0.97 * static_cast<double>(before)) break;
    }
    return active_faces() <= 2 * faces;
  }

  /// A solution on a coarse mesh.
  struct Solution {
    std::size_t rounds = 0;  // of the progressive mesh
    Positions x;
    int iterations = 0;
    std::size_t pairs_left = 0;
    double motion = 0;  // mean over the area

    bool is_better_than(const Solution& other) const {
      return pairs_left != other.pairs_left ? pairs_left < other.pairs_left : motion < other.motion;
    }
  };

  Solution solve_coarsest() {
    const auto begin = std::clock();
    Level level = make_level();
    SceneIndex index(level.scene);
    const std::vector<IntersectingPair> pairs = index.find_pairs();
    const std::vector<IntersectingPair> fixed = tolerated_on(level.scene, pairs);
    LadderOptions ladder;
    ladder.stop = stop_;
    ladder.strategies = LadderOptions::Strategies::of_coarser_mesh;
    const LadderResult climbed = climb_ladder(level.scene, index, fixed, ladder);
    const auto middle = std::clock();
    RecoverRegionsOptions recovery;
    recovery.min_gap = [&](std::span<const Index>) { return env("CTF_GAP", options_.coarse_gap) * level.edge_length; };
    recovery.stop = stopper();
    Recorder nobody({}, level.scene.x);
    recover_regions(level.scene, index, merge_overlapping(climbed.moved, level.scene.vertex_count()), recovery, nobody);
    Solution solution;
    solution.rounds = mesh_.round_count();
    solution.x = x_;
    for (std::size_t k = 0; k < level.vertices.size(); ++k) solution.x.col(level.vertices[k]) = level.scene.x.col(k);
    for (const RegionReport& region : climbed.regions) solution.iterations += region.iterations;
    solution.pairs_left = climbed.left.size();
    double area = 0;
    for (const Triangle& t : level.scene.triangles) {
      const double a = triangle_area(level.scene.rest, t);
      area += a;
      for (const Index v : t) solution.motion += a / 3 * (level.scene.x.col(v) - level.scene.rest.col(v)).norm();
    }
    solution.motion /= area;
    if (debug)
      std::fprintf(stderr, "  coarsest: %zu faces %zu pairs -> %zu left, h %g, mean motion %g; %.2f + %.2f s\n", active_faces(),
                   pairs.size() - fixed.size(), climbed.left.size(), level.edge_length, solution.motion, double(middle-begin)/CLOCKS_PER_SEC, double(std::clock()-middle)/CLOCKS_PER_SEC);
    return solution;
  }

  /// Goes on from a solution.
  void take(Solution solution) {
    while (mesh_.round_count() > solution.rounds) mesh_.refine();
    x_ = std::move(solution.x);
  }

  void refine_all() {
    double next = options_.level_growth * static_cast<double>(active_faces());
    while (mesh_.round_count() > 0 && !stopped()) {
      refine_round();
      if (static_cast<double>(active_faces()) >= next && mesh_.round_count() > 0) {
        solve_level();
        offer_better_places();
        next = options_.level_growth * static_cast<double>(active_faces());
      }
    }
  }

  const Positions& x() const { return x_; }
  std::size_t inserted = 0, failed = 0, displaced = 0;

 private:
  struct Level {
    Scene scene;
    std::vector<Index> vertices;  // of the patch
    double edge_length = 0;
  };

  /// The fixed vertices, and those of tolerated pairs: their faces are then the same on every level.
  static std::vector<std::uint8_t> stays(const Patch& patch, std::span<const IntersectingPair> tolerated) {
    std::vector<std::uint8_t> result(patch.vertices.size(), 1);
    std::fill(result.begin(), result.begin() + patch.free_count, std::uint8_t{0});
    for (const IntersectingPair& pair : tolerated)
      for (const Index t : {pair.a, pair.b})
        for (const Index v : patch.triangles[t]) result[v] = 1;
    return result;
  }
  bool stopped() const { return stop_ && stop_(); }
  /// Of all pairs on a level those that are let be: that no motion parts, and the tolerated ones.
  std::vector<IntersectingPair> tolerated_on(const Scene& scene, const std::vector<IntersectingPair>& pairs) const {
    std::vector<IntersectingPair> result = fixed_pairs(scene, pairs);
    const std::span<const Index> faces = mesh_.faces();
    const auto number = [&](Index face) {
      return static_cast<Index>(std::lower_bound(faces.begin(), faces.end(), face) - faces.begin());
    };
    for (const IntersectingPair& pair : tolerated_) result.push_back({number(pair.a), number(pair.b), pair.kind});
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }
  std::function<bool()> stopper() const { return stop_ ? stop_ : [] { return false; }; }

  Level make_level() const {
    Level level;
    std::vector<Index> local(patch_.vertices.size(), -1);
    std::vector<Triangle> triangles;
    for (const Index t : mesh_.faces()) {
      triangles.push_back(mesh_[t]);
      for (const Index v : mesh_[t]) local[v] = 0;
    }
    for (Index v = 0; v < static_cast<Index>(local.size()); ++v)
      if (local[v] == 0) {
        local[v] = static_cast<Index>(level.vertices.size());
        level.vertices.push_back(v);
      }
    for (Triangle& t : triangles)
      for (Index& v : t) v = local[v];
    const std::size_t active = active_faces();
    Positions rest(3, static_cast<Index>(level.vertices.size())), x = rest;
    std::vector<std::uint8_t> fixed(level.vertices.size());
    for (std::size_t k = 0; k < level.vertices.size(); ++k) {
      rest.col(k) = patch_.rest.col(level.vertices[k]);
      x.col(k) = x_.col(level.vertices[k]);
      fixed[k] = level.vertices[k] >= patch_.free_count;
    }
    level.edge_length = mean_edge_length(rest, std::span(triangles).first(active));
    level.scene = make_scene(std::move(rest), std::move(triangles), std::move(fixed));
    level.scene.x = std::move(x);
    return level;
  }

  void take(const Level& level) {
    for (std::size_t k = 0; k < level.vertices.size(); ++k) x_.col(level.vertices[k]) = level.scene.x.col(k);
  }

  void solve_level() {
    Level level = make_level();
    SceneIndex index(level.scene);
    const std::vector<IntersectingPair> pairs = index.find_pairs();
    const std::vector<IntersectingPair> fixed = tolerated_on(level.scene, pairs);
    if (pairs.size() > fixed.size()) {
      LadderOptions ladder;
      ladder.stop = stop_;
      ladder.strategies = LadderOptions::Strategies::gentle;
      const LadderResult climbed = climb_ladder(level.scene, index, fixed, ladder);
      if (debug) std::fprintf(stderr, "  level: %zu pairs -> %zu\n", pairs.size() - fixed.size(), climbed.left.size());
    }
    std::vector<Index> moved;
    for (Index v = 0; v < level.scene.vertex_count(); ++v)
      if (level.scene.x.col(v) != level.scene.rest.col(v)) moved.push_back(v);
    std::size_t flips = 0;
    const auto count_flips = [&] {
      std::size_t n = 0;
      for (const Triangle& t : level.scene.triangles) n += area_vector(level.scene.x, t).dot(area_vector(level.scene.rest, t)) < 0;
      return n;
    };
    if (debug) flips = count_flips();
    RecoverRegionsOptions recovery;
    recovery.recover.activation = options_.level_activation;
    recovery.recover.stages = 1;
    recovery.recover.max_steps = static_cast<int>(env("CTF_STEPS", options_.level_steps));
    recovery.recover.first_steps = recovery.recover.max_steps / 2;
    recovery.min_gap = [&](std::span<const Index>) { return env("CTF_LGAP", 0.0) * level.edge_length; };
    recovery.stop = stopper();
    Recorder nobody({}, level.scene.x);
    const double gap = recover_regions(level.scene, index, {dilate(level.scene, moved, 2)}, recovery, nobody);
    if (debug) std::fprintf(stderr, "  level: %zu faces, gap %g h, flips %zu -> %zu\n", active_faces(), gap / level.edge_length, flips, count_flips());
    take(level);
  }

  /// The mesh as it is now, with the stars of some vertices told apart.
  struct Stars {
    std::vector<Triangle> triangles;
    std::vector<Index> star_of;  // of each triangle: the number of the removal whose vertex it has; or -1
  };

  Stars make_stars(std::span<const ProgressiveMesh::Removal> removals) const {
    Stars stars;
    std::vector<Index> number(patch_.triangles.size(), -1);
    for (std::size_t r = 0; r < removals.size(); ++r)
      for (const Index t : removals[r].star) number[t] = static_cast<Index>(r);
    for (const Index t : mesh_.faces()) {
      stars.triangles.push_back(mesh_[t]);
      stars.star_of.push_back(number[t]);
    }
    return stars;
  }

  /// Puts the vertices of the last round back.
  void refine_round() {
    const std::vector<ProgressiveMesh::Removal> removals = mesh_.refine();
    const Stars stars = make_stars(removals);
    std::vector<std::vector<Vec3>> places;
    for (const ProgressiveMesh::Removal& removal : removals) {
      std::vector<Triangle> star;
      for (const Index t : removal.star) star.push_back(mesh_[t]);
      places.push_back(places_for(removal, star, patch_.rest, x_, grid_));
    }
    struct Try {
      int at = 0, best = 0;
      std::size_t pairs = 0, fewest = std::numeric_limits<std::size_t>::max();
      bool failed = false;
    };
    std::vector<Try> tries(removals.size());
    IntersectionFinder finder(stars.triangles, static_cast<Index>(active_faces()));
    const auto count_pairs = [&] {
      for (Try& t : tries) t.pairs = 0;
      for (const IntersectingPair& pair : finder.find(x_))
        for (const Index face : {pair.a, pair.b})
          if (stars.star_of[face] >= 0) ++tries[stars.star_of[face]].pairs;
    };
    for (std::size_t r = 0; r < removals.size(); ++r) x_.col(removals[r].vertex) = places[r][0];
    for (bool any = true; any;) {
      any = false;
      count_pairs();
      for (std::size_t r = 0; r < removals.size(); ++r) {
        Try& t = tries[r];
        if (t.failed) continue;
        if (t.pairs < t.fewest) {
          t.fewest = t.pairs;
          t.best = t.at;
        }
        if (t.pairs == 0) continue;
        any = true;
        t.failed = ++t.at == static_cast<int>(places[r].size());
        if (t.failed) t.at = t.best;
        x_.col(removals[r].vertex) = places[r][t.at];
      }
    }
    std::size_t bad = 0, off = 0;
    for (const Try& t : tries) bad += t.failed, off += t.at >= near_parent;
    // Better places, now that the others have found theirs.
    for (const int place : {0, 1, 3, 4, 5, 6}) {
      std::vector<std::uint8_t> is_trying(tries.size(), 0);
      for (std::size_t r = 0; r < tries.size(); ++r) {
        if (tries[r].at <= place) continue;
        is_trying[r] = 1;
        x_.col(removals[r].vertex) = places[r][place];
      }
      for (bool any = true; any;) {
        any = false;
        count_pairs();
        for (std::size_t r = 0; r < tries.size(); ++r) {
          if (tries[r].pairs == 0 || !is_trying[r]) continue;
          any = true;
          is_trying[r] = 0;
          x_.col(removals[r].vertex) = places[r][tries[r].at];
        }
      }
      for (std::size_t r = 0; r < tries.size(); ++r)
        if (is_trying[r]) tries[r].at = place, tries[r].failed = false;
    }
    std::size_t bad2 = 0, off2 = 0;
    for (std::size_t r = 0; r < tries.size(); ++r) {
      bad2 += tries[r].failed, off2 += tries[r].at >= near_parent;
      if (tries[r].at > 0) squeezed_.push_back(removals[r]);
    }
    inserted += tries.size();
    failed += bad2;
    displaced += off2;
    if (debug)
      std::fprintf(stderr, "  refine to %zu: %zu inserted, %zu near parent, %zu failed; then %zu, %zu\n", active_faces(), tries.size(), off, bad, off2, bad2);
  }

  /// Offers the vertices that were not put where they belong better places, after the surroundings have recovered.
  void offer_better_places() {
    if (squeezed_.empty()) return;
    std::vector<Triangle> triangles;
    std::vector<Index> number(patch_.vertices.size(), -1);
    for (std::size_t r = 0; r < squeezed_.size(); ++r) number[squeezed_[r].vertex] = static_cast<Index>(r);
    for (const Index t : mesh_.faces()) triangles.push_back(mesh_[t]);
    IntersectionFinder finder(triangles, static_cast<Index>(active_faces()));
    std::size_t before = finder.find(x_).size(), improved = 0;
    for (const double share : {1.0, 0.5}) {
      Positions safe = x_;
      std::vector<std::uint8_t> is_trying(squeezed_.size(), 0);
      for (std::size_t r = 0; r < squeezed_.size(); ++r) {
        const Vec3 place = places_for(squeezed_[r], {}, patch_.rest, x_, grid_)[0];
        x_.col(squeezed_[r].vertex) += share * (place - x_.col(squeezed_[r].vertex));
        is_trying[r] = 1;
      }
      for (bool any = true; any;) {
        any = false;
        for (const IntersectingPair& pair : finder.find(x_))
          for (const Index face : {pair.a, pair.b})
            for (const Index v : triangles[face]) {
              if (number[v] < 0 || !is_trying[number[v]]) continue;
              any = true;
              is_trying[number[v]] = 0;
              x_.col(v) = safe.col(v);
            }
      }
      improved += static_cast<std::size_t>(std::count(is_trying.begin(), is_trying.end(), 1));
    }
    if (debug) std::fprintf(stderr, "  offered %zu, taken %zu; pairs %zu -> %zu\n", squeezed_.size(), improved, before, finder.find(x_).size());
    squeezed_.clear();
  }

  Patch& patch_;
  std::span<const IntersectingPair> tolerated_;
  const std::function<bool()>& stop_;
  const CoarseToFineOptions& options_;
  Positions x_;
  ProgressiveMesh mesh_;
  std::vector<ProgressiveMesh::Removal> squeezed_;  // since the last level: those not put where they belong
  double grid_ = 0;
};

}  // namespace

CoarseResult solve_on_coarser_mesh(Patch& patch, int depth, std::span<const IntersectingPair> tolerated,
                                   const std::function<bool()>& stop, const CoarseToFineOptions& options) {
  CoarseResult result;
  IntersectionFinder finder(patch.triangles, patch.active_count);
  const auto count = [&] {
    result.pairs_left = blocking_pairs(finder.find(patch.x), tolerated).size();
    record(patch, patch.x, {.pairs = result.pairs_left});
  };
  count();
  const double factor = env("CTF_FACTOR", std::max(options.least_factor, options.factor_per_depth * depth));
  if (debug) std::fprintf(stderr, "coarse to fine: depth %d, factor %g, %d faces, %zu pairs, %d obstacles, %zu tolerated\n", depth, factor, patch.active_count, result.pairs_left, (int)patch.triangles.size() - patch.active_count, tolerated.size());
  CoarseToFine solver(patch, tolerated, stop, options);
  std::optional<CoarseToFine::Solution> best;
  for (const double share : {1.0, env("CTF_SECOND", 1.6)}) {
    const double f = share * factor;
    const auto wanted = static_cast<std::size_t>(patch.active_count / (f * f));
    const std::size_t before = solver.active_faces();
    solver.coarsen_to(std::max(wanted, options.least_faces));
    if (2 * solver.active_faces() > static_cast<std::size_t>(patch.active_count) || solver.active_faces() > 0.8 * before) break;
    CoarseToFine::Solution solution = solver.solve_coarsest();
    if (!best || solution.is_better_than(*best)) best = std::move(solution);
  }
  if (best) {
    const auto begin = std::clock();
    result.iterations = best->iterations;
    solver.take(std::move(*best));
    solver.refine_all();
    if (debug) std::fprintf(stderr, "  refined in %.2f s\n", double(std::clock()-begin)/CLOCKS_PER_SEC);
    patch.x = solver.x();
    count();
    if (debug) std::fprintf(stderr, "coarse to fine: %zu pairs left; %zu inserted, %zu near parent, %zu failed\n", result.pairs_left, solver.inserted, solver.displaced, solver.failed);
  }
  result.clean = result.pairs_left == 0;
  return result;
}

}  // namespace unsnarl
