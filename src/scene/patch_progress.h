#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>

namespace unsnarl {

/// How far the work on a patch has got, for display alone: its solver writes it, another thread may read it.
struct PatchProgress {
  std::size_t pairs_before = 0;       ///< intersecting pairs to resolve
  std::atomic<std::size_t> pairs{0};  ///< intersecting pairs that are left
  std::atomic<double> done{0};        ///< share of the work that is done, as far as that can be foreseen, in [0, 1]

  void begin(std::size_t before) {
    pairs_before = before;
    set_pairs(before);
  }
  /// For solvers that only know what is left.
  void set_pairs(std::size_t now) {
    const double all = static_cast<double>(std::max<std::size_t>(1, pairs_before));
    pairs = now;
    done = pairs_before == 0 ? 0 : std::max(0.0, 1 - static_cast<double>(now) / all);
  }
};

/// Reports progress while solvers work, at intervals: from whichever solver thread asks whether to stop, one report at
/// a time.
class ProgressReporter {
 public:
  /// `report` may be empty. Both must outlive the reporter.
  ProgressReporter(const std::function<void()>& report, const std::function<bool()>& stop)
      : report_(report), stop_(stop) {}

  /// True: stop. Safe from any thread.
  bool asked() {
    if (report_) {
      const std::unique_lock lock(mutex_, std::try_to_lock);
      if (lock && Clock::now() - reported_ >= interval) {
        report_();
        reported_ = Clock::now();
      }
    }
    return stop_ && stop_();
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Time between two reports of progress (unit: ms)
  static constexpr std::chrono::milliseconds interval{200};

  const std::function<void()>& report_;
  const std::function<bool()>& stop_;
  std::mutex mutex_;  // guards the report and the time of the last one
  Clock::time_point reported_ = Clock::now();
};

}  // namespace unsnarl
