#include "pipeline/dihedral_stage.h"

#include <numbers>
#include <utility>
#include <vector>

#include "geometry/sort_unique.h"
#include "pipeline/open_dihedrals.h"

namespace unsnarl {

void dihedral_stage(const RepairTask& task, const RepairControl& control, RepairState& state) {
  if (!(task.options.min_dihedral_deg > 0)) return;
  Finders finders = make_finders(task, state);
  OpenDihedralsOptions options;
  options.least_radians = task.options.min_dihedral_deg * std::numbers::pi / 180;
  options.most_motion = task.most_motion();
  options.least_gap = task.options.min_gap_rel * task.diagonal;
  options.as_written = [&](const Positions& x) { return state.format.as_written(x); };
  options.pairs_at = [&](const Positions& x) {
    std::vector<IntersectingPair> pairs = finders.as_is.find(x);
    if (!state.format.float32()) return pairs;
    const std::vector<IntersectingPair> rounded = finders.find_rounded(x);
    pairs.insert(pairs.end(), rounded.begin(), rounded.end());
    sort_unique(pairs);
    return pairs;
  };
  options.stop = control.limits.stopper();
  open_dihedrals(state.scene, options);
}

}  // namespace unsnarl
