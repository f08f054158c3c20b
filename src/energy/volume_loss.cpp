#include "energy/volume_loss.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/sort_unique.h"
#include "mesh/areas.h"

namespace unsnarl {
VolumeLoss::VolumeLoss(const Positions& rest, std::vector<Surface> surfaces, double least) {
  for (Surface& surface : surfaces) {
    Kept kept;
    kept.triangles = std::move(surface.triangles);
    for (const Triangle& t : kept.triangles) kept.vertices.insert(kept.vertices.end(), t.begin(), t.end());
    sort_unique(kept.vertices);
    if (kept.vertices.empty()) continue;
    kept.origin = rest.col(kept.vertices.front());
    kept.sign = surface.volume < 0 ? -1 : 1;
    const double beside = surface.volume - volume_over(rest, kept.triangles, kept.origin);
    kept.elsewhere = least * std::abs(surface.volume) - kept.sign * beside;
    kept.area = surface.area;
    surfaces_.push_back(std::move(kept));
  }
}

double VolumeLoss::loss_of(const Kept& kept, const Positions& x) {
  return std::max(0.0, kept.elsewhere - kept.sign * volume_over(x, kept.triangles, kept.origin));
}

double VolumeLoss::value(const Positions& x, Index s) const {
  const double loss = loss_of(surfaces_[s], x);
  return 0.5 * loss * loss / surfaces_[s].area;
}

double VolumeLoss::linearise(const Positions& x, Index s, double weight, Positions& gradient,
                             HessianTerms& hessian) const {
  const Kept& kept = surfaces_[s];
  const double loss = loss_of(kept, x);
  if (!(loss > 0)) return 0;
  HessianTerms::Dense& term = hessian.dense.emplace_back();
  term.vertices = kept.vertices;
  term.g = Eigen::Matrix3Xd::Zero(3, static_cast<Index>(kept.vertices.size()));
  term.stiffness = weight / kept.area;
  for (const Triangle& t : kept.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 b = x.col(t[(k + 1) % 3]) - kept.origin, c = x.col(t[(k + 2) % 3]) - kept.origin;
      const auto i = std::lower_bound(kept.vertices.begin(), kept.vertices.end(), t[k]) - kept.vertices.begin();
      term.g.col(i) -= kept.sign / 6 * b.cross(c);
    }
  for (std::size_t i = 0; i < kept.vertices.size(); ++i)
    gradient.col(kept.vertices[i]) += weight * loss / kept.area * term.g.col(static_cast<Index>(i));
  return weight * value(x, s);
}

}  // namespace unsnarl
