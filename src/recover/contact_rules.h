#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "contact/ccd.h"
#include "contact/contact_candidates.h"
#include "energy/ipc_barrier.h"
#include "recover/recover_options.h"
#include "scene/patch.h"

namespace unsnarl {

/// How close the primitives of a stencil may come, and how far its barrier may reach.
struct ContactRule {
  BarrierStencil stencil;
  double reach = 0;  ///< the activation distance never exceeds this
  double rest_distance = 0;
  double distance = 0;            ///< where its vertices' bounds start
  Vec3 direction = Vec3::Zero();  ///< of the shortest way there (Closest::direction)
  bool closed = false;            ///< closer than it should be
  bool neighbours = false;        ///< of one sheet, of which min_gap is not asked
  bool own_altitude = false;      ///< a corner of a face against the opposite edge: keeps the face from being squeezed
};

struct ContactRuleOptions {
  double min_gap = 0;  ///< wanted distance, a length
  /// In min_gap: primitives up to this far apart along the edges at rest are neighbours. In a grid of squares cut in
  /// two, what is min_gap apart is up to 1.41 apart along the edges. Other values were not tried.
  double joined_gaps = 2;
  /// Share of the rest distance that neighbours keep at least where it is below min_gap, and of its rest altitude below
  /// which a face's own barrier sets in.
  double rest_share = 0.25;
  /// The barrier reaches this share of the rest distance: below 1, so that a rest shape without contact has no energy.
  double reach_share = 0.5;
  double reach_gaps = barrier_gaps;  ///< and at least this many min_gap for what is no neighbour
  double roundoff = 0;               ///< length below which computed distances mean nothing
  std::function<bool()> stop;        ///< asked while rules are gathered, which true ends by WorkStopped; may be empty
};

/// Gathers the close stencils of a patch with their rules.
///
/// The separation is min_gap. Neighbours (primitives of triangles that share a vertex, or that are two min_gap apart
/// along the edges at rest) that are closer at rest need only keep a share of their rest distance, unless their
/// triangles intersect each other at rest. A stencil without distance at rest whose triangles do not intersect there
/// (around zero-area faces) has no rule. None has to keep more than half its present distance: what was shrunk grows
/// again where its faces are smaller than min_gap, and what ends too close is opened last. (Keeping all of min_gap from
/// where it is reached, soft parts wound around an anchor end 1.6 times as far, stretched to 15 times their length.)
class ContactRules {
 public:
  /// pairs: those of triangles that intersect at rest. The patch must outlive this.
  ContactRules(const Patch& patch, std::span<const IntersectingPair> pairs, const ContactRuleOptions& options);

  /// Rules for all stencils with a moving vertex that are, or may come while every vertex keeps to its bounds, closer
  /// than `activation` and their reach (own altitudes: than their reach): that is their activation distance, unless it
  /// is too close to their separation.
  void gather(const Positions& x, double activation, const MotionBounds& bounds, std::span<const std::uint8_t> moves,
              std::vector<ContactRule>& rules);

  /// Replaces the rules of stencils with one of some `vertices`, after these were given new bounds that start at x; at
  /// a cost that follows their number. `from`: where each vertex's bounds start; activation as before.
  void gather_around(std::span<const Index> vertices, const Positions& from, const Positions& x, double activation,
                     const MotionBounds& bounds, std::vector<ContactRule>& rules);

  const ContactCandidates& candidates() const { return candidates_; }
  const ContactRuleOptions& options() const { return options_; }

 private:
  /// Adds the rules of stencils_ and of altitudes with a moving vertex.
  void add_rules(const Positions& from, const Positions& x, double activation, const MotionBounds& bounds,
                 std::span<const std::uint8_t> moves, std::vector<ContactRule>& rules);
  bool are_neighbours(const Stencil& stencil) const;
  /// Whether a triangle at the one primitive intersects one at the other at rest.
  bool intersect_at_rest(const Stencil& stencil) const;
  /// Rule of a stencil that is `distance` wide now; false where there is none or it cannot come that close.
  bool rule_of(const NearStencil& near, double distance, double activation, ContactRule& rule) const;
  /// The corners of triangles [begin, end) that move against their opposite edges.
  void add_altitudes(const Positions& from, const Positions& x, const MotionBounds& bounds,
                     std::span<const std::uint8_t> moves, Index begin, Index end,
                     std::vector<ContactRule>& rules) const;

  const Patch& patch_;
  std::vector<Edge> pairs_;                // ascending, as are the triangles of each
  std::vector<std::uint8_t> in_conflict_;  // per triangle: of a pair
  ContactRuleOptions options_;
  ContactCandidates candidates_;
  std::vector<std::uint8_t> vertex_in_conflict_, edge_in_conflict_;  // some triangle there is
  IndexLists joined_;  // per vertex: those within joined_gaps along the edges, ascending; empty lists where none is
  std::vector<std::array<double, 3>> rest_altitudes_;  // of the active triangles; 0 where corners are equal
  std::vector<NearStencil> stencils_;
  std::vector<ContactRule> added_;
  std::vector<std::uint8_t> is_anew_;  // per vertex
};

}  // namespace unsnarl
