#include "scene/trajectory.h"

#include <algorithm>

namespace unsnarl {

void Trajectory::add(const Patch& patch, const Positions& x, IterationRecord record) {
  const int iteration = static_cast<int>(iterations.size());
  const auto free = x.leftCols(patch.free_count);
  if (last_.cols() == free.cols() && free.cols() > 0) record.step = (free - last_).colwise().norm().maxCoeff();
  last_ = free;
  iterations.push_back(record);
  if (state_budget_ == 0 || iteration % stride_ != 0) return;
  states.push_back({iteration, free});
  if (states.size() < 2 || states.size() * states.back().bytes() <= state_budget_) return;
  thin_out();
}

void Trajectory::thin_out() {
  stride_ *= 2;
  std::erase_if(states, [&](const State& state) { return state.iteration % stride_ != 0; });
}

void Trajectory::rewind(Mark mark) {
  iterations.resize(mark.iterations);
  last_ = std::move(mark.last);
  std::erase_if(states,
                [&](const State& state) { return static_cast<std::size_t>(state.iteration) >= mark.iterations; });
}

void Trajectory::end_at_fewest_pairs() {
  const auto fewest = std::min_element(iterations.begin(), iterations.end(),
                                       [](const auto& a, const auto& b) { return a.pairs < b.pairs; });
  if (fewest == iterations.end()) return;
  rewind({static_cast<std::size_t>(fewest - iterations.begin()) + 1, {}});
  /// States are thinned out while there are more (unit: states)
  constexpr std::size_t many_states = 16;
  while (states.size() > many_states) thin_out();
}

}  // namespace unsnarl
