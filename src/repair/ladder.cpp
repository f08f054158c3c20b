#include "repair/ladder.h"

#include <algorithm>
#include <chrono>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "repair/conflict_regions.h"
#include "repair/local_solver.h"
#include "repair/patch.h"

namespace unsnarl {
namespace {

/// The default configuration: gentle first. Names: method, rings.
constexpr LocalRung local_rungs[] = {
    {"penalty-2", LocalMethod::penalty, 2, 0.1, 3, 30},
    {"contour-2", LocalMethod::contour, 2, 0.1, 2, 40},
    {"contour-4", LocalMethod::contour, 4, 0.1, 2, 60},
    {"contour-8", LocalMethod::contour, 8, 0.3, 4, 60},
    {"smoothing-4", LocalMethod::smoothing, 4, 0.1, 3, 60},
};

class Climb {
 public:
  Climb(Scene& scene, std::span<const IntersectingPair> ignored, const LadderOptions& options)
      : scene_(scene), ignored_(ignored), options_(options), finder_(scene.triangles), is_free_(scene.vertex_count(), 0) {}

  LadderResult run() {
    pairs_ = current_pairs();
    for (const LocalRung& rung : local_rungs) {
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

  void climb_one(const LocalRung& rung) {
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

  void attempt(const ConflictRegion& region, const std::vector<Index>& free, const LocalRung& rung, SceneIndex& index) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<Triangle> core_faces;
    for (const IntersectingPair& pair : region.pairs)
      for (Index t : {pair.a, pair.b}) core_faces.push_back(scene_.triangles[t]);
    const double h = mean_edge_length(scene_.rest, core_faces);
    double reach = (rung.step * 8 + 1) * h;
    for (int tries = 0; tries < 3; ++tries) {
      Patch patch = cut_patch(scene_, index, free, reach);
      patch.edge_length = h;
      const LocalResult local = solve_locally(patch, rung, foreign_pairs(patch, region), {}, options_.stop);
      if (!local.clean) return;
      if (local.displacement > reach) {
        reach = 2 * local.displacement;
        continue;
      }
      paste_patch(patch, scene_, index);
      RegionReport report;
      report.rung = rung.name;
      report.faces = static_cast<std::size_t>(patch.active_count);
      report.pairs = region.pairs.size();
      report.iterations = local.iterations;
      report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      result_.regions.push_back(report);
      result_.moved.push_back(free);
      return;
    }
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
