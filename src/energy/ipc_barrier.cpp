#include "energy/ipc_barrier.h"

#include "geometry/parallel_lists.h"

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

double IpcBarrier::value(const Positions& x, std::span<const BarrierStencil> stencils) const {
  double sum = 0;
  for (const BarrierStencil& s : stencils) {
    const double distance = std::sqrt(squared_distance(s.stencil, x));
    if (distance >= s.activation) continue;
    const double width = s.activation - s.separation;
    double energy = width * barrier((distance - s.separation) / width);
    if (s.mollifier_threshold > 0) energy *= mollifier(edges_of(s.stencil, x).c, s.mollifier_threshold);
    sum += energy;
  }
  return force_scale_ * sum;
}

double IpcBarrier::evaluate(const Positions& x, std::span<const BarrierStencil> stencils,
                            std::vector<BarrierContact>& contacts) const {
  constexpr Index chunk = 2048;  // stencils a task
  gather_in_chunks(static_cast<Index>(stencils.size()), chunk, contacts,
                   [&](Index begin, Index end, std::vector<BarrierContact>& list) {
                     BarrierContact contact;
                     for (Index i = begin; i < end; ++i) {
                       if (!evaluate(x, stencils[i], contact)) continue;
                       contact.stencil = i;
                       list.push_back(contact);
                     }
                   });
  double sum = 0;
  for (const BarrierContact& contact : contacts) sum += contact.energy;
  return force_scale_ * sum;
}

bool IpcBarrier::evaluate(const Positions& x, const BarrierStencil& s, BarrierContact& contact) const {
  contact.closest = closest(s.stencil, x);
  if (contact.closest.distance >= s.activation) return false;
  const double width = s.activation - s.separation;
  const double y = (contact.closest.distance - s.separation) / width;
  const double energy = width * barrier(y);
  double factor = 1;
  contact.mollified = false;
  if (s.mollifier_threshold > 0) {
    const Edges e = edges_of(s.stencil, x);
    if (e.c < s.mollifier_threshold) {
      factor = mollifier(e.c, s.mollifier_threshold);
      contact.mollified = true;
      // d|u x v|^2 = 2 (|v|^2 u - (u.v) v) . du + 2 (|u|^2 v - (u.v) u) . dv
      const double slope = 2 * force_scale_ * energy * mollifier_derivative(e.c, s.mollifier_threshold);
      contact.twist.col(0) = slope * (e.v.squaredNorm() * e.u - e.u.dot(e.v) * e.v);
      contact.twist.col(1) = slope * (e.u.squaredNorm() * e.v - e.u.dot(e.v) * e.u);
    }
  }
  contact.energy = factor * energy;
  contact.force = force_scale_ * factor * barrier_derivative(y);
  contact.stiffness = force_scale_ * factor * barrier_second_derivative(y) / width;
  return true;
}

void IpcBarrier::add_gradient(std::span<const BarrierStencil> stencils, std::span<const BarrierContact> contacts,
                              double scale, Positions& g) {
  for (const BarrierContact& contact : contacts) {
    const Stencil& s = stencils[contact.stencil].stencil;
    const Vec3 force = scale * contact.force * contact.closest.direction;
    for (int i = 0; i < s.size(); ++i) g.col(s.v[i]) += contact.closest.weights[i] * force;
    if (!contact.mollified) continue;
    g.col(s.v[0]) -= scale * contact.twist.col(0);
    g.col(s.v[1]) += scale * contact.twist.col(0);
    g.col(s.v[2]) -= scale * contact.twist.col(1);
    g.col(s.v[3]) += scale * contact.twist.col(1);
  }
}

}  // namespace unsnarl
