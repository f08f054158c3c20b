#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

namespace unsnarl {

/// Ends work from within a long loop where it was to stop. Who gave the `stop` catches it.
class WorkStopped : public std::runtime_error {
 public:
  WorkStopped() : std::runtime_error("the work was to stop") {}
};

/// For each piece of a list of `size` items: throws WorkStopped where the list is so long that it matters and `stop`,
/// which may be empty, says so. Shorter lists are gone through whole, so that work which ends between steps keeps what
/// the last step is worth.
inline void end_long_work_if(const std::function<bool()>& stop, std::size_t size) {
  constexpr std::size_t long_list = 1 << 18;  // items: a tenth of a second or more
  if (size > long_list && stop && stop()) throw WorkStopped();
}

/// Asks `stop`, which may be empty, every so many steps of loops that run in parallel tasks.
class StopCheck {
 public:
  /// steps_between: of all tasks together; at least steps_at_once.
  StopCheck(const std::function<bool()>& stop, std::size_t tasks, std::uint32_t steps_between)
      : stop_(stop), steps_(stop ? tasks : 0), interval_(steps_between / steps_at_once) {}

  /// Safe from many threads, each with a task of its own. Throws WorkStopped.
  void step(std::size_t task) {
    if (steps_.empty() || ++steps_[task] % steps_at_once != 0) return;
    if (++looks_ % interval_ == 0 && stop_()) throw WorkStopped();
  }

 private:
  static constexpr std::uint32_t steps_at_once = 1 << 10;  // that a task takes before it tells the others
  const std::function<bool()>& stop_;
  std::vector<std::uint32_t> steps_;  // per task
  std::atomic<std::uint32_t> looks_{0};
  const std::uint32_t interval_;
};

}  // namespace unsnarl
