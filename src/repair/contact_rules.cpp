#include "repair/contact_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/parallel_lists.h"

namespace unsnarl {
namespace {

/// The barrier sets in at this many separations at least.
constexpr double least_activation = 1.5;

}  // namespace

ContactRules::ContactRules(const Patch& patch, std::vector<std::uint8_t> in_conflict, const ContactRuleOptions& options)
    : patch_(patch),
      in_conflict_(std::move(in_conflict)),
      options_(options),
      candidates_(patch.triangles, static_cast<Index>(patch.rest.cols())),
      vertex_in_conflict_(patch.rest.cols(), 0),
      edge_in_conflict_(candidates_.edges().edges.size(), 0) {
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    if (!in_conflict_[t]) continue;
    for (Index v : patch.triangles[t]) vertex_in_conflict_[v] = 1;
    for (Index e : candidates_.edges().edges_of_triangle[t])
      if (e >= 0) edge_in_conflict_[e] = 1;
  }
}

void ContactRules::gather(const Positions& x, double activation, const MotionBounds& bounds,
                          std::span<const std::uint8_t> moves, std::vector<ContactRule>& rules) {
  candidates_.gather(x, activation, bounds, moves, stencils_);
  constexpr Index chunk = 1024;  // stencils or triangles a task
  gather_in_chunks(static_cast<Index>(stencils_.size()), chunk, rules,
                   [&](Index begin, Index end, std::vector<ContactRule>& list) {
                     for (Index k = begin; k < end; ++k) {
                       ContactRule rule;
                       if (rule_of(stencils_[k], activation, rule)) list.push_back(rule);
                     }
                   });
  gather_in_chunks(patch_.active_count, chunk, altitudes_,
                   [&](Index begin, Index end, std::vector<ContactRule>& list) {
                     add_altitudes(x, bounds, moves, begin, end, list);
                   });
  rules.insert(rules.end(), altitudes_.begin(), altitudes_.end());
}

bool ContactRules::rule_of(const NearStencil& near, double activation, ContactRule& rule) const {
  constexpr double mollifier_sin2 = 1e-3;  // as in IPC
  const Stencil& s = near.stencil;
  if (!(near.distance > 0)) return false;
  rule.stencil.stencil = s;
  rule.distance = near.distance;
  rule.rest_distance = std::sqrt(squared_distance(s, patch_.rest));
  const auto [first, second] = s.primitives;
  const bool is_edge = s.kind == StencilKind::edge_edge;
  const bool first_in_conflict = (is_edge ? edge_in_conflict_[first] : vertex_in_conflict_[first]) != 0;
  const bool second_in_conflict = (is_edge ? edge_in_conflict_[second] : in_conflict_[second]) != 0;
  const bool neighbours = candidates_.are_neighbours(s);
  const bool conflict = neighbours ? first_in_conflict && second_in_conflict : first_in_conflict || second_in_conflict;
  double separation = options_.min_gap;
  rule.reach = std::max(options_.reach_share * rule.rest_distance, options_.reach_gaps * options_.min_gap);
  if (neighbours && !conflict) {
    if (rule.rest_distance <= options_.roundoff) return false;
    separation = std::min(separation, options_.neighbour_share * rule.rest_distance);
    rule.reach = options_.reach_share * rule.rest_distance;
  } else if (!neighbours && conflict) {
    rule.reach = std::numeric_limits<double>::infinity();
  }
  rule.closed = !(rule.distance > separation);
  rule.stencil.separation = rule.closed ? 0.5 * rule.distance : separation;
  rule.stencil.activation = std::max(std::min(activation, rule.reach), least_activation * rule.stencil.separation);
  if (near.least_distance > rule.stencil.activation) return false;
  if (s.kind == StencilKind::edge_edge) {
    const double u2 = (patch_.rest.col(s.v[1]) - patch_.rest.col(s.v[0])).squaredNorm();
    const double v2 = (patch_.rest.col(s.v[3]) - patch_.rest.col(s.v[2])).squaredNorm();
    rule.stencil.mollifier_threshold = mollifier_sin2 * u2 * v2;
  }
  return true;
}

void ContactRules::add_altitudes(const Positions& x, const MotionBounds& bounds, std::span<const std::uint8_t> moves,
                                 Index begin, Index end, std::vector<ContactRule>& rules) const {
  for (Index t = begin; t < end; ++t) {
    const Triangle& f = patch_.triangles[t];
    if (!moves[f[0]] && !moves[f[1]] && !moves[f[2]]) continue;
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
    for (int k = 0; k < 3; ++k) {
      ContactRule rule;
      const Stencil s{StencilKind::vertex_edge, {f[k], f[(k + 1) % 3], f[(k + 2) % 3], -1}};
      rule.rest_distance = std::sqrt(squared_distance(s, patch_.rest));
      if (rule.rest_distance <= options_.roundoff) continue;  // without area at rest: it may stay so
      rule.reach = options_.altitude_share * rule.rest_distance;
      const Closest at = closest(s, x);
      rule.distance = at.distance;
      if (!(rule.distance > 0) || least_distance(s, x, bounds, at.direction) > rule.reach) continue;
      rule.stencil.stencil = s;
      const double floor = options_.altitude_floor * rule.rest_distance;
      rule.closed = !(rule.distance > floor);
      rule.stencil.separation = rule.closed ? 0.5 * rule.distance : floor;
      rule.stencil.activation = std::max(rule.reach, least_activation * rule.stencil.separation);
      rule.own_altitude = true;
      rules.push_back(rule);
    }
  }
}

}  // namespace unsnarl
