#include "pipeline/gap_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "contact/sheet_gaps.h"
#include "contact/stop_check.h"
#include "geometry/parallel.h"
#include "mesh/areas.h"
#include "mesh/edge_ways.h"
#include "mesh/union_find.h"
#include "pipeline/region_work.h"
#include "recover/recover_regions.h"
#include "unsnarl/clearance.h"
#include "untangle/conflict_regions.h"

namespace unsnarl {
namespace {

/// Rounds of opening what is too small, at most: in each, a vertex goes a few edge lengths at most [E226] (unit:
/// rounds)
constexpr int gap_rounds = 6;
/// Vertices this far along the edges from a gap that is opened make way too [E211] (unit: wanted gap)
constexpr double way_gaps = 2;
/// Obstacles of a recovery are listed up to this distance [E227] (unit: wanted gap)
constexpr double obstacle_gaps = 2;
/// Gaps are looked for up to this distance where the smallest is to be named (fixed by GapReport)
constexpr double named_gaps = 2;
/// Share of the progress reported when gaps are open (no unit)
constexpr double opened_fraction = 0.97;
/// A round that neither leaves fewer gaps too small nor widens the smallest by this share is the last one (no unit)
constexpr double least_widening = 0.01;

SheetGaps sheet_gaps(const RepairTask& task, const RepairState& state, std::span<const IntersectingPair> left,
                     std::function<bool()> stop) {
  SheetGaps::Options options;
  options.wanted = gap_wanted_everywhere(task);
  options.stop = std::move(stop);
  const std::span<const Triangle> triangles = task.prepared.triangles();
  options.counts = [&state, triangles, left, passing = task.prepared.passing()](Index s, Index t) {
    if (!passing.meet(triangles, s, t)) return false;
    const auto reason = state.policy.reason_to_leave(triangles[s], triangles[t], PairClass::disjoint);
    if (reason && *reason != LeftReason::fixed_faces && *reason != LeftReason::rigid_faces) return false;
    const auto before = [](const IntersectingPair& p, const std::array<Index, 2>& q) {
      return std::array{p.a, p.b} < q;
    };
    const std::array<Index, 2> pair = {std::min(s, t), std::max(s, t)};
    const auto at = std::lower_bound(left.begin(), left.end(), pair, before);
    return at == left.end() || std::array{at->a, at->b} != pair;
  };
  return {triangles, state.scene.rest, std::move(options)};
}

/// The vertices that make way for gaps to be opened: one set for each group of sheets that face each other.
std::vector<std::vector<Index>> sets_around(const RepairTask& task, const Scene& scene,
                                            std::span<const SheetGap> gaps) {
  const std::span<const Triangle> triangles = task.prepared.triangles();
  UnionFind groups(static_cast<std::size_t>(scene.vertex_count()));
  std::vector<std::uint8_t> is_at_gap(static_cast<std::size_t>(scene.vertex_count()), 0);
  for (const SheetGap& gap : gaps)
    for (const Index t : {gap.first, gap.second})
      for (const Index v : triangles[t]) {
        groups.unite(triangles[gap.first][0], v);
        is_at_gap[v] = 1;
      }
  std::map<Index, std::vector<Index>> at_gaps;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (is_at_gap[v]) at_gaps[groups.find(v)].push_back(v);
  EdgeWays ways(scene.rest, scene.neighbours);
  std::vector<std::vector<Index>> sets;
  for (const auto& [group, vertices] : at_gaps) {
    ways.start(vertices);
    std::vector<Index> set = dilate(scene, ways.within(way_gaps * gap_wanted_everywhere(task)), recovery_rings);
    if (!set.empty()) sets.push_back(std::move(set));
  }
  return merge_overlapping(std::move(sets), scene.vertex_count());
}

/// Puts sets with a vertex that went farther than allowed back to where they were.
void take_back_what_is_too_far(const RepairTask& task, std::span<const std::vector<Index>> sets,
                               const Positions& before, Scene& scene) {
  const double limit = task.most_motion();
  if (!(limit > 0)) return;
  for (const std::vector<Index>& set : sets) {
    if (are_within(scene.x, scene.rest, set, limit)) continue;
    for (const Index v : set) scene.x.col(v) = before.col(v);
  }
}

/// The properties of the written positions that must not get worse while gaps are opened: pairs and lost areas.
class Kept {
 public:
  Kept(const RepairTask& task, const RepairState& state)
      : task_(task),
        finders_(make_finders(task, state)),
        pairs_(finders_.as_is.find(state.scene.x)),
        rounded_(state.format.float32() ? finders_.find_rounded(state.scene.x) : pairs_),
        lost_areas_(lost_areas(state)) {}

