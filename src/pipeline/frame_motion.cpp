#include "pipeline/frame_motion.h"

#include <algorithm>
#include "geometry/rotation.h"

namespace unsnarl {
namespace {

using Mat3 = Eigen::Matrix3d;

}  // namespace

FrameMotion::FrameMotion(const SurfaceView& surface, const FindOptions& options)
    : known_(surface, options), neighbours_(vertex_neighbours(known_.topology.edges, known_.prepared.weld_map.count)) {}

Positions FrameMotion::correction(std::span<const double> input, std::span<const double> result) const {
  const Positions from = prepared().gather(input);
  Positions moved = prepared().gather(result) - from;
  const bool is_here = from == prepared().rest;
  for (Index v = 0; v < moved.cols() && !is_here; ++v) {
    if (moved.col(v).isZero(0)) continue;
    Mat3 covariance = Mat3::Zero();
    for (const Index w : neighbours_[v])
      covariance += (prepared().rest.col(w) - prepared().rest.col(v)) * (from.col(w) - from.col(v)).transpose();
    moved.col(v) = (nearest_rotation(covariance) * moved.col(v)).eval();
  }
  return moved;
}

}  // namespace unsnarl
