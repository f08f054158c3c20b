#include "scene/pair_policy.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "contact/intersection_finder.h"

namespace unsnarl {
namespace {

struct ReasonWords {
  LeftReason reason;
  std::string_view name;         // in reports
  std::string_view description;  // what follows "5 intersections"
};

/// All reasons, in the order of enum LeftReason.
constexpr auto reasons = std::to_array<ReasonWords>({
    {LeftReason::closed_non_orientable, "closed_non_orientable",
     "on a closed non-orientable component (like a Klein bottle), which always intersects itself"},
    {LeftReason::duplicate_faces, "duplicate_faces", "between faces on the same three vertices"},
    {LeftReason::fixed_faces, "fixed_faces", "inside parts that you told unsnarl to keep fixed"},
    {LeftReason::between_components, "between_components", "between components, which --each does not separate"},
    {LeftReason::goal, "goal", "between faces that share a vertex, which --goal disjoint ignores"},
    {LeftReason::rounding, "rounding", "need a gap too small for the digits of the file"},
    {LeftReason::displacement, "displacement", "need a vertex to move farther than --max-displacement allows"},
    {LeftReason::taken_back, "taken_back", "can be removed only by creating more intersections elsewhere"},
    {LeftReason::time_limit, "time_limit", "were not repaired before the time limit"},
    {LeftReason::memory_limit, "memory_limit", "were not repaired before the memory limit"},
    {LeftReason::cancelled, "cancelled", "were not repaired before the interruption"},
    {LeftReason::unresolved, "unresolved", "could not be removed"},
    {LeftReason::other_diagonal, "other_diagonal",
     "appear only where polygons are split along other diagonals than in the input"},
    {LeftReason::rigid_faces, "rigid_faces", "inside a rigid part"},
});
static_assert(reasons.size() == left_reason_count);
static_assert([] {
  for (std::size_t i = 0; i < reasons.size(); ++i)
    if (static_cast<std::size_t>(reasons[i].reason) != i) return false;
  return true;
}());

/// The span of those of a triangle's vertices that are held, as a triangle that uses some of them twice; none: no
/// vertex is.
template <class IsHeld>
std::optional<Triangle> held_part(const Triangle& t, IsHeld&& is_held) {
  std::optional<Triangle> part;
  int count = 0;
  for (const Index v : t) {
    if (!is_held(v)) continue;
    if (!part) part = Triangle{v, v, v};
    std::fill(part->begin() + count++, part->end(), v);
  }
  return part;
}

template <class IsHeld>
bool what_is_held_meets(const Positions& x, const Triangle& a, const Triangle& b, IsHeld&& is_held) {
  const std::optional<Triangle> of_a = held_part(a, is_held), of_b = held_part(b, is_held);
  PairClass kind;
  return of_a && of_b && intersects(x, *of_a, *of_b, kind);
}

}  // namespace

std::string_view to_string(LeftReason reason) {
  return reasons.at(static_cast<std::size_t>(reason)).name;
}
std::string_view describe(LeftReason reason) {
  return reasons.at(static_cast<std::size_t>(reason)).description;
}

bool is_obstruction(LeftReason reason) {
  return reason == LeftReason::closed_non_orientable || reason == LeftReason::duplicate_faces ||
         reason == LeftReason::fixed_faces || reason == LeftReason::rigid_faces;
}

void PairPolicy::hold(std::span<const std::uint8_t> fixed, const Positions& x) {
  fixed_.assign(fixed.begin(), fixed.end());
  const bool any = std::any_of(fixed.begin(), fixed.end(), [](std::uint8_t flag) { return flag != 0; });
  fixed_at_ = any ? x : Positions();
}

void PairPolicy::hold_shape(RigidParts parts, const Positions& x) {
  parts_ = std::move(parts);
  shape_ = parts_.count > 0 ? x : Positions();
}

void PairPolicy::give_up(Index component) {
  given_up_.resize(static_cast<std::size_t>(components_->count()), 0);
  given_up_[component] = 1;
}

std::optional<LeftReason> PairPolicy::reason_to_leave(const Triangle& a, const Triangle& b, PairClass kind) const {
  const Index of_a = components_->component_of_vertex[a[0]], of_b = components_->component_of_vertex[b[0]];
  const std::optional<LeftReason> reason = reason_to_leave(of_a, of_b, kind);
  if (reason && is_obstruction(*reason)) return reason;
  if (held_parts_meet(a, b)) return LeftReason::fixed_faces;
  if (rigid_part_that_meets_itself(a, b) >= 0) return LeftReason::rigid_faces;
  return reason;
}

std::optional<LeftReason> PairPolicy::reason_to_leave(Index component_a, Index component_b, PairClass kind) const {
  if (component_a == component_b && components_->list[component_a].obstructed())
    return LeftReason::closed_non_orientable;
  if (kind == PairClass::duplicate) return LeftReason::duplicate_faces;
  if (each_component_ && component_a != component_b) return LeftReason::between_components;
  if (goal_ == Goal::disjoint && kind != PairClass::disjoint) return LeftReason::goal;
  if (is_given_up(component_a) || is_given_up(component_b)) return LeftReason::unresolved;
  return std::nullopt;
}

bool PairPolicy::held_parts_meet(const Triangle& a, const Triangle& b) const {
  if (fixed_at_.size() == 0) return false;
  const auto is_held_vertex = [&](Index v) { return is_held(v); };
  const bool none_moves =
      std::all_of(a.begin(), a.end(), is_held_vertex) && std::all_of(b.begin(), b.end(), is_held_vertex);
  return none_moves || what_is_held_meets(fixed_at_, a, b, is_held_vertex);
}

Index PairPolicy::rigid_part_that_meets_itself(const Triangle& a, const Triangle& b) const {
  if (shape_.size() == 0) return -1;
  for (const Index v : a) {
    const Index part = parts_.of_vertex[v];
    const auto is_of_part = [&](Index w) { return parts_.of_vertex[w] == part; };
    if (part >= 0 && what_is_held_meets(shape_, a, b, is_of_part)) return part;
  }
  return -1;
}

}  // namespace unsnarl
