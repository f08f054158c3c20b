#include "recover/contact_list.h"

#include <algorithm>
#include <cmath>

#include "contact/stop_check.h"
#include "geometry/parallel_lists.h"

namespace unsnarl {
namespace {

/// A list of contacts holds while each vertex stays within this of the step it was about to make when the list was
/// gathered (unit: h)
constexpr double list_margin = 0.02;

}  // namespace

void ContactList::gather(const Positions& x, double activation, const MovingVertices& moving) {
  activation_ = activation;
  travelled_.assign(moving.moves.size(), 0);
  travel_.assign(moving.moves.size(), 0);
  gathered_at_ = x;
  bounds_.reset(static_cast<Index>(x.cols()));
  for (Index v : moving.vertices) bounds_.around[v] = list_margin * h_;
  rules_.gather(x, activation, bounds_, moving.moves, list_);
}

void ContactList::follow(const Positions& x, const Positions& p, const MovingVertices& moving) {
  leaving_.clear();
  for (Index v : moving.vertices)
    if (!bounds_.allow(v, x.col(v) + p.col(v) - gathered_at_.col(v))) leaving_.push_back(v);
  if (!leaving_.empty()) {
    for (Index v : leaving_) {
      gathered_at_.col(v) = x.col(v);
      bounds_.along.col(v) = p.col(v);
      bounds_.around[v] = list_margin * h_;
    }
    rules_.gather_around(leaving_, gathered_at_, x, activation_, bounds_, list_);
  }
  for (Index v : moving.vertices) {
    travelled_[v] = (x.col(v) - gathered_at_.col(v)).norm();
    travel_[v] = p.col(v).norm();
  }
  MotionBounds way;  // a vertex may stop at any point of its step
  way.reset(static_cast<Index>(x.cols()));
  way.along = p;
  gather_in_chunks(
      static_cast<Index>(list_.size()), in_the_way_, [&](Index begin, Index end, std::vector<SeparatedStencil>& list) {
        end_long_work_if(rules_.options().stop, list_.size());
        for (Index k = begin; k < end; ++k) {
          const BarrierStencil& s = list_[k].stencil;
          const double left = list_[k].distance - approach(s.stencil, travelled_) - approach(s.stencil, travel_);
          const double needed = s.separation + rules_.options().roundoff;
          if (left > needed || least_distance(s.stencil, x, way, list_[k].direction) > needed) continue;
          list.push_back({s.stencil, s.separation});
        }
      });
}

void ContactList::pick_near(const Positions& x, const MovingVertices& moving, std::vector<BarrierStencil>& near) {
  for (Index v : moving.vertices) travelled_[v] = (x.col(v) - gathered_at_.col(v)).norm();
  gather_in_chunks(static_cast<Index>(list_.size()), near,
                   [&](Index begin, Index end, std::vector<BarrierStencil>& list) {
                     end_long_work_if(rules_.options().stop, list_.size());
                     for (Index k = begin; k < end; ++k) {
                       const ContactRule& rule = list_[k];
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
