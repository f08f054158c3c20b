#include "recover/open_gaps.h"

#include <algorithm>
#include <cmath>

#include "geometry/predicates.h"

namespace unsnarl {
namespace {

/// Computed differences point the right way only this many times above the round-off of a distance.
constexpr double direction_margin = 1e4;

/// The distance wanted for a stencil.
double target_of(const ContactRule& rule, double target) {
  const double least = 2 * rule.stencil.separation;
  return std::max(least, std::min(std::max(target, least), rule.reach));
}

/// Direction from the second primitive to the first by the exact side; zero where they are coplanar.
Vec3 exact_direction(const Stencil& s, const Positions& x) {
  if (s.kind == StencilKind::vertex_edge) return Vec3::Zero();
  const Vec3 a = x.col(s.v[0]), b = x.col(s.v[1]), c = x.col(s.v[2]), d = x.col(s.v[3]);
  const Vec3 n = s.kind == StencilKind::edge_edge ? Vec3((b - a).cross(d - c)) : Vec3((c - b).cross(d - b));
  const double length = n.norm();
  if (!(length > 0)) return Vec3::Zero();
  const int side = s.kind == StencilKind::edge_edge ? orient3d(a, b, c, d) : orient3d(b, c, d, a);
  return (side / length) * n;
}

}  // namespace

OpenGapsResult open_gaps(Positions& x, ContactRules& rules, const OrientedFaces& oriented, EmbeddingGuard& guard,
                         std::span<const std::uint8_t> moves, const OpenGapsOptions& options) {
  OpenGapsResult result;
  const double roundoff = rules.options().roundoff;
  std::vector<ContactRule> close;
  std::vector<SeparatedStencil> filter;
  std::vector<int> pushes(static_cast<std::size_t>(x.cols()));
  MotionBounds bounds;
  bounds.reset(static_cast<Index>(x.cols()));
  for (std::size_t v = 0; v < moves.size(); ++v) bounds.around[v] = moves[v] ? options.step_cap : 0;
  Positions p(3, x.cols());
  Positions safe;
  for (;; ++result.rounds) {
    if (options.stop && options.stop()) return result;
    rules.gather(x, options.target, bounds, moves, close);
    p.setZero();
    std::fill(pushes.begin(), pushes.end(), 0);
    result.still_closed = 0;
    Index to_open = 0;
    for (const ContactRule& rule : close) {
      const Stencil& s = rule.stencil.stencil;
      const double target = target_of(rule, options.target);
      if (rule.distance >= 0.9 * target) continue;
      ++to_open;
      if (rule.distance < 0.5 * target) ++result.still_closed;
      const Closest at = closest(s, x);
      const Vec3 direction = rule.distance > direction_margin * roundoff ? at.direction : exact_direction(s, x);
      double denominator = 0;
      for (int i = 0; i < s.size(); ++i) {
        if (moves[s.v[i]]) denominator += at.weights[i] * at.weights[i];
      }
      if (!(denominator > 1e-6)) continue;
      const double push = (target - rule.distance) / denominator;
      for (int i = 0; i < s.size(); ++i) {
        if (!moves[s.v[i]] || at.weights[i] == 0) continue;
        p.col(s.v[i]) += push * at.weights[i] * direction;
        ++pushes[s.v[i]];
      }
    }
    if (to_open == 0 || result.rounds == options.max_rounds) return result;
    for (Index v = 0; v < x.cols(); ++v) {
      if (pushes[v] == 0) continue;
      p.col(v) /= pushes[v];
      const double length = p.col(v).norm();
      if (length > options.step_cap) p.col(v) *= options.step_cap / length;
    }
    // Distances of the order of round-off tell CCD nothing; there the exact guard checks.
    bool doubtful = false;
    filter.clear();
    for (const ContactRule& rule : close) {
      doubtful |= rule.distance <= direction_margin * roundoff;
      if (rule.distance > roundoff) filter.push_back({rule.stencil.stencil, rule.stencil.separation});
    }
    filter_step(filter, oriented, x, p, OnCollision::shorten);
    safe = x;
    x += p;
    if (doubtful) guard.roll_back(x, safe);
  }
}

}  // namespace unsnarl
