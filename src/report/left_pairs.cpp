#include "report/left_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "contact/intersection_finder.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

class Explanation {
 public:
  Explanation(const PreparedSurface& prepared, const Ending& ending)
      : prepared_(prepared), ending_(ending), attempts_(ending.attempts) {}

  LeftReason reason(const IntersectingPair& pair) const {
    const Triangle &a = prepared_.triangles()[pair.a], &b = prepared_.triangles()[pair.b];
    if (const auto reason = ending_.policy.reason_to_leave(a, b, pair.kind)) return *reason;
    if (!meets_at(attempts_.solved, pair)) {
      if (differs_by_rounding(pair)) return LeftReason::rounding;
      return any_vertex(pair, [&](Index v) { return attempts_.is_too_far[v] != 0; }) ? LeftReason::displacement
                                                                                     : LeftReason::taken_back;
    }
    if (all_vertices(pair, [&](Index v) { return attempts_.is_too_far[v] || ending_.held[v]; }))
      return LeftReason::displacement;
    const bool is_cut_short = furthest_strategy(pair) < last_strategy() ||
                              any_vertex(pair, [&](Index v) { return attempts_.is_cut_short[v] != 0; });
    return is_cut_short ? reason_of(ending_.limit) : LeftReason::unresolved;
  }

  /// Number of the last strategy tried on the pair; -1: none.
  int furthest_strategy(const IntersectingPair& pair) const {
    int furthest = -1;
    for (Index t : {pair.a, pair.b})
      for (Index v : prepared_.triangles()[t]) furthest = std::max<int>(furthest, attempts_.strategy[v]);
    return furthest;
  }

 private:
  /// `status`: the limit that ended the work, or any other.
  static LeftReason reason_of(Status status) {
    if (status == Status::time_limit) return LeftReason::time_limit;
    if (status == Status::memory_limit) return LeftReason::memory_limit;
    if (status == Status::cancelled) return LeftReason::cancelled;
    return LeftReason::unresolved;
  }

  template <class Condition>
  bool any_vertex(const IntersectingPair& pair, Condition&& condition) const {
    const Triangle &a = prepared_.triangles()[pair.a], &b = prepared_.triangles()[pair.b];
    return std::any_of(a.begin(), a.end(), condition) || std::any_of(b.begin(), b.end(), condition);
  }
  template <class Condition>
  bool all_vertices(const IntersectingPair& pair, Condition&& condition) const {
    return !any_vertex(pair, [&](Index v) { return !condition(v); });
  }

  bool meets_at(const Positions& x, const IntersectingPair& pair) const {
    PairClass kind;
    return intersects(x, prepared_.triangles()[pair.a], prepared_.triangles()[pair.b], kind);
  }
  bool differs_by_rounding(const IntersectingPair& pair) const {
    constexpr double float32_unit = std::numeric_limits<float>::epsilon();
    return all_vertices(pair, [&](Index v) {
      for (int k = 0; k < 3; ++k)
        if (std::abs(ending_.x(k, v) - attempts_.solved(k, v)) > float32_unit * std::abs(ending_.x(k, v))) return false;
      return true;
    });
  }

  const PreparedSurface& prepared_;
  const Ending& ending_;
  const AttemptLog& attempts_;
};

}  // namespace

std::optional<LeftReason> reason_to_leave_faces(const SurfaceView& surface, const PreparedSurface& prepared,
                                                const Components& components, const PairPolicy& policy,
                                                const IntersectingPair& pair) {
  const auto component_of = [&](Index f) { return component_of_face(surface, prepared.weld_map, components, f); };
  return policy.reason_to_leave(component_of(pair.a), component_of(pair.b), pair.kind);
}

void explain_left_pairs(const SurfaceView& surface, const PreparedSurface& prepared, const Ending& ending,
                        const PairCensus::Pairs& left, RepairReport& report) {
  struct Why {
    LeftReason reason;
    int strategy;
  };
  const Explanation explanation(prepared, ending);
  const std::vector<Index>& polygon = prepared.triangulation.polygon;
  // Of two faces: the first reason that holds for a pair of their triangles.
  std::map<std::pair<Index, Index>, Why> why;
  for (const IntersectingPair& pair : left.triangles) {
    const Why own = {explanation.reason(pair), explanation.furthest_strategy(pair)};
    auto& of_faces = why.try_emplace(std::minmax(polygon[pair.a], polygon[pair.b]), own).first->second;
    if (own.reason < of_faces.reason) of_faces = own;
  }
  for (const IntersectingPair& pair : left.of_faces) {
    const auto found = why.find({pair.a, pair.b});
    const auto by_other_cuts = [&] {
      return reason_to_leave_faces(surface, prepared, ending.components, ending.policy, pair)
          .value_or(LeftReason::other_diagonal);
    };
    const Why reason = found != why.end() ? found->second : Why{by_other_cuts(), -1};
    ++report.left_by_reason[static_cast<std::size_t>(reason.reason)];
    const bool names_strategy = reason.reason == LeftReason::unresolved && reason.strategy >= 0;
    report.left.push_back(
        {pair.a, pair.b, pair.kind, reason.reason, std::string(names_strategy ? strategy_name(reason.strategy) : "")});
  }
}

}  // namespace unsnarl
