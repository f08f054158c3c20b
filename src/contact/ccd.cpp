#include "contact/ccd.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/stop_check.h"
#include "geometry/parallel_lists.h"

namespace unsnarl {
namespace {

/// Number of leading vertices that form the first primitive.
int first_primitive_size(StencilKind kind) {
  return kind == StencilKind::edge_edge ? 2 : 1;
}
int stencil_size(StencilKind kind) {
  return kind == StencilKind::vertex_edge ? 3 : 4;
}

/// Upper bound of the speed at which the two primitives approach; removes the common motion from p first.
double approach_speed(StencilKind kind, std::array<Vec3, 4>& p) {
  const int n = stencil_size(kind);
  const int first = first_primitive_size(kind);
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < n; ++i) mean += p[i];
  mean /= n;
  double fastest[2] = {0, 0};
  for (int i = 0; i < n; ++i) {
    p[i] -= mean;
    double& f = fastest[i < first ? 0 : 1];
    f = std::max(f, p[i].squaredNorm());
  }
  return std::sqrt(fastest[0]) + std::sqrt(fastest[1]);
}

/// How long the primitives, at x with velocities p, stay `level` apart along `direction`, a unit vector from the second
/// to the first: as long as each two of their vertices do.
double time_apart(StencilKind kind, const Vec3& direction, const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& p,
                  double level) {
  const int first = first_primitive_size(kind), n = stencil_size(kind);
  double time = std::numeric_limits<double>::infinity();
  for (int i = 0; i < first; ++i)
    for (int j = first; j < n; ++j) {
      const double closing = direction.dot(p[j] - p[i]);
      if (!(closing > 0)) continue;
      time = std::min(time, std::max(0.0, direction.dot(x[i] - x[j]) - level) / closing);
    }
  return time;
}

}  // namespace

double time_of_impact(StencilKind kind, const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& p, double separation,
                      const CcdOptions& options) {
  std::array<Vec3, 4> velocity = p;
  const double speed = approach_speed(kind, velocity);
  if (!(speed > 0)) return 1;
  Closest at = closest(kind, x);
  const double free_distance = at.distance - separation;
  if (free_distance > speed) return 1;                                  // too slow to arrive within the step
  if (!(free_distance > 0)) return std::numeric_limits<double>::min();  // precondition broken: do not move
  const double level = separation + options.slack * free_distance;

  const int n = stencil_size(kind);
  std::array<Vec3, 4> moved = x;
  double time = 0;
  for (int advance = 0; advance < options.max_advances; ++advance) {
    const double by_speed = (at.distance - level) / speed;
    const double next = time + std::max(by_speed, time_apart(kind, at.direction, moved, velocity, level));
    if (next >= 1) return 1;
    if (!(next > (1 + options.least_advance) * time)) break;
    time = next;
    for (int i = 0; i < n; ++i) moved[i] = x[i] + time * velocity[i];
    at = closest(kind, moved);
    if (!(at.distance > level)) break;
  }
  return std::max(time, std::numeric_limits<double>::min());
}

double time_of_impact(const SeparatedStencil& s, const Positions& x, const Positions& p, const CcdOptions& options) {
  std::array<Vec3, 4> position, displacement;
  const int n = s.stencil.size();
  for (int i = 0; i < 4; ++i) {
    if (i < n) {
      position[i] = x.col(s.stencil.v[i]);
      displacement[i] = p.col(s.stencil.v[i]);
    } else {
      position[i].setZero();
      displacement[i].setZero();
    }
  }
  return time_of_impact(s.stencil.kind, position, displacement, s.separation, options);
}

double largest_step(std::span<const SeparatedStencil> stencils, const Positions& x, const Positions& p,
                    const CcdOptions& options) {
  double step = 1;
  for (const SeparatedStencil& s : stencils) step = std::min(step, time_of_impact(s, x, p, options));
  return step;
}

int filter_displacements(std::span<const SeparatedStencil> stencils, const Positions& x, Positions& p,
                         OnCollision on_collision, const CcdOptions& options) {
  /// Shortened displacements may collide anew; after this many sweeps the vertices that still collide stay in place
  /// (unit: sweeps)
  constexpr int sweeps_of_shortening = 8;
  std::vector<std::uint8_t> changed(static_cast<std::size_t>(x.cols()), 1);
  std::vector<std::uint8_t> changing(changed.size(), 0);
  std::vector<double> scale(changed.size(), 1);
  struct Collision {
    Index stencil;
    double time;
  };
  std::vector<Collision> collisions;
  for (int sweep = 0;; ++sweep) {
    gather_in_chunks(static_cast<Index>(stencils.size()), collisions,
                     [&](Index begin, Index end, std::vector<Collision>& list) {
                       end_long_work_if(options.stop, stencils.size());
                       for (Index k = begin; k < end; ++k) {
                         const Stencil& s = stencils[k].stencil;
                         bool touched = false, moving = false;
                         for (int i = 0; i < s.size(); ++i) {
                           touched |= changed[s.v[i]] != 0;
                           moving |= !p.col(s.v[i]).isZero(0);
                         }
                         if (!touched || !moving) continue;
                         const double t = time_of_impact(stencils[k], x, p, options);
                         if (t < 1) list.push_back({k, t});
                       }
                     });
    if (collisions.empty()) return sweep + 1;
    const bool stay = on_collision == OnCollision::stay || sweep >= sweeps_of_shortening;
    for (const Collision& collision : collisions) {
      const Stencil& s = stencils[collision.stencil].stencil;
      for (int i = 0; i < s.size(); ++i) {
        const Index v = s.v[i];
        if (p.col(v).isZero(0)) continue;
        scale[v] = stay ? 0 : std::min(scale[v], collision.time);
        changing[v] = 1;
      }
    }
    for (Index v = 0; v < static_cast<Index>(changing.size()); ++v) {
      if (changing[v]) p.col(v) *= scale[v];
      scale[v] = 1;
    }
    changed.swap(changing);
    std::fill(changing.begin(), changing.end(), std::uint8_t{0});
  }
}

}  // namespace unsnarl
