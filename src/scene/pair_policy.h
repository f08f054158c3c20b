#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "mesh/components.h"
#include "scene/rigid_parts.h"
#include "unsnarl/intersections.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// No motion of the vertices parts two triangles that may stay for this reason.
bool is_obstruction(LeftReason reason);

/// Decides which intersecting pairs may stay, and why; nothing else does. (Pairs of FindOptions::allowed are none: no
/// search finds them.) A reason depends on the options and on what
/// never changes while vertices move: components, corners, and what is held.
class PairPolicy {
 public:
  /// `components` must outlive it.
  PairPolicy(const Components& components, Goal goal, bool each_component)
      : components_(&components), goal_(goal), each_component_(each_component) {}

  /// Vertices that do not move from where they are in `x`. `fixed`: one flag a welded vertex; empty: none.
  void hold(std::span<const std::uint8_t> fixed, const Positions& x);
  /// Parts that move as they are in `x`.
  void hold_shape(RigidParts parts, const Positions& x);
  /// From now on all pairs of this component may stay.
  void give_up(Index component);

  bool is_held(Index v) const { return !fixed_.empty() && fixed_[v]; }
  bool is_given_up(Index component) const { return !given_up_.empty() && given_up_[component]; }
  const RigidParts& rigid_parts() const { return parts_; }

  /// Why two triangles of welded vertices that meet in this way may stay; none: the pair has to be resolved.
  std::optional<LeftReason> reason_to_leave(const Triangle& a, const Triangle& b, PairClass kind) const;
  /// The same of two faces of these components, where the triangles that meet are not known.
  std::optional<LeftReason> reason_to_leave(Index component_a, Index component_b, PairClass kind) const;

  /// The rigid part in whose shape two triangles meet; -1: there is none.
  Index rigid_part_that_meets_itself(const Triangle& a, const Triangle& b) const;

 private:
  bool held_parts_meet(const Triangle& a, const Triangle& b) const;

  const Components* components_;
  Goal goal_;
  bool each_component_;
  std::vector<std::uint8_t> fixed_;
  Positions fixed_at_;  // of all vertices; empty where none is fixed
  RigidParts parts_;
  Positions shape_;  // of all vertices; empty where no part is rigid
  std::vector<std::uint8_t> given_up_;
};

}  // namespace unsnarl
