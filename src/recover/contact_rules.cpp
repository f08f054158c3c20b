#include "recover/contact_rules.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>

#include "contact/stop_check.h"
#include "geometry/parallel_lists.h"
#include "mesh/vertices_within.h"

namespace unsnarl {
namespace {

/// The barrier sets in at this distance at least, so that it has a width (unit: separations of the stencil)
constexpr double least_activation = 1.5;

/// At a vertex, h counts as no more than this many of its longest edge: parts much finer than the others, or shrunk on
/// the way, would list and push apart everything that is within many edges [E208] (unit: edges)
constexpr double most_edges = 6;

/// Corner k of a triangle against the opposite edge.
Stencil altitude_of(const Triangle& f, int k) {
  return {StencilKind::vertex_edge, {f[k], f[(k + 1) % 3], f[(k + 2) % 3], -1}};
}

/// Kind and primitives of a stencil, whichever edge comes first.
std::array<Index, 3> key_of(const Stencil& s) {
  auto [first, second] = s.primitives;
  if (s.kind == StencilKind::edge_edge && second < first) std::swap(first, second);
  return {static_cast<Index>(s.kind), first, second};
}

}  // namespace

ContactRules::ContactRules(const Patch& patch, std::span<const IntersectingPair> pairs,
                           const ContactRuleOptions& options)
    : patch_(patch),
      in_conflict_(patch.triangles.size(), 0),
      options_(options),
      candidates_(patch.triangles, static_cast<Index>(patch.rest.cols())),
      vertex_in_conflict_(patch.rest.cols(), 0),
      edge_in_conflict_(candidates_.edges().edges.size(), 0),
      joined_(vertices_within(patch.rest, candidates_.edges(), options.joined_gaps * options.min_gap)),
      rest_altitudes_(static_cast<std::size_t>(patch.active_count)) {
  for (Index t = 0; t < patch.active_count; ++t) {
    const Triangle& f = patch.triangles[t];
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
    for (int k = 0; k < 3; ++k) rest_altitudes_[t][k] = std::sqrt(squared_distance(altitude_of(f, k), patch.rest));
  }
  for (const IntersectingPair& pair : pairs) {
    pairs_.push_back({std::min(pair.a, pair.b), std::max(pair.a, pair.b)});
    in_conflict_[pair.a] = in_conflict_[pair.b] = 1;
  }
  std::sort(pairs_.begin(), pairs_.end());
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    if (!in_conflict_[t]) continue;
    for (Index v : patch.triangles[t]) vertex_in_conflict_[v] = 1;
    for (Index e : candidates_.edges().edges_of_triangle[t])
      if (e >= 0) edge_in_conflict_[e] = 1;
  }
  if (options_.one_sheet_within > 0) find_sheets();
}

void ContactRules::find_sheets() {
  MotionBounds still;
  still.reset(static_cast<Index>(patch_.rest.cols()));
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(patch_.rest.cols()), 1);
  const std::vector<double> radius(all.size(), options_.one_sheet_within);
  const auto triangle_at = [&](const Stencil& s, int side) {
    if (s.kind == StencilKind::edge_edge) return candidates_.edges().triangles_of_edge[s.primitives[side]][0];
    return side == 0 ? candidates_.triangles_of_vertex()[s.primitives[0]][0] : s.primitives[1];
  };
  struct Asked {
    Index first, second;  // triangles at the two primitives
    StencilKind kind;
    std::array<Index, 2> primitives;
    bool operator<(const Asked& other) const {
      return std::tie(first, second, kind, primitives) <
             std::tie(other.first, other.second, other.kind, other.primitives);
    }
  };
  std::vector<Asked> asked;
  const auto ask = [&](const NearStencil& near, Asked& item) {
    const Stencil& s = near.stencil;
    if (in_conflict(s) != std::array{false, false} || candidates_.are_neighbours(s) || pass(s)) return false;
    item = {triangle_at(s, 0), triangle_at(s, 1), s.kind, s.primitives};
    return true;
  };
  candidates_.gather(patch_.rest, radius, still, all, ask, asked, options_.stop);
  std::sort(asked.begin(), asked.end());
  OneSheet one_sheet(patch_.triangles, patch_.rest, candidates_.edges(), options_.min_gap);
  for (const auto& [first, second, kind, primitives] : asked) {
    end_long_work_if(options_.stop, asked.size());
    const Stencil s = candidates_.stencil_of(kind, primitives);
    if (one_sheet.holds(s, first, second)) of_one_sheet_.push_back(key_of(s));
  }
  std::sort(of_one_sheet_.begin(), of_one_sheet_.end());
}

