#pragma once

#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "pipeline/repair_from.h"

namespace unsnarl {

/// A frame of a moving surface, in which corrections of other frames can be seen. The welding is its own.
class FrameMotion {
 public:
  /// `surface`: at the positions of the frame. Throws as prepare() does.
  FrameMotion(const SurfaceView& surface, const FindOptions& options);

  const KnownSurface& known() const { return known_; }
  const PreparedSurface& prepared() const { return known_.prepared; }

  /// The correction of another frame, or of this: of the welded vertices, `result` less `input` (3 n doubles each), at
  /// the scale of this frame.
  /// Each is turned by the rotation that carries the edges around its vertex from that frame to this one best (polar
  /// decomposition, as in as-rigid-as-possible modelling: Sorkine, Alexa 2007).
  Positions correction(std::span<const double> input, std::span<const double> result) const;

 private:
  KnownSurface known_;
  IndexLists neighbours_;
};

}  // namespace unsnarl
