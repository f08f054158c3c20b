#include "contact/motion_frames.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "geometry/parallel_sums.h"

namespace unsnarl {
namespace {

/// A task of a parallel loop has this many triangles (unit: triangles)
constexpr Index frames_a_task = 2048;
/// Rounding in double precision changes a motion by less than this (unit: share of the motion)
constexpr double motion_rounding = 1e-14;
/// A sum is enlarged by more than it is rounded in single precision (unit: share of the sum)
constexpr double sum_rounding = 3e-7;
/// A dozen roundings in single precision change what is left of a clearance by less than this (unit: share of all
/// lengths that it is made of)
constexpr double clearance_reserve = 2e-6;
/// Shorter distances are not kept: squares of what is left of them may underflow (unit: coordinates)
constexpr double least_apart = 1e-10;

}  // namespace

void MotionFrames::update(const Positions& x) {
  assert(frames_.empty() || at_.cols() == x.cols());
  if (frames_.empty()) {
    at_ = x;
    frames_.assign(triangles_.size(), FourFloats{});
    return;
  }
  for_chunks(static_cast<Index>(triangles_.size()), frames_a_task, [&](Index begin, Index end) {
    for (Index t = begin; t < end; ++t) {
      const Triangle& f = triangles_[t];
      const Vec3 u = x.col(f[0]) - at_.col(f[0]), v = x.col(f[1]) - at_.col(f[1]), w = x.col(f[2]) - at_.col(f[2]);
      const Vec3 mean = (u + v + w) / 3;
      FourFloats& frame = frames_[t];
      Vec3 step;  // of the frame
      for (int k = 0; k < 3; ++k) {
        const float from = frame[k];
        frame[k] = from + static_cast<float>(mean[k]);
        step[k] = static_cast<double>(frame[k]) - static_cast<double>(from);
      }
      const double within =
          std::sqrt(std::max({(u - step).squaredNorm(), (v - step).squaredNorm(), (w - step).squaredNorm()}));
      const double sum = (frame[3] + within + motion_rounding * (within + step.cwiseAbs().sum())) * (1 + sum_rounding);
      // Not a number, too: from then on nothing is known.
      frame[3] = std::isfinite(sum) && u.allFinite() && v.allFinite() && w.allFinite()
                     ? static_cast<float>(sum)
                     : std::numeric_limits<float>::infinity();
    }
  });
  at_ = x;
}

MotionFrames::Clearance MotionFrames::clearance(Index a, Index b, double apart) const {
  const FourFloats &p = frames_[a], &q = frames_[b];
  Clearance result;
  if (!(apart > least_apart)) return result;
  double lengths = static_cast<double>(p[3]) + static_cast<double>(q[3]) + apart, offset = 0;
  for (int k = 0; k < 3; ++k) {
    result.offset[k] = p[k] - q[k];
    offset += std::abs(result.offset[k]);
  }
  result.due = static_cast<float>(lengths - clearance_reserve * (lengths + offset));
  return result;
}

}  // namespace unsnarl
