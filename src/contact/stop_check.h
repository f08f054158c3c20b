#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

namespace unsnarl {

/// Thrown from within a long loop when `stop` says so. The code that passed `stop` catches it.
class WorkStopped : public std::runtime_error {
 public:
  WorkStopped() : std::runtime_error("the work was to stop") {}
};

/// Called for each piece of a list of `size` items: throws WorkStopped if the list is long and `stop`, which may be
/// empty, says so. Shorter lists are processed whole, so that work that ends between steps keeps its last step.
inline void end_long_work_if(const std::function<bool()>& stop, std::size_t size) {
  /// A loop over more items asks whether to stop; it takes a tenth of a second or more (unit: items)
  constexpr std::size_t long_list = 1 << 18;
  if (size > long_list && stop && stop()) throw WorkStopped();
}

/// Asks `stop`, which may be empty, at intervals in loops that run in parallel tasks.
class StopCheck {
 public:
  /// steps_between: steps of all tasks together between two questions, at least steps_at_once.
  StopCheck(const std::function<bool()>& stop, std::size_t tasks, std::uint32_t steps_between)
      : stop_(stop), steps_(stop ? tasks : 0), interval_(steps_between / steps_at_once) {}

  /// Safe from many threads, each with a task of its own. Throws WorkStopped.
  void step(std::size_t task) {
    if (steps_.empty() || ++steps_[task] % steps_at_once != 0) return;
    if (++looks_ % interval_ == 0 && stop_()) throw WorkStopped();
  }

 private:
  /// A task counts its own steps, and adds them to the common count after this many (unit: steps)
  static constexpr std::uint32_t steps_at_once = 1 << 10;
  const std::function<bool()>& stop_;
  std::vector<std::uint32_t> steps_;  // per task
  std::atomic<std::uint32_t> looks_{0};
  const std::uint32_t interval_;
};

}  // namespace unsnarl
