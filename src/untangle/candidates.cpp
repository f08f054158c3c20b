#include "untangle/candidates.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace unsnarl {
namespace {

Verdict worth(const Trial& trial) {
  return trial.is_clean() || trial.left.is_below(kept_at_once, trial.before) ? Verdict::keep : Verdict::remember;
}

bool is_nearer(const Trial& trial, const Trial& rival) {
  if (trial.is_inside_out != rival.is_inside_out) return rival.is_inside_out;
  return trial.distance < rival.distance;
}

}  // namespace

Verdict judge(const Trial& trial, bool must_be_clean, const Trial* rival) {
  if (!trial.left.fell_from(trial.before) || trial.is_rejected) return Verdict::drop;
  if (must_be_clean && !trial.is_clean()) return Verdict::drop;
  return rival || trial.is_inside_out || largest_motion(trial) > trial.reach ? Verdict::compare : worth(trial);
}

Verdict judge_far(const Trial& trial, const Trial* rival) {
  if (!trial.left.fell_from(trial.before)) return Verdict::drop;
  if (rival && (!trial.is_clean() || !is_nearer(trial, *rival))) return Verdict::drop;
  if (!trial.is_inside_out && largest_distance(trial) <= trial.selection.bound) return worth(trial);
  // Pairs that it leaves would have to be resolved from far away.
  return trial.is_clean() ? Verdict::wait : Verdict::drop;
}

const Trial* Candidates::rival(const ConflictRegion& region, const Scene& scene) const {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Trial& waiting) {
    return waiting.selection.region.core == region.core && is_current(waiting, scene);
  });
  return found == waiting_.end() ? nullptr : &*found;
}

void Candidates::wait(Trial trial, const Scene& scene) {
  if (const Trial* known = rival(trial.selection.region, scene))
    waiting_[static_cast<std::size_t>(known - waiting_.data())] = std::move(trial);
  else
    waiting_.push_back(std::move(trial));
}

void Candidates::remember(Trial trial, const Scene& scene) {
  // Regions with the same first vertex may differ by what they have taken in: the pairs that their candidates leave do
  // not compare, those that they resolve do.
  const Index key = trial.selection.region.core.front();
  const auto known = best_.find(key);
  if (known == best_.end() || !is_current(known->second, scene) || trial.resolved() > known->second.resolved())
    best_.insert_or_assign(key, std::move(trial));
}

std::vector<Trial> Candidates::take_waiting(const std::function<bool(const Trial& trial)>& is_due) {
  const auto due = std::stable_partition(waiting_.begin(), waiting_.end(), std::not_fn(is_due));
  std::stable_sort(due, waiting_.end(), [](const Trial& a, const Trial& b) { return a.distance < b.distance; });
  std::vector<Trial> taken(std::make_move_iterator(due), std::make_move_iterator(waiting_.end()));
  waiting_.erase(due, waiting_.end());
  return taken;
}

void Candidates::take_best(double share, const std::function<bool(const Trial& trial)>& is_due, const Scene& scene,
                           const std::function<void(Trial& trial)>& keep) {
  for (auto it = best_.begin(); it != best_.end();) {
    Trial& best = it->second;
    const bool is_kept = is_due(best) && best.left.is_below(share, best.before);
    if (is_kept) keep(best);
    it = is_kept || !is_current(best, scene) ? best_.erase(it) : std::next(it);
  }
}

}  // namespace unsnarl
