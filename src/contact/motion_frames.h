#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/four_lanes.h"
#include "geometry/types.h"

namespace unsnarl {

/// Until when two moving triangles that were found apart cannot meet. Triangles that are near each other mostly move
/// together: so each has a frame that is translated with it, and what counts is how far the two frames have moved
/// against each other, and how far the corners have moved in their frames. Holds exactly, rounding included.
class MotionFrames {
 public:
  /// The span must outlive this.
  explicit MotionFrames(std::span<const Triangle> triangles) : triangles_(triangles) {}

  /// The triangles move to x, in any way; at the first call they start there. Parallel.
  void update(const Positions& x);

  /// Tells how far two triangles may move before they are tested again. By default they have to be tested.
  struct Clearance {
    std::array<float, 3> offset = {0, 0, 0};  ///< of their frames, then
    float due = 0;                            ///< what their motion in the frames and of these may amount to
  };
  /// `apart`: a lower bound of their distance now, that may be too large by 1e-12 of itself.
  Clearance clearance(Index a, Index b, double apart) const;
  /// Whether the two certainly do not meet now.
  bool holds(Index a, Index b, const Clearance& clearance) const {
    const FourFloats &p = frames_[a], &q = frames_[b];
    const float x = p[0] - q[0] - clearance.offset[0], y = p[1] - q[1] - clearance.offset[1],
                z = p[2] - q[2] - clearance.offset[2], left = clearance.due - (p[3] + q[3]);
    return left > 0 && x * x + y * y + z * z < left * left;
  }

 private:
  std::span<const Triangle> triangles_;
  Positions at_;
  /// Per triangle: where its frame is, from the start; how far its corners have moved in it, at most, summed over the
  /// updates.
  std::vector<FourFloats> frames_;
};

}  // namespace unsnarl
