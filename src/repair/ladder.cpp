#include "repair/ladder.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "repair/conflict_regions.h"
#include "repair/flow.h"
#include "repair/local_solver.h"
#include "repair/patch.h"
#include "repair/waves.h"

namespace unsnarl {
namespace {

/// One way to resolve a region: a local rung, which starts from where the surface is now, or a flow, from rest.
struct Rung {
  std::string_view name;
  int rings;               ///< edges from the intersecting faces to the border of the free vertices
  const LocalRung* local;  ///< or null
  const FlowRung* flow;    ///< or null
};

/// Obstacles are taken in this many h around a region; regions that move farther are tried again with more.
constexpr double first_reach = 4;

constexpr int whole_component = std::numeric_limits<int>::max();

constexpr LocalRung shallow = {LocalMethod::shallow, 0.1, 1, 20};
constexpr LocalRung penalty = {LocalMethod::penalty, 0.1, 3, 30};
constexpr LocalRung contour = {LocalMethod::contour, 0.1, 2, 60};
constexpr LocalRung long_contour = {LocalMethod::contour, 0.3, 4, 60};
constexpr LocalRung smoothing = {LocalMethod::smoothing, 0.1, 3, 60};
constexpr LocalRung wide_smoothing = {LocalMethod::smoothing, 0.1, 5, 100};

/// The default configuration: gentle first.
std::vector<Rung> default_rungs() {
  const std::span<const FlowRung> flows = default_flow_rungs();
  auto flow_named = [&](std::string_view name) {
    return &*std::find_if(flows.begin(), flows.end(), [&](const FlowRung& rung) { return rung.name == name; });
  };
  std::vector<Rung> rungs = {
      {"shallow-0", 0, &shallow, nullptr},
      {"penalty-2", 2, &penalty, nullptr},
      {"contour-2", 2, &contour, nullptr},
      {"contour-4", 4, &contour, nullptr},
      {"contour-8", 8, &long_contour, nullptr},
      {"smoothing-4", 4, &smoothing, nullptr},
      {"flow-8", 8, nullptr, flow_named("flow 1b")},
      {"smoothing-8", 8, &wide_smoothing, nullptr},
      {"flow-16", 16, nullptr, flow_named("flow 1b")},
  };
  for (const FlowRung& flow : flows)
    if (flow.line_search) rungs.push_back({flow.name, whole_component, nullptr, &flow});
  return rungs;
}

class Climb {
 public:
  Climb(Scene& scene, std::span<const IntersectingPair> ignored, const LadderOptions& options)
      : scene_(scene), ignored_(ignored), options_(options), finder_(scene.triangles) {}

  LadderResult run() {
    pairs_ = current_pairs();
    for (const Rung& rung : default_rungs()) {
      if (pairs_.empty() || stopped()) break;
      climb_one(rung);
      pairs_ = current_pairs();
    }
    for (const ConflictRegion& region : conflict_regions(scene_, pairs_)) {
      RegionReport unresolved;
      unresolved.rung = "none";
      unresolved.pairs = region.pairs.size();
      result_.regions.push_back(unresolved);
    }
    result_.left = pairs_;
    return std::move(result_);
  }

 private:
  bool stopped() const { return options_.stop && options_.stop(); }

  std::vector<IntersectingPair> current_pairs() {
    auto pairs = blocking_pairs(finder_.find(scene_.x), ignored_);
    if (options_.on_progress) options_.on_progress(pairs.size());
    return pairs;
  }

  /// A region about to be tried on a rung.
  struct Attempt {
    ConflictRegion region;
    std::vector<Index> free;
    double edge_length = 0;
    double reach = 0;  // how far around the patch obstacles are taken in
    Patch patch;
    Positions start;
    int iterations = 0;
    double seconds = 0;
    bool clean = false;
  };

  void climb_one(const Rung& rung) {
    std::vector<Attempt> attempts = gather_attempts(rung);
    SceneIndex index(scene_);
    // A second round for those that moved farther than their obstacles reach.
    for (int round = 0; round < 3 && !attempts.empty() && !stopped(); ++round) {
      std::vector<Box> boxes;
      for (const Attempt& attempt : attempts) boxes.push_back(patch_box(scene_, attempt.free, 2 * attempt.reach));
      std::vector<Attempt> again;
      run_in_waves(
          boxes, [&](std::size_t i) { run(attempts[i], rung, index); },
          [&](std::size_t i) {
            Attempt& attempt = attempts[i];
            if (!attempt.clean) return;
            const double moved =
                (attempt.patch.x - attempt.start).leftCols(attempt.patch.free_count).colwise().norm().maxCoeff();
            if (moved > attempt.reach) {
              attempt.reach = 2 * moved;
              again.push_back(std::move(attempt));
              return;
            }
            paste_patch(attempt.patch, scene_, index);
            report(attempt, rung);
          });
      attempts = std::move(again);
    }
  }

