#pragma once

#include <chrono>
#include <string_view>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// The phases of a repair: how long each took, and how far it has got, for those who watch. What it is given must
/// outlive it.
class Phases {
 public:
  /// `stages`: gets what has ended.
  Phases(const Context& context, std::vector<StageReport>& stages) : context_(context), stages_(stages) {}

  /// Ends the one before. `phase` must be a literal.
  void start(std::string_view phase);
  void end();
  /// Tells whoever watches. `fraction` in [0, 1]; displacements are those of the farthest vertex of `x`.
  void report(double fraction, std::size_t pairs_left, const Positions& x, const Positions& rest, double diagonal);

 private:
  using Clock = std::chrono::steady_clock;

  const Context& context_;
  std::vector<StageReport>& stages_;
  std::string_view phase_;
  Clock::time_point begin_ = Clock::now();
  double cpu_begin_ = 0;
  Context::Progress progress_;
};

}  // namespace unsnarl
