#pragma once

#include <span>
#include <vector>

#include "contact/ccd.h"
#include "energy/ipc_barrier.h"
#include "recover/contact_rules.h"
#include "recover/moving_vertices.h"

namespace unsnarl {

/// The contact stencils that a solver may meet on its way. They are gathered again only around vertices that moved too
/// far since the last time. h: the patch's edge length. The rules must outlive this.
class ContactList {
 public:
  ContactList(ContactRules& rules, double h) : rules_(rules), h_(h) {}

  /// Lists the stencils that may be closer than `activation` while no moving vertex goes far from x.
  void gather(const Positions& x, double activation, const MovingVertices& moving);
  /// Extends the list to what the vertices may meet in the step p from x; sets in_the_way(). A step that may meet too
  /// much is shortened. Returns the share of it that is left.
  double follow(const Positions& x, Positions& p, const MovingVertices& moving);
  /// Replaces `near` by the stencils of the list that may be active at x.
  void pick_near(const Positions& x, const MovingVertices& moving, std::vector<BarrierStencil>& near);

  /// Gives the lists back; the next call is gather().
  void clear();

  /// Stencils that may collide in the step of follow().
  std::span<const SeparatedStencil> in_the_way() const { return in_the_way_; }
  const std::function<bool()>& stop() const { return rules_.options().stop; }
  /// Stencils whose distance was no more than round-off where they were gathered.
  std::vector<Stencil> touching() const;

 private:
  /// Gathers around leaving_ what the step p from x may meet; shortens it as follow() says.
  double gather_around_leaving(const Positions& x, Positions& p);

  ContactRules& rules_;
  double h_;
  BlockList<ContactRule> list_;
  Positions gathered_at_;        // where each vertex was when the list was last gathered around it
  MotionBounds bounds_;          // where the list allows each vertex to be
  std::vector<double> margins_;  // per vertex: how far from its step it may be
  std::vector<Index> leaving_;
  std::vector<double> travelled_, travel_;  // per vertex: length of its way since gathered_at_; of the coming step
  std::vector<SeparatedStencil> in_the_way_;
};

}  // namespace unsnarl