  /// The regions there are now, each with its free vertices; one whose free vertices reach another's core takes it in.
  std::vector<Attempt> gather_attempts(const Rung& rung) const {
    const std::vector<ConflictRegion> regions = conflict_regions(scene_, pairs_);
    std::vector<Index> region_of_core(scene_.vertex_count(), -1);
    for (std::size_t r = 0; r < regions.size(); ++r)
      for (Index v : regions[r].core) region_of_core[v] = static_cast<Index>(r);
    std::vector<std::uint8_t> taken(regions.size(), 0);
    std::vector<Attempt> attempts;
    for (std::size_t r = 0; r < regions.size(); ++r) {
      if (taken[r]) continue;
      taken[r] = 1;
      Attempt attempt;
      ConflictRegion& region = attempt.region = regions[r];
      for (bool grown = true; grown;) {
        grown = false;
        attempt.free = dilate(scene_, region.core, rung.rings);
        for (Index v : attempt.free) {
          const Index other = region_of_core[v];
          if (other < 0 || taken[other]) continue;
          taken[other] = 1;
          grown = true;
          region.core.insert(region.core.end(), regions[other].core.begin(), regions[other].core.end());
          region.pairs.insert(region.pairs.end(), regions[other].pairs.begin(), regions[other].pairs.end());
        }
        std::sort(region.core.begin(), region.core.end());
        std::sort(region.pairs.begin(), region.pairs.end());
      }
      std::vector<Triangle> core_faces;
      for (const IntersectingPair& pair : region.pairs)
        for (Index t : {pair.a, pair.b}) core_faces.push_back(scene_.triangles[t]);
      attempt.edge_length = mean_equilateral_side(scene_.rest, core_faces);
      attempt.reach = first_reach * attempt.edge_length;
      attempts.push_back(std::move(attempt));
    }
    return attempts;
  }

  void run(Attempt& attempt, const Rung& rung, const SceneIndex& index) const {
    if (stopped()) return;
    const auto begin = std::chrono::steady_clock::now();
    attempt.patch = cut_patch(scene_, index, attempt.free, attempt.reach);
    attempt.patch.edge_length = attempt.edge_length;
    attempt.start = attempt.patch.x;
    attempt.clean = solve(attempt.patch, rung, foreign_pairs(attempt.patch, attempt.region), attempt.iterations);
    attempt.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  void report(Attempt& attempt, const Rung& rung) {
    RegionReport report;
    report.rung = rung.name;
    report.faces = static_cast<std::size_t>(attempt.patch.active_count);
    report.pairs = attempt.region.pairs.size();
    report.iterations = attempt.iterations;
    report.seconds = attempt.seconds;
    result_.regions.push_back(report);
    result_.moved.push_back(std::move(attempt.free));
  }

  bool solve(Patch& patch, const Rung& rung, const std::vector<IntersectingPair>& foreign, int& iterations) const {
    if (rung.local) {
      // Pockets that are inside out have to turn, and what surrounds them may have to: then nothing is kept.
      for (const bool keep_sides : {true, false}) {
        LocalOptions local;
        local.keep_sides = keep_sides;
        const LocalResult result = solve_locally(patch, *rung.local, foreign, local, options_.stop);
        iterations += result.iterations;
        if (result.clean) return true;
      }
    }
    if (rung.flow) {
      const FlowResult result = flow(patch, *rung.flow, options_.stop, foreign);
      iterations += result.iterations;
      if (result.clean) return true;
    }
    return false;
  }

  /// Pairs of active triangles that are not the region's: other regions' and those that cannot be resolved.
  std::vector<IntersectingPair> foreign_pairs(const Patch& patch, const ConflictRegion& region) const {
    std::vector<IntersectingPair> foreign;
    IntersectionFinder finder(patch.triangles, patch.active_count);
    for (const IntersectingPair& pair : finder.find(patch.x)) {
      const auto [a, b] = std::minmax(patch.faces[pair.a], patch.faces[pair.b]);
      if (!std::binary_search(region.pairs.begin(), region.pairs.end(), IntersectingPair{a, b, pair.kind}))
        foreign.push_back(pair);
    }
    return foreign;
  }

  Scene& scene_;
  std::span<const IntersectingPair> ignored_;
  const LadderOptions& options_;
  IntersectionFinder finder_;
  std::vector<IntersectingPair> pairs_;
  LadderResult result_;
};

}  // namespace

LadderResult climb_ladder(Scene& scene, std::span<const IntersectingPair> ignored, const LadderOptions& options) {
  return Climb(scene, ignored, options).run();
}

}  // namespace unsnarl