  std::span<const IntersectingPair> pairs() const { return pairs_; }
  bool holds(const RepairState& state) {
    if (lost_areas(state) > lost_areas_ || !are_among(finders_.as_is.find(state.scene.x), pairs_)) return false;
    return !state.format.float32() || are_among(finders_.find_rounded(state.scene.x), rounded_);
  }

 private:
  std::size_t lost_areas(const RepairState& state) const {
    return static_cast<std::size_t>(count_lost_areas(state.scene.rest, state.scene.x, task_.prepared.triangles()));
  }
  static bool are_among(const std::vector<IntersectingPair>& pairs, const std::vector<IntersectingPair>& of) {
    return std::includes(of.begin(), of.end(), pairs.begin(), pairs.end());
  }

  const RepairTask& task_;
  Finders finders_;
  std::vector<IntersectingPair> pairs_, rounded_;
  std::size_t lost_areas_;
};

void open_sets(const RepairTask& task, const RepairControl& control, const std::vector<std::vector<Index>>& sets,
               RepairState& state) {
  RecoverRegionsOptions options;
  options.recover.knows_sheets = true;
  options.least_reach = obstacle_gaps * gap_wanted_everywhere(task);
  options.min_gap = [&](std::span<const Index> vertices) { return state.format.wanted_gap(state.scene, vertices); };
  options.stop = control.limits.stopper();
  SceneIndex index(state.scene);
  const Positions before = state.scene.x;
  state.smallest_gap = std::min(state.smallest_gap, recover_regions(state.scene, index, sets, options, state.recorder));
  take_back_what_is_too_far(task, sets, before, state.scene);
}

/// Rounds to the digits of the result, to more of them where those of float32 are too few. Returns whether all holds
/// that must.
bool round_gaps(Kept& kept, RepairState& state) {
  const Positions solved = state.scene.x;
  state.scene.x = state.format.as_written(solved);
  if (kept.holds(state)) return true;
  if (!state.format.may_give_up_float32()) return false;
  state.format.give_up_float32();
  state.scene.x = state.format.as_written(solved);
  return kept.holds(state);
}

double smallest_of(std::span<const SheetGap> gaps) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const SheetGap& gap : gaps) smallest = std::min(smallest, gap.distance);
  return smallest;
}

/// `narrow`: gaps that are too small now, `at_first`: when the first round began.
void report_progress(const RepairTask& task, const RepairControl& control, const RepairState& state,
                     std::size_t pairs_left, std::size_t narrow, std::size_t at_first) {
  const double done = 1 - std::min(1.0, static_cast<double>(narrow) / static_cast<double>(at_first));
  control.phases.report(opened_fraction * done, pairs_left, state.scene.x, task.prepared.rest, task.diagonal);
}

/// Opens these gaps, round by round, while that gets on.
void open_all(const RepairTask& task, const RepairControl& control, std::vector<SheetGap> gaps, RepairState& state) {
  const double wanted = gap_wanted_everywhere(task);
  Kept kept(task, state);
  const SheetGaps sheets = sheet_gaps(task, state, kept.pairs(), control.limits.stopper());
  if (!kept.pairs().empty()) gaps = sheets.narrow(state.scene.x, wanted);
  const std::size_t at_first = gaps.size();
  for (int round = 0; round < gap_rounds && !gaps.empty() && !control.limits.reached(); ++round) {
    report_progress(task, control, state, kept.pairs().size(), gaps.size(), at_first);
    const std::vector<std::vector<Index>> sets = sets_around(task, state.scene, gaps);
    if (sets.empty()) return;
    const RepairState::Checkpoint before = state.checkpoint();
    open_sets(task, control, sets, state);
    bool gets_on = round_gaps(kept, state);
    if (gets_on) {
      std::vector<SheetGap> now = sheets.narrow(state.scene.x, wanted);
      gets_on = now.size() < gaps.size() || smallest_of(now) > (1 + least_widening) * smallest_of(gaps);
      gaps = std::move(now);
    }
    if (gets_on) continue;
    state.restore(before);
    return;
  }
}

