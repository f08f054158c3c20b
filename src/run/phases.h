#pragma once

#include <string_view>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/repair.h"
#include "unsnarl/stage_clock.h"

namespace unsnarl {

/// The phases of a repair: the time that each took, and the progress reported to the caller. Its arguments must
/// outlive it.
class Phases {
 public:
  /// `stages`: gets what has ended.
  Phases(const Context& context, std::vector<StageReport>& stages) : context_(context), stages_(stages) {}

  /// Ends the one before, unless it is the same. `phase` must be a literal.
  void start(std::string_view phase);
  void end();
  /// Reports progress to Context::on_progress. `fraction` in [0, 1]; displacements are those of the farthest vertex of
  /// `x`.
  void report(double fraction, std::size_t pairs_left, const Positions& x, const Positions& rest, double diagonal);

 private:
  const Context& context_;
  std::vector<StageReport>& stages_;
  std::string_view phase_;
  StageClock clock_;  // of the phase
  Context::Progress progress_;
};

}  // namespace unsnarl
