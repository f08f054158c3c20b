#include "unsnarl/stage_clock.h"

#include <utility>

#include "platform/usage.h"

namespace unsnarl {

StageClock::StageClock() : start_(std::chrono::steady_clock::now()), cpu_start_(platform::cpu_seconds()) {}

StageReport StageClock::stage(std::string name) const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return {std::move(name), seconds, platform::cpu_seconds() - cpu_start_, platform::peak_memory_mb()};
}

}  // namespace unsnarl