std::vector<double> ContactRules::shares_of_h(const Positions& x) const {
  std::vector<double> longest(static_cast<std::size_t>(x.cols()), 0), shares(longest.size(), 1);
  if (!(options_.h > 0)) return shares;
  for (const Edge& e : candidates_.edges().edges) {
    const double length = (x.col(e[1]) - x.col(e[0])).norm();
    for (const Index v : e) longest[v] = std::max(longest[v], length);
  }
  for (std::size_t v = 0; v < shares.size(); ++v) shares[v] = std::min(1.0, most_edges * longest[v] / options_.h);
  return shares;
}

void ContactRules::gather(const Positions& x, double activation, const MotionBounds& bounds,
                          std::span<const std::uint8_t> moves, BlockList<ContactRule>& rules) {
  rules.clear();
  const double least = std::min(activation, options_.reach_gaps * options_.min_gap);
  radius_ = shares_of_h(x);
  for (double& radius : radius_) radius = std::max(least, activation * radius);
  const auto make = [&](const NearStencil& near, ContactRule& rule) { return rule_of(near, x, rule); };
  candidates_.gather(x, radius_, bounds, moves, make, rules, options_.stop);
  add_altitudes(x, x, bounds, moves, rules);
}

bool ContactRules::gather_around(std::span<const Index> vertices, const Positions& from, const Positions& x,
                                 const MotionBounds& bounds, BlockList<ContactRule>& rules, const ListLimit& limit) {
  is_anew_.assign(static_cast<std::size_t>(x.cols()), 0);
  for (Index v : vertices) is_anew_[v] = 1;
  rules.erase_if([&](const ContactRule& rule) {
    const Stencil& s = rule.stencil.stencil;
    return std::any_of(s.v.begin(), s.v.begin() + s.size(), [&](Index v) { return is_anew_[v] != 0; });
  });
  const auto make = [&](const NearStencil& near, ContactRule& rule) { return rule_of(near, x, rule); };
  if (!candidates_.gather_around(vertices, from, radius_, bounds, make, rules, options_.stop, limit)) return false;
  add_altitudes(from, x, bounds, is_anew_, rules);
  return true;
}

ContactRules::Close ContactRules::measure(const Positions& x, double around, std::span<const std::uint8_t> moves) {
  radius_.assign(static_cast<std::size_t>(x.cols()), 0);
  MotionBounds bounds;
  bounds.reset(static_cast<Index>(x.cols()));
  bounds.around.assign(radius_.size(), around);
  std::atomic<double> least{Close{}.least};
  std::atomic<Index> closed{0};
  std::vector<ContactRule> none;
  const auto count = [&](const NearStencil& near, ContactRule& rule) {
    if (!rule_of(near, x, rule)) return false;
    for (double now = least; rule.distance < now && !least.compare_exchange_weak(now, rule.distance);) {
    }
    if (rule.closed) ++closed;
    return false;
  };
  candidates_.gather(x, radius_, bounds, moves, count, none, options_.stop);
  return {least, closed};
}

void ContactRules::add_altitudes(const Positions& from, const Positions& x, const MotionBounds& bounds,
                                 std::span<const std::uint8_t> moves, BlockList<ContactRule>& rules) const {
  std::vector<ContactRule> added;
  gather_in_chunks(patch_.active_count, added, [&](Index begin, Index end, std::vector<ContactRule>& list) {
    add_altitudes_of(from, x, bounds, moves, begin, end, list);
  });
  for (const ContactRule& rule : added) rules.push_back(rule);
}

bool ContactRules::are_neighbours(const Stencil& s, double rest_distance) const {
  if (candidates_.are_neighbours(s)) return true;
  if (rest_distance <= options_.one_sheet_within && in_conflict(s) == std::array{false, false})
    return std::binary_search(of_one_sheet_.begin(), of_one_sheet_.end(), key_of(s));
  const int first = s.kind == StencilKind::edge_edge ? 2 : 1;
  for (int i = 0; i < first; ++i)
    for (int j = first; j < s.size(); ++j)
      if (std::binary_search(joined_[s.v[i]].begin(), joined_[s.v[i]].end(), s.v[j])) return true;
  return false;
}

std::array<bool, 2> ContactRules::in_conflict(const Stencil& s) const {
  const auto [first, second] = s.primitives;
  const bool is_edge = s.kind == StencilKind::edge_edge;
  return {(is_edge ? edge_in_conflict_[first] : vertex_in_conflict_[first]) != 0,
          (is_edge ? edge_in_conflict_[second] : in_conflict_[second]) != 0};
}

