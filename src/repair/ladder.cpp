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

namespace unsnarl {
namespace {

/// One way to resolve a region: a local rung, which starts from where the surface is now, or a flow, from rest.
struct Rung {
  std::string_view name;
  int rings;               ///< edges from the intersecting faces to the border of the free vertices
  const LocalRung* local;  ///< or null
  const FlowRung* flow;    ///< or null
};

constexpr int whole_component = std::numeric_limits<int>::max();

constexpr LocalRung penalty = {LocalMethod::penalty, 0.1, 3, 30};
constexpr LocalRung contour = {LocalMethod::contour, 0.1, 2, 60};
constexpr LocalRung long_contour = {LocalMethod::contour, 0.3, 4, 60};
constexpr LocalRung smoothing = {LocalMethod::smoothing, 0.1, 3, 60};

/// The default configuration: gentle first.
std::vector<Rung> default_rungs() {
  const std::span<const FlowRung> flows = default_flow_rungs();
  auto flow_named = [&](std::string_view name) {
    return &*std::find_if(flows.begin(), flows.end(), [&](const FlowRung& rung) { return rung.name == name; });
  };
  std::vector<Rung> rungs = {
      {"penalty-2", 2, &penalty, nullptr},
      {"contour-2", 2, &contour, nullptr},
      {"contour-4", 4, &contour, nullptr},
      {"contour-8", 8, &long_contour, nullptr},
      {"smoothing-4", 4, &smoothing, nullptr},
      {"flow-8", 8, nullptr, flow_named("flow 1b")},
      {"flow-16", 16, nullptr, flow_named("flow 1b")},
  };
  for (const FlowRung& flow : flows)
    if (flow.line_search) rungs.push_back({flow.name, whole_component, nullptr, &flow});
  return rungs;
}

class Climb {
 public:
  Climb(Scene& scene, std::span<const IntersectingPair> ignored, const LadderOptions& options)
      : scene_(scene), ignored_(ignored), options_(options), finder_(scene.triangles), is_free_(scene.vertex_count(), 0) {}

  LadderResult run() {
    pairs_ = current_pairs();
    for (const Rung& rung : default_rungs()) {
      if (pairs_.empty() || stopped()) break;
      climb_one(rung);
      pairs_ = current_pairs();
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

  void climb_one(const Rung& rung) {
    std::vector<ConflictRegion> regions = conflict_regions(scene_, pairs_);
    SceneIndex index(scene_);
    region_of_core_.assign(scene_.vertex_count(), -1);
    for (std::size_t r = 0; r < regions.size(); ++r)
      for (Index v : regions[r].core) region_of_core_[v] = static_cast<Index>(r);
    std::vector<std::uint8_t> done(regions.size(), 0);
    for (std::size_t r = 0; r < regions.size(); ++r) {
      if (stopped()) return;
      if (done[r]) continue;
      ConflictRegion region = regions[r];
      done[r] = 1;
      // A region whose free vertices reach another's core takes it in.
      std::vector<Index> free = dilate(scene_, region.core, rung.rings);
      for (bool grown = true; grown;) {
        grown = false;
        for (Index v : free) {
          const Index other = region_of_core_[v];
          if (other < 0 || done[other]) continue;
          done[other] = 1;
          grown = true;
          region.core.insert(region.core.end(), regions[other].core.begin(), regions[other].core.end());
          region.pairs.insert(region.pairs.end(), regions[other].pairs.begin(), regions[other].pairs.end());
        }
        if (!grown) break;
        std::sort(region.core.begin(), region.core.end());
        std::sort(region.pairs.begin(), region.pairs.end());
        free = dilate(scene_, region.core, rung.rings);
      }
      attempt(region, free, rung, index);
    }
  }

  void attempt(const ConflictRegion& region, const std::vector<Index>& free, const Rung& rung, SceneIndex& index) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<Triangle> core_faces;
    for (const IntersectingPair& pair : region.pairs)
      for (Index t : {pair.a, pair.b}) core_faces.push_back(scene_.triangles[t]);
    const double h = mean_edge_length(scene_.rest, core_faces);
    double reach = 4 * h;
    for (int tries = 0; tries < 3; ++tries) {
      Patch patch = cut_patch(scene_, index, free, reach);
      patch.edge_length = h;
      const Positions start = patch.x;
      int iterations = 0;
      if (!solve(patch, rung, foreign_pairs(patch, region), iterations)) return;
      const double displacement = (patch.x - start).leftCols(patch.free_count).colwise().norm().maxCoeff();
      if (displacement > reach) {  // it may have met what the patch does not hold
        reach = 2 * displacement;
        continue;
      }
      paste_patch(patch, scene_, index);
      RegionReport report;
      report.rung = rung.name;
      report.faces = static_cast<std::size_t>(patch.active_count);
      report.pairs = region.pairs.size();
      report.iterations = iterations;
      report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      result_.regions.push_back(report);
      result_.moved.push_back(free);
      return;
    }
  }

  bool solve(Patch& patch, const Rung& rung, const std::vector<IntersectingPair>& foreign, int& iterations) const {
    if (rung.local) {
      const LocalResult result = solve_locally(patch, *rung.local, foreign, {}, options_.stop);
      iterations += result.iterations;
      if (result.clean) return true;
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
  std::vector<std::uint8_t> is_free_;
  std::vector<Index> region_of_core_;
  std::vector<IntersectingPair> pairs_;
  LadderResult result_;
};

}  // namespace

LadderResult climb_ladder(Scene& scene, std::span<const IntersectingPair> ignored, const LadderOptions& options) {
  return Climb(scene, ignored, options).run();
}

}  // namespace unsnarl
