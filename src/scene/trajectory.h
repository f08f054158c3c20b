#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "scene/patch.h"
#include "unsnarl/recording.h"

namespace unsnarl {

/// The iterations of the solvers on one patch, and the states of its free vertices on the way.
class Trajectory {
 public:
  struct State {
    int iteration = 0;
    Positions x;  ///< of the free vertices

    std::size_t bytes() const { return sizeof(double) * static_cast<std::size_t>(x.size()); }
  };

  /// state_budget: bytes that the states may take; beyond it, every second state is dropped. 0: no states.
  explicit Trajectory(std::size_t state_budget = 0) : state_budget_(state_budget) {}

  /// Measures the step of the record too.
  void add(const Patch& patch, const Positions& x, IterationRecord record);

  /// How far a trajectory had got.
  struct Mark {
    std::size_t iterations = 0;
    Positions last;
  };
  Mark mark() const { return {iterations.size(), last_}; }
  /// Forgets what came after the mark.
  void rewind(Mark mark);
  /// Drops everything after the first iteration with the fewest pairs, and some states if there are many. For failed
  /// tries, of which a part may still be used.
  void end_at_fewest_pairs();

  std::vector<IterationRecord> iterations;
  std::vector<State> states;       ///< ascending by iteration
  std::vector<double> bandwidths;  ///< of the free vertices at the end, where the method has them

 private:
  void thin_out();

  std::size_t state_budget_;
  int stride_ = 1;  // states of every so many-th iteration are kept
  Positions last_;  // the free vertices where they were recorded last
};

// Functions for solvers; they do nothing on a patch without a trajectory.

/// The state reached by an iteration, x of the patch's vertices.
inline void record(const Patch& patch, const Positions& x, const IterationRecord& iteration) {
  if (patch.trajectory) patch.trajectory->add(patch, x, iteration);
}

}  // namespace unsnarl
