#pragma once

#include <atomic>
#include <chrono>
#include <functional>

#include "unsnarl/repair.h"

namespace unsnarl {

/// 0: no limit.
struct RunLimits {
  double time_s = 0;     ///< wall-clock seconds
  double memory_mb = 0;  ///< MB (10^6 bytes) of resident memory of the process
};

/// Watches what ends a run early: cancellation, the limits of time and of memory. Safe from any thread. The
/// context must outlive it.
class Limits {
 public:
  /// Time counts from here on.
  Limits(const RunLimits& limits, const Context& context) : limits_(limits), context_(context) {}
  Limits(const RepairOptions& options, const Context& context)
      : Limits(RunLimits{options.time_limit_s, options.memory_limit_mb}, context) {}

  /// True from the first time a limit was reached.
  bool reached();
  std::function<bool()> stopper() {
    return [this] { return reached(); };
  }
  /// True from the first time that a limit, or this share of the limit of time, was reached: what comes after has the
  /// rest of the time. The limit of time then counts as reached for what was cut short.
  std::function<bool()> stopper_at(double share_of_time) {
    return [this, share_of_time] { return reached() || has_passed(share_of_time); };
  }
  /// For what has no result yet: a cancellation ends it where it has one.
  std::function<bool()> stopper_but_for_cancellation() {
    return [this] { return reached() && status_or(Status::cancelled) != Status::cancelled; };
  }
  /// Memory could not be had: what was at work is gone, what was reached is still there.
  void run_out_of_memory();
  /// The limit that was reached, that of time where something was cut short, or `status` where none was.
  Status status_or(Status status) const;
  /// The status of a result that would have `status`: that of a cancellation, or of memory that ran out, comes before
  /// any other. Such a result may be embedded, but it is not the one that the same call would give again.
  Status status_of_result(Status status) const;

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int none = -1;

  bool has_passed(double share_of_time);

  const RunLimits limits_;
  const Context& context_;
  Clock::time_point begin_ = Clock::now();
  std::atomic<int> reason_{none};       // a Status
  std::atomic<bool> cut_short_{false};  // something has ended at its share of the time
};

}  // namespace unsnarl
