#include "untangle/local/flip_guard.h"

#include <array>

#include "mesh/areas.h"

namespace unsnarl {
namespace {

/// Share of its area vector at rest that a face keeps [E96] (no unit)
constexpr double guarded_share = 0.1;
/// Sweeps over the faces in one projection, at most [E97] (unit: sweeps)
constexpr int guard_sweeps = 10;

}  // namespace

FlipGuard::FlipGuard(const Patch& patch, std::span<const std::uint8_t> may_turn) : free_count_(patch.free_count) {
  for (Index t = 0; t < patch.active_count; ++t) {
    if (may_turn[t]) continue;
    const Triangle& corners = patch.triangles[t];
    const Vec3 at_rest = area_vector(patch.rest, corners);
    const double size = at_rest.norm();
    if (!(size > 0) || !(area_vector(patch.x, corners).dot(at_rest) > guarded_share * size * size)) continue;
    kept_.push_back({corners, at_rest / size, size});
  }
}

bool FlipGuard::project(Positions& x) const {
  for (int sweep = 0; sweep < guard_sweeps; ++sweep) {
    bool pushed = false;
    for (const Kept& kept : kept_) {
      const Triangle& t = kept.corners;
      const double missing = guarded_share * kept.size - area_vector(x, t).dot(kept.normal);
      if (!(missing > 0)) continue;
      std::array<Vec3, 3> gradient;
      double squares = 0;
      for (int k = 0; k < 3; ++k) {
        gradient[k] = kept.normal.cross(Vec3(x.col(t[(k + 2) % 3]) - x.col(t[(k + 1) % 3])));
        if (t[k] < free_count_) squares += gradient[k].squaredNorm();
      }
      if (!(squares > 0)) continue;
      for (int k = 0; k < 3; ++k)
        if (t[k] < free_count_) x.col(t[k]) += missing / squares * gradient[k];
      pushed = true;
    }
    if (!pushed) return sweep > 0;
  }
  return true;
}

}  // namespace unsnarl
