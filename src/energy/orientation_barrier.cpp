#include "energy/orientation_barrier.h"

#include <algorithm>
#include <cmath>

#include "energy/ipc_barrier.h"
#include "mesh/areas.h"

namespace unsnarl {

OrientationBarrier::OrientationBarrier(const Positions& rest, const Positions& start,
                                       std::span<const Triangle> triangles, const Options& options)
    : activation_(options.activation) {
  triangles_.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    Kept kept;
    kept.corners = t;
    const Vec3 area = area_vector(rest, t);
    const double squared = area.squaredNorm();
    double longest = 0;  // edge
    for (int k = 0; k < 3; ++k) longest = std::max(longest, (rest.col(t[k]) - rest.col(t[(k + 1) % 3])).norm());
    if (squared > 0 && longest > 0 && std::isfinite(1 / squared)) {
      kept.normal = area / squared;
      kept.weight = options.scale * std::sqrt(squared) / longest;
      kept.turned = !(kept.normal.dot(area_vector(start, t)) > 0);
    }
    triangles_.push_back(kept);
  }
}

void OrientationBarrier::update(const Positions& x) {
  for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t)
    triangles_[t].turned = triangles_[t].turned && !(share(x, t) > 0);
}

double OrientationBarrier::share(const Positions& x, Index t) const {
  return triangles_[t].normal.dot(area_vector(x, triangles_[t].corners)) / activation_;
}

double OrientationBarrier::value(const Positions& x, Index t) const {
  const Kept& kept = triangles_[t];
  if (!(kept.weight > 0)) return 0;
  const double y = share(x, t);
  if (y >= 1) return 0;
  return kept.weight * (kept.turned ? 0.5 * (1 - y) * (1 - y) : barrier(y));
}

bool OrientationBarrier::evaluate(const Positions& x, Index t, Term& term) const {
  const Kept& kept = triangles_[t];
  if (!(kept.weight > 0)) return false;
  const double y = share(x, t);
  if (y >= 1) return false;
  term.value = kept.weight * (kept.turned ? 0.5 * (1 - y) * (1 - y) : barrier(y));
  term.force = kept.weight / activation_ * (kept.turned ? y - 1 : barrier_derivative(y));
  term.stiffness = kept.weight / (activation_ * activation_) * (kept.turned ? 1 : barrier_second_derivative(y));
  for (int k = 0; k < 3; ++k) {
    const Vec3 opposite = x.col(kept.corners[(k + 2) % 3]) - x.col(kept.corners[(k + 1) % 3]);
    term.gradient.col(k) = kept.normal.cross(opposite);
  }
  return true;
}

}  // namespace unsnarl
