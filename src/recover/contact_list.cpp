#include "recover/contact_list.h"

#include <algorithm>
#include <cmath>

#include "contact/stop_check.h"
#include "geometry/block_list.h"

namespace unsnarl {
namespace {

/// A list of contacts holds while each vertex stays within this of the step it was about to make when the list was
/// gathered (unit: h)
constexpr double list_margin = 0.02;

/// A step is halved where its list would be longer: what grows from a point meets all of itself (unit: stencils a
/// vertex)
constexpr std::size_t most_a_vertex = 150;
/// The same where a gap is asked for everywhere, but of rules: within a wide gap are many stencils of one sheet, which
/// have none [E225] (unit: rules a vertex)
constexpr std::size_t most_rules_a_vertex = 40;
/// Lists of a few vertices may be so long all the same (unit: stencils)
constexpr std::size_t always_allowed = 20'000;
/// How often a step is halved at most (unit: times)
constexpr int most_halvings = 8;

}  // namespace

void ContactList::gather(const Positions& x, double activation, const MovingVertices& moving) {
  travelled_.assign(moving.moves.size(), 0);
  travel_.assign(moving.moves.size(), 0);
  gathered_at_ = x;
  bounds_.reset(static_cast<Index>(x.cols()));
  margins_ = rules_.shares_of_h(x);
  for (double& margin : margins_) margin *= list_margin * h_;
  for (Index v : moving.vertices) bounds_.around[v] = margins_[v];
  rules_.gather(x, activation, bounds_, moving.moves, list_);
}

void ContactList::clear() {
  list_.clear();
  std::vector<SeparatedStencil>().swap(in_the_way_);
}

double ContactList::gather_around_leaving(const Positions& x, Positions& p) {
  const bool has_wide_gap = rules_.options().one_sheet_within > 0;
  const std::size_t most_here = has_wide_gap ? most_rules_a_vertex : most_a_vertex;
  const ListLimit limit = {std::max(always_allowed, most_here * static_cast<std::size_t>(x.cols())), has_wide_gap};
  for (const Index v : leaving_) {
    gathered_at_.col(v) = x.col(v);
    bounds_.around[v] = margins_[v];
  }
  double share = 1;
  for (int halvings = 0;; ++halvings) {
    for (const Index v : leaving_) bounds_.along.col(v) = p.col(v);
    const ListLimit any;
    if (rules_.gather_around(leaving_, gathered_at_, x, bounds_, list_, halvings == most_halvings ? any : limit))
      return share;
    p *= 0.5;
    share *= 0.5;
  }
}

double ContactList::follow(const Positions& x, Positions& p, const MovingVertices& moving) {
  leaving_.clear();
  for (Index v : moving.vertices)
    if (!bounds_.allow(v, x.col(v) + p.col(v) - gathered_at_.col(v))) leaving_.push_back(v);
  const double share = leaving_.empty() ? 1 : gather_around_leaving(x, p);
  for (Index v : moving.vertices) {
    travelled_[v] = (x.col(v) - gathered_at_.col(v)).norm();
    travel_[v] = p.col(v).norm();
  }
  MotionBounds way;  // a vertex may stop at any point of its step
  way.reset(static_cast<Index>(x.cols()));
  way.along = p;
  gather_from_blocks(list_, in_the_way_, [&](std::span<const ContactRule> block, std::vector<SeparatedStencil>& list) {
    end_long_work_if(rules_.options().stop, list_.size());
    for (const ContactRule& rule : block) {
      const BarrierStencil& s = rule.stencil;
      const double left = rule.distance - approach(s.stencil, travelled_) - approach(s.stencil, travel_);
      const double needed = s.separation + rules_.options().roundoff;
      if (left > needed || least_distance(s.stencil, x, way, rule.direction) > needed) continue;
      list.push_back({s.stencil, s.separation});
    }
  });
  return share;
}

void ContactList::pick_near(const Positions& x, const MovingVertices& moving, std::vector<BarrierStencil>& near) {
  for (Index v : moving.vertices) travelled_[v] = (x.col(v) - gathered_at_.col(v)).norm();
  gather_from_blocks(list_, near, [&](std::span<const ContactRule> block, std::vector<BarrierStencil>& list) {
    end_long_work_if(rules_.options().stop, list_.size());
    for (const ContactRule& rule : block) {
      if (rule.distance - approach(rule.stencil.stencil, travelled_) < rule.stencil.activation)
        list.push_back(rule.stencil);
    }
  });
}

std::vector<Stencil> ContactList::touching() const {
  std::vector<Stencil> result;
  for (const ContactRule& rule : list_)
    if (!rule.own_altitude && !(rule.distance > rules_.options().roundoff)) result.push_back(rule.stencil.stencil);
  return result;
}

}  // namespace unsnarl
