#pragma once

#include <functional>
#include <map>
#include <vector>

#include "scene/scene.h"
#include "untangle/trial.h"

namespace unsnarl {

/// The best candidate of a tier is kept if it leaves less than this share of its region's pairs [E10, E131] (no unit)
constexpr double kept_of_tier = 0.7;

/// What becomes of a candidate.
enum class Verdict {
  drop,      ///< it does not help, or is not accepted
  keep,      ///< the surface takes its positions
  remember,  ///< it may be kept at the end of its tier
  compare,   ///< it went far, or another one of its region did: look_farther(), then judge_far()
  wait,      ///< it went far: kept if no nearer one comes
};

/// Judges a candidate by its progress. One that turns a closed component inside out counts as far, and as farther than
/// all that do not. `must_be_clean`: one that leaves pairs is dropped. `rival`: the candidate of the
/// same region that waits; may be null.
Verdict judge(const Trial& trial, bool must_be_clean, const Trial* rival);

/// Judges a candidate after look_farther().
Verdict judge_far(const Trial& trial, const Trial* rival);

/// Candidates that are not kept at once. One whose free vertices have moved since it was made is outdated, and counts
/// as none.
class Candidates {
 public:
  /// The one that waits for this region; null: there is none.
  const Trial* rival(const ConflictRegion& region, const Scene& scene) const;
  /// In place of the one that waits for the same region.
  void wait(Trial trial, const Scene& scene);
  /// Unless one that resolves more pairs is remembered for a region with the same first vertex.
  void remember(Trial trial, const Scene& scene);

  /// Takes out those that wait and are due, the nearest to rest first.
  std::vector<Trial> take_waiting(const std::function<bool(const Trial& trial)>& is_due);
  /// Takes out those that are remembered, due and leave less than `share` of their pairs, by the first vertices of
  /// their regions, and hands each to `keep` before it looks at the next. Outdated ones are dropped.
  void take_best(double share, const std::function<bool(const Trial& trial)>& is_due, const Scene& scene,
                 const std::function<void(Trial& trial)>& keep);

 private:
  std::vector<Trial> waiting_;   // clean
  std::map<Index, Trial> best_;  // by the first vertex of the region's core
};

}  // namespace unsnarl
