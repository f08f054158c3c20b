#include "run/phases.h"

#include <algorithm>
#include <string>

namespace unsnarl {

void Phases::start(std::string_view phase) {
  if (phase == phase_) return;
  end();
  phase_ = phase;
  clock_ = StageClock();
}

void Phases::end() {
  if (phase_.empty()) return;
  stages_.push_back(clock_.stage(std::string(phase_)));
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
