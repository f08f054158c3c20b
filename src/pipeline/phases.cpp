#include "pipeline/phases.h"

#include <algorithm>
#include <string>

#include "report/process_usage.h"

namespace unsnarl {

void Phases::start(std::string_view phase) {
  end();
  phase_ = phase;
  begin_ = Clock::now();
  cpu_begin_ = cpu_seconds();
}

void Phases::end() {
  if (phase_.empty()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  stages_.push_back({std::string(phase_), seconds, cpu_seconds() - cpu_begin_, peak_memory_mb()});
  phase_ = {};
}

void Phases::report(double fraction, std::size_t pairs_left, const Positions& x, const Positions& rest,
                    double diagonal) {
  if (!context_.on_progress) return;
  progress_.fraction = std::max(progress_.fraction, fraction);
  progress_.phase = phase_;
  progress_.pairs_left = pairs_left;
  if (diagonal > 0 && x.cols() > 0) progress_.displacement_rel = (x - rest).colwise().norm().maxCoeff() / diagonal;
  context_.on_progress(progress_);
}

}  // namespace unsnarl
