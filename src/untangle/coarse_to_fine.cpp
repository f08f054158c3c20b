#include "untangle/coarse_to_fine.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contact/blocking_pairs.h"
#include "contact/intersection_finder.h"
#include "geometry/jitter.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"
#include "mesh/progressive_mesh.h"
#include "recover/recover_regions.h"
#include "scene/patch_progress.h"
#include "scene/trajectory.h"
#include "untangle/conflict_regions.h"
#include "untangle/far_parts.h"
#include "untangle/local_solver.h"
#include "untangle/shared_constants.h"
#include "untangle/vertex_insertion.h"

namespace unsnarl {
namespace {

/// Number of starts of the coarsest mesh, besides where it is: a handful of faces, which take milliseconds. With 10, as
/// many of twenty punctured surfaces are resolved.
constexpr int most_starts = 30;
/// Number of times that a coarse mesh of whole components is solved, from positions that differ at random by so much of
/// its edges, at most; the solution nearest to rest is carried to the fine one. Solutions scatter: a torus
/// that gets here went 9 times as far as needed with other local strategies. Fifteen meshes end 11 % nearer, with 396
/// instead of 558 flipped faces, in 1.24 of the time (docs/experiments.md).
constexpr int starts_of_whole = 3;      // solutions
constexpr double start_distance = 0.2;  // mean edge lengths
/// Share of all motion, without unit, of a part that is tried again from rest on the way back, at least. 21 deep and
/// warped meshes end 4 % closer with it; with 0.05 as close, with 0.2 3 % (docs/experiments.md).
constexpr double least_motion_share = 0.1;  // without unit
class CoarseToFine {
 public:
  /// Gives up on the way back where a mesh keeps more than `most_pairs`.
  CoarseToFine(const Patch& patch, const Task& task, const CoarseOptions& options, double most_pairs)
      : patch_(patch),
        task_(task),
        options_(options),
        most_pairs_(most_pairs),
        mesh_(patch.triangles, ranks_of(patch, task.tolerated)),
        x_(patch.x) {}

  /// Simplifies the patch until it has so many active faces, or as few as it can have. Returns how many it has.
  std::size_t coarsen(double faces) {
    while (static_cast<double>(active_faces()) > faces && !stopped())
      if (mesh_.coarsen(patch_.rest) == 0 && mesh_.coarsen(patch_.rest, CoarsenOptions::any_shape(border)) == 0) break;
    return active_faces();
  }

  /// Untangles and recovers the mesh as it is now. Returns how far it is from rest then; none: too many pairs are left.
  /// Adds to `iterations`.
  std::optional<double> solve(int& iterations) {
    Level level = make_level();
    SceneIndex index(level.scene);
    const std::vector<IntersectingPair> pairs = index.find_pairs();
    const std::vector<IntersectingPair> tolerated = tolerated_on(level, pairs);
    const double all = static_cast<double>(blocking_pairs(pairs, tolerated).size());
    const auto tell = [&](double pairs_now, double work_left) {
      if (!patch_.progress || !(all > 0)) return;
      const double before = static_cast<double>(patch_.progress->pairs_before);
      patch_.progress->pairs = static_cast<std::size_t>(before * std::clamp(pairs_now / all, 0.0, 1.0));
      note_done(0.5 * (1 - std::min(1.0, work_left / all)));
    };
    const Untangled untangled = task_.untangle(level.scene, index, tolerated, options_.on_coarse_mesh, tell);
    iterations += untangled.iterations;
    if (static_cast<double>(untangled.left.size()) > few_left * all) return std::nullopt;
    recover(level, index, {});
    take_over(level);
    return total_motion(level.scene);
  }

