#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "contact/ccd.h"
#include "contact/contact_candidates.h"
#include "contact/sheet_gaps.h"
#include "energy/ipc_barrier.h"
#include "geometry/block_list.h"
#include "recover/recover_options.h"
#include "scene/patch.h"

namespace unsnarl {

/// How close the primitives of a stencil may come, and how far its barrier may reach.
struct ContactRule {
  BarrierStencil stencil;
  double reach = 0;               ///< the activation distance never exceeds this
  double distance = 0;            ///< at the positions where its vertices' bounds start
  Vec3 direction = Vec3::Zero();  ///< of the shortest way there (Closest::direction)
  bool closed = false;            ///< closer than it should be
  bool neighbours = false;        ///< near along the surface: min_gap is not asked of them
  bool own_altitude = false;      ///< corner of a face against the opposite edge: keeps the face from being squeezed
};

struct ContactRuleOptions {
  double min_gap = 0;  ///< wanted distance, a length
  /// Primitives up to this far apart along the edges at rest are neighbours. More than 1.41: in a grid of squares cut
  /// in two, points at a distance of 1 are up to 1.41 apart along the edges (unit: min_gap)
  double joined_gaps = 2;
  /// Primitives that are this near at rest are neighbours by OneSheet instead, unless one is in conflict: a length; 0:
  /// none are
  double one_sheet_within = 0;
  /// Neighbours keep at least this share of their rest distance, where that is less than min_gap (no unit)
  double kept_rest_share = 0.25;
  /// A face's own barrier, which keeps it from being squeezed, sets in below this share of its rest altitude (no unit)
  double altitude_share = 0.25;
  /// The barrier reaches this share of the rest distance: below 1, so that a rest shape without contact has no energy
  /// (no unit)
  double reach_share = 0.5;
  /// The barrier of primitives that are no neighbours reaches at least this far (unit: min_gap)
  double reach_gaps = barrier_gaps;
  /// Mean edge length of the patch; 0: as if every vertex had edges of that length
  double h = 0;
  double roundoff = 0;         ///< length below which computed distances mean nothing
  std::function<bool()> stop;  ///< asked while rules are gathered; true: WorkStopped is thrown. May be empty
};

/// Gathers the close stencils of a patch with their rules.
///
/// Separation of a stencil:
/// - min_gap, in general.
/// - Neighbours (primitives of triangles that share a vertex, or that are at most joined_gaps min_gap apart along the
///   edges at rest, or of one sheet) keep at least a share of their rest distance if that is less, unless their
///   triangles intersect each other at rest.
/// - No stencil has to keep more than half its present distance: faces that were shrunk below min_gap can grow again,
///   and stencils that end too close are opened last.
/// A stencil without distance at rest whose triangles do not intersect there (around zero-area faces) has no rule, nor
/// has one whose triangles all pass through each other.
class ContactRules {
 public:
  /// pairs: those of triangles that intersect at rest. The patch must outlive this.
  ContactRules(const Patch& patch, std::span<const IntersectingPair> pairs, const ContactRuleOptions& options);

  /// The share of h that counts at each vertex where the edges are as long as at x: less than 1 where they are short.
  std::vector<double> shares_of_h(const Positions& x) const;

  /// Rules for all stencils with a moving vertex that may be closer than their activation distance while every vertex
  /// keeps to its bounds. That distance is `activation` times the share of h that counts there, or the stencil's reach,
  /// whichever is less (own altitudes: the reach), but never too close to the separation.
  void gather(const Positions& x, double activation, const MotionBounds& bounds, std::span<const std::uint8_t> moves,
              BlockList<ContactRule>& rules);

  /// Gathers the rules of stencils at `vertices` again, after these vertices got new bounds that start at x. The cost
  /// grows with their number. `from`: where each vertex's bounds start; activation distances as before. Returns false
  /// where they are more than the limit: they have to be gathered again, with other bounds.
  bool gather_around(std::span<const Index> vertices, const Positions& from, const Positions& x,
                     const MotionBounds& bounds, BlockList<ContactRule>& rules, const ListLimit& limit = {});

  /// Stencils that are close, own altitudes apart.
  struct Close {
    double least = std::numeric_limits<double>::infinity();  ///< the least distance
    Index closed = 0;                                        ///< how many are closer than they should be
  };
  /// Measures all stencils with a moving vertex that would have a rule if their vertices might go `around`, a length,
  /// from x.
  Close measure(const Positions& x, double around, std::span<const std::uint8_t> moves);

  const ContactCandidates& candidates() const { return candidates_; }
  const ContactRuleOptions& options() const { return options_; }

 private:
  /// Adds the rules of altitudes with a moving vertex.
  void add_altitudes(const Positions& from, const Positions& x, const MotionBounds& bounds,
                     std::span<const std::uint8_t> moves, BlockList<ContactRule>& rules) const;
  bool are_neighbours(const Stencil& stencil, double rest_distance) const;
  /// Lists the neighbours by OneSheet.
  void find_sheets();
  /// Flags of the two primitives: a triangle there intersects another one at rest.
  std::array<bool, 2> in_conflict(const Stencil& stencil) const;
  /// Whether triangles t at the one primitive and u at the other are a pair for which is_wanted(t, u).
  template <class IsWanted>
  bool any_pair(const Stencil& stencil, IsWanted&& is_wanted) const;
  /// Whether a triangle at the one primitive intersects one at the other at rest.
  bool intersect_at_rest(const Stencil& stencil) const;
  /// Whether all triangles at the one primitive pass through all at the other.
  bool pass(const Stencil& stencil) const;
  /// Rule of a stencil that is at x now, within the bounds it was found with; false where there is none or it cannot
  /// come that close.
  bool rule_of(const NearStencil& near, const Positions& x, ContactRule& rule) const;
  /// The corners of triangles [begin, end) that move against their opposite edges.
  void add_altitudes_of(const Positions& from, const Positions& x, const MotionBounds& bounds,
                        std::span<const std::uint8_t> moves, Index begin, Index end,
                        std::vector<ContactRule>& rules) const;

  const Patch& patch_;
  std::vector<Edge> pairs_;                // ascending, as are the triangles of each
  std::vector<std::uint8_t> in_conflict_;  // per triangle: it intersects another one at rest
  ContactRuleOptions options_;
  ContactCandidates candidates_;
  std::vector<std::uint8_t> vertex_in_conflict_, edge_in_conflict_;  // one flag each: a triangle there is in conflict
  IndexLists joined_;  // per vertex: those within joined_gaps along the edges, ascending; empty lists where none is
  std::vector<std::array<Index, 3>> of_one_sheet_;     // kind and primitives of stencils, ascending
  std::vector<std::array<double, 3>> rest_altitudes_;  // of the active triangles; 0 where corners are equal
  std::vector<double> radius_;         // per vertex, of the last gather(): see ContactCandidates::gather
  std::vector<std::uint8_t> is_anew_;  // per vertex
};

}  // namespace unsnarl
