#include "unsnarl/stage_clock.h"

#include <utility>

#include "run/process_usage.h"

namespace unsnarl {

StageClock::StageClock() : start_(std::chrono::steady_clock::now()), cpu_start_(cpu_seconds()) {}

StageReport StageClock::stage(std::string name) const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return {std::move(name), seconds, cpu_seconds() - cpu_start_, peak_memory_mb()};
}

}  // namespace unsnarl