  /// The nearest to rest of several solutions. False: there is none.
  bool solve_from_several_starts(int& iterations) {
    const double edge = mean_edge_length(patch_.rest, mesh_.triangles());
    std::optional<double> least;
    Positions nearest;
    for (int start = 0; start < starts_of_whole && !stopped(); ++start) {
      begin_elsewhere(start, start > 0 ? start_distance * edge : 0);
      const std::optional<double> motion = solve(iterations);
      if (!motion || (least && *motion >= *least)) continue;
      least = motion;
      nearest = x_;
    }
    if (least) x_ = std::move(nearest);
    return least.has_value();
  }

  /// The first solution from starts farther and farther from where the mesh is. False: there is none.
  bool solve_from_farther_starts(int& iterations) {
    const double size = (patch_.rest.rowwise().maxCoeff() - patch_.rest.rowwise().minCoeff()).norm();
    for (int start = 1; start <= most_starts && !stopped(); ++start) {
      begin_elsewhere(start, size * start / most_starts);
      if (solve(iterations)) return true;
    }
    return false;
  }

  /// Puts all vertices back. False: what they bring cannot be resolved, or not in time.
  bool refine() {
    const double rounds = static_cast<double>(mesh_.round_count());
    while (mesh_.round_count() > 0) {
      if (stopped()) return false;
      const std::vector<ProgressiveMesh::Removal> displaced = insert_vertices(patch_, mesh_, mesh_.refine(), x_);
      note_done(1 - 0.5 * static_cast<double>(mesh_.round_count()) / rounds);
      if (mesh_.round_count() == 0) break;
      if (!make_room()) return false;
      offer_better_places(patch_, mesh_, displaced, x_);
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

  /// A vertex is collapsed only onto one of its rank or above. Vertices of the border are fixed corners of active
  /// faces. They keep its shape however coarse the mesh becomes: where they came back far from where it ran, it would
  /// cut through what has been untangled beside it. (Clasped fists, with one setting or another changed by a little: 1
  /// to 1.1 times as far, in 1.5 s; without, twice as far in 6 s, but for one draw.)
  enum Rank : std::uint8_t { free_vertex, obstacle, border };

  /// Those of tolerated pairs stay, so that their faces are the same on every level.
  static std::vector<std::uint8_t> ranks_of(const Patch& patch, std::span<const IntersectingPair> tolerated) {
    std::vector<std::uint8_t> ranks(patch.vertices.size(), obstacle);
    std::fill(ranks.begin(), ranks.begin() + patch.free_count, free_vertex);
    for (Index t = 0; t < patch.active_count; ++t)
      for (const Index v : patch.triangles[t])
        if (v >= patch.free_count) ranks[v] = border;
    for (const IntersectingPair& pair : tolerated)
      for (const Index t : {pair.a, pair.b})
        for (const Index v : patch.triangles[t]) ranks[v] = ProgressiveMesh::stays;
    return ranks;
  }

  bool stopped() const { return task_.stop && task_.stop(); }
  /// Puts the vertices to where the patch's are, the free ones at random up to so far from there.
  void begin_elsewhere(Index start, double distance) {
    x_ = patch_.x;
    for (Index v = 0; v < patch_.free_count; ++v)
      for (int k = 0; k < 3; ++k) x_(k, v) += distance * jitter(start * patch_.free_count + v, k);
  }
  /// The coarse mesh is the first half of the progress, the way back the other.
  void note_done(double share) const {
    if (patch_.progress) patch_.progress->done = std::max(patch_.progress->done.load(), share);
  }

  std::size_t active_faces() const { return mesh_.count_below(patch_.active_count); }

  Level make_level() const {
    Level level;
    std::vector<Triangle> triangles = mesh_.triangles();
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
    const auto number = [&](Index face) { return static_cast<Index>(mesh_.count_below(face)); };
    for (const IntersectingPair& pair : task_.tolerated) result.push_back({number(pair.a), number(pair.b), pair.kind});
    return sorted(std::move(result));
  }
  static std::vector<IntersectingPair> sorted(std::vector<IntersectingPair> pairs) {
    sort_unique(pairs);
    return pairs;
  }

  /// Recovers all that is not at rest, and some rings around it.
  void recover(Level& level, SceneIndex& index, const RecoverOptions& options) const {
    std::vector<Index> moved;
    for (Index v = 0; v < level.scene.vertex_count(); ++v)
      if (level.scene.x.col(v) != level.scene.rest.col(v)) moved.push_back(v);
    RecoverRegionsOptions recovery;
    recovery.recover = options;
    recovery.recover.unflip_rounds = 0;  // faces of a coarse mesh are not those of the surface
    recovery.min_gap = [](std::span<const Index>) { return 0.0; };
    recovery.stop = [this] { return stopped(); };
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
    const std::size_t faces = level.scene.triangles.size();
    const bool is_small = faces <= most_faces_of_small;
    bool is_clean = true;
    if (!blocking_pairs(pairs, tolerated).empty()) {
      const std::span<const Tier> tiers = is_small ? options_.on_small_mesh : options_.on_large_mesh;
      const Untangled untangled = task_.untangle(level.scene, index, tolerated, tiers, {});
      if (static_cast<double>(untangled.left.size()) > most_pairs_) return false;
      is_clean = untangled.left.empty();
    }
    RecoverOptions steps;
    steps.has_last_stage = false;
    recover(level, index, steps);
    if (is_clean && is_small && faces / 2 >= retried_at_) {
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
      if (stopped()) continue;
      if (!task_.untangle(retried.scene, index, tolerated, options_.on_small_mesh, {}).left.empty()) continue;
      recover(retried, index, steps);
      if (total_motion(retried.scene) < total_motion(level.scene)) level = std::move(retried);
    }
  }

  const Patch& patch_;
  const Task& task_;
  const CoarseOptions& options_;
  double most_pairs_;
  ProgressiveMesh mesh_;
  Positions x_;                 // of the patch's vertices; only those of the mesh as it is now mean anything
  std::size_t retried_at_ = 0;  // faces of the mesh on which far parts were last tried again
};

}  // namespace

CoarseResult solve_on_coarser_mesh(Patch& patch, const Task& task, const CoarseOptions& options) {
  CoarseResult result;
  const bool is_only_one = options.meshes == CoarseMeshes::one;
  IntersectionFinder finder(patch.triangles, patch.active_count);
  const auto count_pairs = [&](const Positions& x) {
    const std::size_t count = blocking_pairs(finder.find(x), task.tolerated).size();
    record(patch, x, {.pairs = count});
    return count;
  };
  Positions best;
  const std::size_t before = result.pairs_left = count_pairs(patch.x);
  if (before == 0 || !(patch.edge_length > 0)) return result;
  const double most_left = few_enough_to_keep * static_cast<double>(before);
  auto faces = static_cast<std::size_t>(patch.active_count);
  for (double wanted = static_cast<double>(faces); !(task.stop && task.stop());) {
    wanted /= options.factor * options.factor;
    CoarseToFine solver(patch, task, options, most_left);
    const std::size_t finer = std::exchange(faces, solver.coarsen(wanted));
    const bool is_coarsest = faces == finer;
    if (is_coarsest && (is_only_one || faces == static_cast<std::size_t>(patch.active_count))) break;
    bool is_solved = false;
    if (is_only_one)
      is_solved = solver.solve(result.iterations).has_value();
    else if (is_coarsest)
      is_solved = solver.solve_from_farther_starts(result.iterations);
    else
      is_solved = solver.solve_from_several_starts(result.iterations);
    if (is_solved && solver.refine()) {
      const std::size_t left = count_pairs(solver.positions());
      if (left < result.pairs_left) {
        result.pairs_left = left;
        best = solver.positions();
      }
    }
    if (static_cast<double>(result.pairs_left) <= most_left || is_coarsest || is_only_one) break;
  }
  if (result.pairs_left < before) patch.x = std::move(best);
  return result;
}

}  // namespace unsnarl