/// `faces`: of each triangle. Lengths at this scale.
GapReport report_of(const SheetGap& gap, double asked_rel, double diagonal, const Scale& scale,
                    std::span<const Index> faces) {
  GapReport report;
  report.asked_rel = asked_rel;
  if (gap.first < 0) return report;
  report.smallest_rel = gap.distance / diagonal;
  report.faces = {faces[gap.first], faces[gap.second]};
  for (int k = 0; k < 3; ++k) report.position[k] = scale.out(gap.place[k]);
  return report;
}

/// No vertex of the two triangles moves against one of the other.
bool is_held(const RepairTask& task, const Triangle& s, const Triangle& t) {
  const std::vector<Index>& part_of = task.policy.rigid_parts().of_vertex;
  const Index part = part_of.empty() ? -1 : part_of[s[0]];
  const auto all = [&](const auto& holds) {
    return std::all_of(s.begin(), s.end(), holds) && std::all_of(t.begin(), t.end(), holds);
  };
  return all([&](Index v) { return task.policy.is_held(v); }) ||
         (part >= 0 && all([&](Index v) { return part_of[v] == part; }));
}

}  // namespace

double gap_wanted_everywhere(const RepairTask& task) {
  return task.options.gap_near_conflicts ? 0 : task.options.min_gap_rel * task.diagonal;
}

void gap_stage(const RepairTask& task, const RepairControl& control, RepairState& state) {
  const double wanted = gap_wanted_everywhere(task);
  if (!(wanted > 0) || !task.options.recover || task.options.paper) return;
  try {
    std::vector<SheetGap> gaps = sheet_gaps(task, state, {}, control.limits.stopper()).narrow(state.scene.x, wanted);
    if (gaps.empty()) return;
    control.phases.start("open_gaps");
    open_all(task, control, std::move(gaps), state);
  } catch (const WorkStopped&) {  // the state is as it was before the round, or written and certified
    state.scene.x = state.format.as_written(state.scene.x);
  }
}

std::optional<GapReport> measured_gap(const RepairTask& task, const RepairState& state, const Positions& x,
                                      std::span<const IntersectingPair> left) {
  const double wanted = gap_wanted_everywhere(task);
  if (!(wanted > 0)) return std::nullopt;
  const SheetGap gap = sheet_gaps(task, state, left, {}).smallest(x, named_gaps * wanted);
  GapReport report =
      report_of(gap, task.options.min_gap_rel, task.diagonal, task.prepared.scale, task.prepared.triangulation.polygon);
  const std::span<const Triangle> triangles = task.prepared.triangles();
  report.is_between_held = gap.first >= 0 && is_held(task, triangles[gap.first], triangles[gap.second]);
  return report;
}

GapReport measure_gap(const SurfaceView& surface, double asked_rel, const FindOptions& options) {
  if (!(asked_rel >= 0) || !std::isfinite(asked_rel))
    throw std::invalid_argument("measure_gap: asked_rel is no gap; give a finite number that is not negative");
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  const double diagonal = prepared.diagonal_of(surface.positions), wanted = asked_rel * diagonal;
  const auto counts = [triangles = prepared.triangles(), passing = prepared.passing()](Index s, Index t) {
    return passing.meet(triangles, s, t);
  };
  const SheetGaps gaps(prepared.triangles(), prepared.rest, {.wanted = wanted, .counts = counts, .stop = {}});
  const SheetGap gap = wanted > 0 ? gaps.smallest(prepared.rest, named_gaps * wanted) : SheetGap{};
  return report_of(gap, asked_rel, diagonal, prepared.scale, prepared.triangulation.polygon);
}

}  // namespace unsnarl