template <class IsWanted>
bool ContactRules::any_pair(const Stencil& s, IsWanted&& is_wanted) const {
  const auto [first, second] = s.primitives;
  const bool is_edge = s.kind == StencilKind::edge_edge;
  const IndexLists& of_edge = candidates_.edges().triangles_of_edge;
  for (const Index t : is_edge ? of_edge[first] : candidates_.triangles_of_vertex()[first])
    for (const Index u : is_edge ? of_edge[second] : std::span<const Index>(&second, 1))
      if (is_wanted(t, u)) return true;
  return false;
}

bool ContactRules::intersect_at_rest(const Stencil& s) const {
  return any_pair(s, [&](Index t, Index u) {
    return std::binary_search(pairs_.begin(), pairs_.end(), Edge{std::min(t, u), std::max(t, u)});
  });
}

bool ContactRules::pass(const Stencil& s) const {
  const Passing passing = patch_.passing();
  return passing.has_parts() && !any_pair(s, [&](Index t, Index u) { return passing.meet(patch_.triangles, t, u); });
}

bool ContactRules::rule_of(const NearStencil& near, const Positions& x, ContactRule& rule) const {
  const Stencil& s = near.stencil;
  if (pass(s)) return false;
  rule.stencil.stencil = s;
  rule.distance = near.distance;
  rule.direction = near.direction;
  const double rest_distance = std::sqrt(squared_distance(s, patch_.rest));
  const auto [first_in_conflict, second_in_conflict] = in_conflict(s);
  const bool neighbours = are_neighbours(s, rest_distance);
  const bool conflict = neighbours ? first_in_conflict && second_in_conflict && intersect_at_rest(s)
                                   : first_in_conflict || second_in_conflict;
  rule.neighbours = neighbours && !conflict;
  double separation = options_.min_gap;
  rule.reach = std::max(options_.reach_share * rest_distance, options_.reach_gaps * options_.min_gap);
  if (rule.neighbours) {
    if (rest_distance <= options_.roundoff) return false;
    separation = std::min(separation, options_.kept_rest_share * rest_distance);
    rule.reach = options_.reach_share * rest_distance;
  } else if (!neighbours && conflict) {
    rule.reach = std::numeric_limits<double>::infinity();
  }
  rule.closed = false;
  if (!(near.least_distance > 2 * separation)) {  // else x, which is within the bounds, is farther
    const double distance = std::sqrt(squared_distance(s, x));
    if (!(distance > 0)) return false;
    rule.closed = !(distance > separation);
    separation = std::min(0.5 * distance, separation);
  }
  rule.stencil.separation = separation;
  rule.stencil.activation =
      std::max(std::min(radius_of(s, radius_), rule.reach), least_activation * rule.stencil.separation);
  if (near.least_distance > rule.stencil.activation) return false;
  if (s.kind == StencilKind::edge_edge) {
    const double u2 = (patch_.rest.col(s.v[1]) - patch_.rest.col(s.v[0])).squaredNorm();
    const double v2 = (patch_.rest.col(s.v[3]) - patch_.rest.col(s.v[2])).squaredNorm();
    rule.stencil.mollifier_threshold = mollifier_threshold(u2, v2);
  }
  return true;
}

void ContactRules::add_altitudes_of(const Positions& from, const Positions& x, const MotionBounds& bounds,
                                    std::span<const std::uint8_t> moves, Index begin, Index end,
                                    std::vector<ContactRule>& rules) const {
  for (Index t = begin; t < end; ++t) {
    const Triangle& f = patch_.triangles[t];
    if (!moves[f[0]] && !moves[f[1]] && !moves[f[2]]) continue;
    for (int k = 0; k < 3; ++k) {
      ContactRule rule;
      const Stencil s = altitude_of(f, k);
      const double rest_distance = rest_altitudes_[t][k];
      if (rest_distance <= options_.roundoff) continue;  // no area at rest: it needs none
      rule.reach = options_.altitude_share * rest_distance;
      const Closest at = closest(s, from);
      rule.distance = at.distance;
      rule.direction = at.direction;
      if (least_distance(s, from, bounds, at.direction) > rule.reach) continue;
      const double distance = std::sqrt(squared_distance(s, x));
      if (!(distance > 0)) continue;
      rule.stencil.stencil = s;
      rule.stencil.activation = rule.reach;
      rule.own_altitude = true;
      rules.push_back(rule);
    }
  }
}

}  // namespace unsnarl
