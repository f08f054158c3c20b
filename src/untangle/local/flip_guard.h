#pragma once

#include <span>
#include <vector>

#include "scene/patch.h"

namespace unsnarl {

/// Keeps active faces of a patch from flipping while a local strategy moves it: the area vector of each keeps at
/// least a share of its length in the direction it has at rest. Not guarded: faces that `may_turn`, and those that have
/// no area at rest or are below that share at patch.x.
class FlipGuard {
 public:
  /// may_turn: per active triangle.
  FlipGuard(const Patch& patch, std::span<const std::uint8_t> may_turn);

  /// Pushes the free corners of faces that are below the share until none is, one face after the other (position-based
  /// dynamics), for a few sweeps at most. False: all were above, and x is as it was.
  bool project(Positions& x) const;

 private:
  struct Kept {
    Triangle corners;
    Vec3 normal;      // at rest
    double size = 0;  // of the area vector at rest
  };
  Index free_count_ = 0;
  std::vector<Kept> kept_;
};

}  // namespace unsnarl
