#include "recover/open_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/stop_check.h"
#include "geometry/predicates.h"

namespace unsnarl {
namespace {

/// Longest motion of a vertex in one round: beyond it, a linear model no longer says where nearly touching primitives
/// meet (unit: smallest gap at the vertex)
constexpr double most_growth = 10;
constexpr int opening_sweeps = 10;  ///< Sweeps over the gaps in one round, at most (unit: sweeps)

/// The distance wanted for a stencil. `beyond`: what the whole target is more than min_gap.
double target_of(const ContactRule& rule, double target, double beyond) {
  const double least = rule.stencil.separation + std::min(rule.stencil.separation, beyond);
  target = std::min(rule.neighbours ? beyond : target, rule.stencil.activation);
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

/// A gap that must become `missing` wider (negative: it may become narrower by that). To first order, displacements p
/// widen it by the sum of weights[i] * direction . p_i.
struct Widening {
  Stencil stencil;
  Vec3 direction;  // of length 1
  std::array<double, 4> weights;
  double missing = 0;
  double squared_weights = 0;  // of the vertices that move
};

Widening widening_of(const ContactRule& rule, double missing, const Positions& x, double roundoff,
                     std::span<const std::uint8_t> moves) {
  Widening result;
  result.stencil = rule.stencil.stencil;
  const Stencil& s = result.stencil;
  const Closest at = closest(s, x);
  result.direction = rule.distance > roundoff ? at.direction : exact_direction(s, x);
  result.missing = missing;
  for (int i = 0; i < s.size(); ++i) {
    result.weights[i] = moves[s.v[i]] ? at.weights[i] : 0;
    result.squared_weights += result.weights[i] * result.weights[i];
  }
  return result;
}

/// Changes the displacements of a gap's vertices as little as makes it wide enough. Returns false if it was already.
bool widen(const Widening& gap, Positions& p) {
  double change = 0;
  for (int i = 0; i < gap.stencil.size(); ++i) change += gap.weights[i] * gap.direction.dot(p.col(gap.stencil.v[i]));
  if (!(change < gap.missing)) return false;
  const double push = (gap.missing - change) / gap.squared_weights;
  for (int i = 0; i < gap.stencil.size(); ++i) p.col(gap.stencil.v[i]) += push * gap.weights[i] * gap.direction;
  return true;
}

}  // namespace

void open_gaps(Positions& x, ContactRules& rules, const OrientedFaces& oriented, EmbeddingGuard& guard,
               std::span<const std::uint8_t> moves, const OpenGapsOptions& options) {
  const double roundoff = rules.options().roundoff, beyond = options.target - rules.options().min_gap;
  double target = 0;  // of the last round
  BlockList<ContactRule> close;
  std::vector<SeparatedStencil> filter;
  std::vector<Widening> gaps;
  MotionBounds bounds;
  bounds.reset(static_cast<Index>(x.cols()));
  std::vector<double> step_cap = rules.shares_of_h(x);
  for (double& share : step_cap) share *= options.step_cap;
  for (std::size_t v = 0; v < moves.size(); ++v) bounds.around[v] = moves[v] ? step_cap[v] : 0;
  std::vector<double> cap(static_cast<std::size_t>(x.cols())), length(cap.size());  // of the vertices' displacements
  Positions p(3, x.cols());
  Positions safe;
  std::vector<Index> moved;  // in the last round
  for (int round = 0;; ++round) {
    if (options.stop && options.stop()) return;
    std::vector<Widening>().swap(gaps);
    if (target < options.target) {
      target = std::min(options.target, target + 2 * options.step_cap);
      rules.gather(x, target, bounds, moves, close);
    } else {
      rules.gather_around(moved, x, x, bounds, close);
    }
    gaps.reserve(close.size());
    bool any_narrow = false;
    for (const ContactRule& rule : close) {
      const double missing = target_of(rule, target, beyond) - rule.distance;
      any_narrow |= missing > 0;
      const Widening gap = widening_of(rule, missing, x, roundoff, moves);
      if (gap.squared_weights > 0) gaps.push_back(gap);
    }
    if (round == options.max_rounds || (!any_narrow && target == options.target)) return;
    cap = step_cap;
    for (const ContactRule& rule : close) {
      const Stencil& s = rule.stencil.stencil;
      for (int i = 0; i < s.size(); ++i) cap[s.v[i]] = std::min(cap[s.v[i]], most_growth * rule.distance);
    }
    p.setZero();
    bool changed = true;
    for (int sweep = 0; changed && sweep < opening_sweeps; ++sweep) {
      changed = false;
      end_long_work_if(options.stop, gaps.size());
      for (const Widening& gap : gaps) changed |= widen(gap, p);
      for (Index v = 0; v < x.cols(); ++v) {
        const double wanted = p.col(v).norm();
        if (wanted > cap[v]) p.col(v) *= cap[v] / wanted;
      }
      changed |= oriented.project(x, moves, p);
    }
    // All displacements are shortened by one factor: with several, a face that is squeezed to a needle may flip.
    double factor = 1;
    for (Index v = 0; v < x.cols(); ++v) {
      const double wanted = p.col(v).norm();
      if (wanted > step_cap[v]) factor = std::min(factor, step_cap[v] / wanted);
    }
    p *= factor;
    // CCD cannot use distances of the order of round-off; the exact guard checks these.
    bool doubtful = false;
    filter.clear();
    for (Index v = 0; v < x.cols(); ++v) length[v] = p.col(v).norm();
    for (const ContactRule& rule : close) {
      doubtful |= rule.distance <= roundoff;
      const double left = rule.distance - approach(rule.stencil.stencil, length);
      if (rule.distance > roundoff && left <= rule.stencil.separation + roundoff)
        filter.push_back({rule.stencil.stencil, rule.stencil.separation});
    }
    filter_step(filter, oriented, x, p, OnCollision::shorten, {.stop = options.stop});
    safe = x;
    x += p;
    if (doubtful) guard.roll_back(x, safe);
    moved.clear();
    for (Index v = 0; v < x.cols(); ++v)
      if (x.col(v) != safe.col(v)) moved.push_back(v);
  }
}

}  // namespace unsnarl
