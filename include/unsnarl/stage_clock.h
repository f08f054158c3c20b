#pragma once

#include <chrono>
#include <string>

#include "unsnarl/report.h"

namespace unsnarl {

/// Measures a stage of work, from its construction on.
class StageClock {
 public:
  StageClock();

  /// The stage until now: its name, seconds, processor seconds of the process, peak memory of the process.
  StageReport stage(std::string name) const;

 private:
  std::chrono::steady_clock::time_point start_;
  double cpu_start_;  // s
};

}  // namespace unsnarl
