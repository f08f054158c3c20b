#include "energy/ipc_barrier.h"

namespace unsnarl {
namespace {

struct Edges {
  Vec3 u, v;
  double c;  // |u x v|^2
};

Edges edges_of(const Stencil& s, const Positions& x) {
  Edges e;
  e.u = x.col(s.v[1]) - x.col(s.v[0]);
  e.v = x.col(s.v[3]) - x.col(s.v[2]);
  e.c = e.u.cross(e.v).squaredNorm();
  return e;
}

}  // namespace

double IpcBarrier::value(const Positions& x, Index index) const {
  const BarrierStencil& s = stencils[index];
  const double distance = std::sqrt(squared_distance(s.stencil, x));
  if (distance >= s.activation) return 0;
  const double width = s.activation - s.separation;
  const double energy = width * barrier((distance - s.separation) / width);
  return s.mollifier_threshold > 0 ? energy * mollifier(edges_of(s.stencil, x).c, s.mollifier_threshold) : energy;
}

double IpcBarrier::linearise(const Positions& x, Index index, double weight, Positions& gradient,
                             HessianTerms& hessian) const {
  const BarrierStencil& s = stencils[index];
  const Stencil& stencil = s.stencil;
  const Closest at = closest(stencil, x);
  if (at.distance >= s.activation) return 0;
  const double width = s.activation - s.separation;
  const double y = (at.distance - s.separation) / width;
  const double energy = width * barrier(y);
  double factor = 1;
  if (s.mollifier_threshold > 0) {
    const Edges e = edges_of(stencil, x);
    if (e.c < s.mollifier_threshold) {
      factor = mollifier(e.c, s.mollifier_threshold);
      // d|u x v|^2 = 2 (|v|^2 u - (u.v) v) . du + 2 (|u|^2 v - (u.v) u) . dv
      const double slope = 2 * weight * energy * mollifier_derivative(e.c, s.mollifier_threshold);
      const Vec3 in_u = slope * (e.v.squaredNorm() * e.u - e.u.dot(e.v) * e.v);
      const Vec3 in_v = slope * (e.u.squaredNorm() * e.v - e.u.dot(e.v) * e.u);
      gradient.col(stencil.v[0]) -= in_u;
      gradient.col(stencil.v[1]) += in_u;
      gradient.col(stencil.v[2]) -= in_v;
      gradient.col(stencil.v[3]) += in_v;
    }
  }
  HessianTerms::RankOne& term = hessian.rank_ones.emplace_back();
  term.vertices = stencil.v;
  term.stiffness = weight * factor * barrier_second_derivative(y) / width;
  const double force = weight * factor * barrier_derivative(y);
  for (int i = 0; i < stencil.size(); ++i) {
    term.g.col(i) = at.weights[i] * at.direction;
    gradient.col(stencil.v[i]) += force * term.g.col(i);
  }
  return weight * factor * energy;
}

}  // namespace unsnarl
