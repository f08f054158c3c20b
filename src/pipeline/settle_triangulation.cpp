#include "pipeline/settle_triangulation.h"

#include <utility>
#include <vector>

#include "pipeline/triangulations.h"

namespace unsnarl {
namespace {

/// Times that polygons are cut anew from where their vertices came to lie, at most. Of 2000 soups of twisted polygons
/// four do not settle with 24 cuts, 6 of them at once; two with 64 and 6; one with 64 and 12.
constexpr int most_cuts = 64;
/// Number of cuts, from the first on, that are worked on together with the cut before each.
constexpr int most_cuts_at_once = 12;

/// The polygons as whoever reads the present state cuts them: as usual, and along the other diagonals.
std::vector<Triangulation> cuts_by_positions(const SceneRepair& repair, const Job& job) {
  const std::vector<double> positions = job.prepared.scatter(job.surface.positions, repair.scene().x);
  const SurfaceView result = {positions, job.surface.corners, job.surface.offsets};
  const std::vector<Index>& vertex_of = job.prepared.weld_map.vertex_of;
  return {triangulate(result, vertex_of),
          job.options.find.both_diagonals ? triangulate_other_diagonals(result, vertex_of) : Triangulation()};
}

void work_on(SceneRepair& repair, const std::vector<Triangulation>& cuts) {
  repair.take(unite(cuts));
  Finders finders = repair.make_finders();
  repair.ignore_inseparable_pairs(finders);
  repair.work(finders);
}

std::vector<Index> vertices_of(const Job& job, const std::vector<Index>& polygons) {
  std::vector<Index> vertices;
  for (const Index f : polygons)
    for (const Index corner : job.surface.face(f)) vertices.push_back(job.prepared.weld_map.vertex_of[corner]);
  return vertices;
}

/// Tries to settle all components that are not let be. Where some do not settle, it goes back to the best state, lets
/// these be from now on, and returns false.
bool settles(SceneRepair& repair, const Job& job) {
  const std::vector<Triangulation> input = {job.prepared.triangulation, job.prepared.other_diagonals};
  const std::size_t input_size = unite(input).all.triangles.size();
  SceneRepair::Checkpoint best = repair.checkpoint();
  bool best_holds = false;
  for (int round = 0; round < most_cuts && !job.limits.reached(); ++round) {
    const std::vector<Triangulation> now = cuts_by_positions(repair, job);
    const UnitedTriangulations both = unite({input[0], input[1], now[0], now[1]});
    if (round == 0 && both.all.triangles.size() == input[0].triangles.size()) return true;
    repair.take(both);
    const SceneRepair::Checkpoint here = repair.checkpoint();
    Finders finders_of_both = repair.make_finders();
    const std::vector<IntersectingPair> pairs = repair.ignore_inseparable_pairs(finders_of_both);
    if (repair.is_resolved(finders_of_both)) {
      const std::vector<Index> on_duplicates = polygons_on_new_duplicates(both.all, input_size, pairs);
      if (on_duplicates.empty()) return true;
      if (!std::exchange(best_holds, true)) best = here;
      repair.restore_to_rest(vertices_of(job, on_duplicates));
      work_on(repair, input);
    } else {
      if (round < most_cuts_at_once) {
        repair.work(finders_of_both);
        if (repair.is_resolved(finders_of_both)) continue;
        repair.restore(here);
      }
      work_on(repair, round % 2 == 0 ? now : input);
    }
  }
  const std::vector<Triangulation> now = cuts_by_positions(repair, job);
  repair.take(unite({input[0], input[1], now[0], now[1]}));
  Finders finders_at_end = repair.make_finders();
  repair.ignore_inseparable_pairs(finders_at_end);
  const bool is_done = !repair.tolerate_what_is_left(finders_at_end);
  repair.take(unite(input));
  repair.restore(best);
  return is_done;
}

}  // namespace

void settle_triangulation(SceneRepair& repair, const Job& job, Finders& finders) {
  if (job.surface.offsets.empty()) return;
  repair.tolerate_what_is_left(finders);
  while (!settles(repair, job)) {
  }
}

}  // namespace unsnarl
