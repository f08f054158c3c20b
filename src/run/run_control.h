#pragma once

#include <algorithm>
#include <string_view>

#include "run/limits.h"
#include "unsnarl/repair.h"
#include "unsnarl/stage_clock.h"

namespace unsnarl {

/// What ends a run early and what is told of it, for a caller with a context or none. Time counts from its
/// construction on.
class RunControl {
 public:
  RunControl(Context* context, const RunLimits& limits)
      : context_(context != nullptr ? *context : nobody_), limits_(limits, context_) {}

  /// Was it cancelled, or a limit reached? True from the first time on.
  bool stopped() { return limits_.reached(); }
  /// Status::cancelled or that of the limit where stopped() has been true, else `status`.
  Status status_or(Status status) const { return limits_.status_or(status); }
  double seconds() const { return clock_.stage("").seconds; }

  bool is_told() const { return static_cast<bool>(context_.on_progress); }
  /// Reports progress to Context::on_progress; its fraction never decreases. `phase` must be a literal.
  void tell(double fraction, std::string_view phase, std::size_t pairs_left = 0, double displacement_rel = 0) {
    fraction_ = std::max(fraction_, fraction);
    if (is_told()) context_.on_progress({fraction_, phase, pairs_left, displacement_rel});
  }

 private:
  Context nobody_;
  Context& context_;
  Limits limits_;
  StageClock clock_;
  double fraction_ = 0;
};

}  // namespace unsnarl
