#include "unsnarl/check.h"

#include <algorithm>
#include <functional>
#include <span>
#include <stdexcept>
#include <utility>

#include "contact/stop_check.h"
#include "geometry/parallel.h"
#include "geometry/sort_unique.h"
#include "mesh/components.h"
#include "mesh/union_find.h"
#include "run/limits.h"
#include "scene/face_pairs.h"
#include "scene/overlapping_components.h"
#include "scene/prepared_surface.h"
#include "scene/topology.h"

namespace unsnarl {
namespace {

void extend_by_face(Bounds& bounds, const SurfaceView& surface, Index f) {
  for (const Index v : surface.face(f))
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = surface.positions[3 * static_cast<std::size_t>(v) + k];
      bounds.min[k] = std::min(bounds.min[k], x);
      bounds.max[k] = std::max(bounds.max[k], x);
    }
}

/// The first of all pairs, so many, however many there are.
class FirstPairs {
 public:
  explicit FirstPairs(std::size_t most) : most_(most) {}

  void add(std::span<const IntersectingPair> pairs) {
    if (most_ == 0) return;
    list_.insert(list_.end(), pairs.begin(), pairs.end());
    if (list_.size() / 2 >= most_) keep_first();
  }
  /// Sorted; leaves none.
  std::vector<IntersectingPair> take() {
    keep_first();
    std::sort(list_.begin(), list_.end());
    return std::exchange(list_, {});
  }

 private:
  void keep_first() {
    if (list_.size() <= most_) return;
    std::nth_element(list_.begin(), list_.begin() + static_cast<std::ptrdiff_t>(most_), list_.end());
    list_.resize(most_);
  }

  const std::size_t most_;
  std::vector<IntersectingPair> list_;
};

/// What follows from all pairs, of which the first alone are kept.
class PairTally {
 public:
  PairTally(std::size_t faces, const Components& components, std::size_t listed)
      : list_(listed),
        connected_(faces),
        pairs_of_face_(faces, 0),
        is_in_any_(faces, 0),
        of_component_(components.list.size()) {
    for (std::size_t c = 0; c < of_component_.size(); ++c) of_component_[c].has_volume = has_volume(components.list[c]);
  }

  /// component_of(face): its component.
  template <class ComponentOf>
  void add(std::span<const IntersectingPair> pairs, const ComponentOf& component_of) {
    for (const IntersectingPair& pair : pairs) {
      ++counts_[pair.kind];
      connected_.unite(pair.a, pair.b);
      ++pairs_of_face_[pair.a];
      is_in_any_[pair.a] = is_in_any_[pair.b] = 1;
      OfComponent &a = of_component_[component_of(pair.a)], &b = of_component_[component_of(pair.b)];
      if (&a == &b) {
        ++a.within;
      } else {
        ++a.with_others, ++b.with_others;
        if (a.has_volume && b.has_volume) note_meeting(component_of(pair.a), component_of(pair.b));
      }
    }
    list_.add(pairs);
  }

  /// Components that have a volume, with faces that intersect faces of others, in pairs: sorted, each once.
  std::vector<ComponentPair> meeting() {
    sort_unique(meeting_);
    return meeting_;
  }

  void describe(CheckReport& found) {
    found.pairs = list_.take();
    found.counts = counts_;
    for (std::size_t f = 0; f < is_in_any_.size(); ++f)
      if (is_in_any_[f]) found.faces.push_back(static_cast<Index>(f));
    for (std::size_t c = 0; c < of_component_.size(); ++c) {
      const OfComponent& component = of_component_[c];
      found.components[c].pairs_within = component.within;
      found.components[c].pairs_with_others = component.with_others;
      found.pairs_within_components += component.within;
      found.intersecting_components += component.within + component.with_others > 0;
    }
  }

  /// Places where faces intersect: connected by pairs, or by vertices among those in any.
  std::vector<ConflictPlace> places(const SurfaceView& surface, const WeldMap& weld_map,
                                    const std::vector<Index>& faces) {
    std::vector<Index> face_at(static_cast<std::size_t>(weld_map.count), -1);
    for (Index f : faces)
      for (Index corner : surface.face(f)) {
        Index& other = face_at[weld_map.vertex_of[corner]];
        if (other >= 0) connected_.unite(other, f);
        other = f;
      }
    std::vector<Index> place_of(surface.face_count(), -1);
    std::vector<ConflictPlace> places;
    for (Index f : faces) {
      Index& place = place_of[connected_.find(f)];
      if (place < 0) {
        place = static_cast<Index>(places.size());
        places.emplace_back();
      }
      places[place].faces.push_back(f);
      places[place].pairs += pairs_of_face_[f];
      extend_by_face(places[place].bounds, surface, f);
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const ConflictPlace& a, const ConflictPlace& b) { return a.pairs > b.pairs; });
    return places;
  }

 private:
  struct OfComponent {
    std::size_t within = 0, with_others = 0;
    bool has_volume = false;
  };

  /// Keeps each pair of components a few times at most.
  void note_meeting(Index a, Index b) {
    const ComponentPair pair = {std::min(a, b), std::max(a, b)};
    if (!meeting_.empty() && meeting_.back() == pair) return;
    meeting_.push_back(pair);
    if (meeting_.size() < meeting_noted_) return;
    sort_unique(meeting_);
    meeting_noted_ = 2 * meeting_.size() + of_component_.size();
  }

  FirstPairs list_;
  std::vector<ComponentPair> meeting_;
  std::size_t meeting_noted_ = 0;  // from so many on they are sorted
  PairCounts counts_;
  UnionFind connected_;
  std::vector<std::size_t> pairs_of_face_;  // in which it is the first of two
  std::vector<std::uint8_t> is_in_any_;
  std::vector<OfComponent> of_component_;
};

void describe_components(const SurfaceView& surface, const WeldMap& weld_map, const Components& components,
                         CheckReport& found) {
  found.components.resize(components.list.size());
  for (Index f = static_cast<Index>(surface.face_count()); f-- > 0;) {
    const Index c = component_of_face(surface, weld_map, components, f);
    if (c < 0) continue;
    ComponentFindings& component = found.components[c];
    component.first_face = f;
    ++component.faces;
    extend_by_face(component.bounds, surface, f);
  }
  std::vector<bool> is_counted(surface.vertex_count(), false);  // a vertex is of one component only
  for (Index f = 0; f < static_cast<Index>(surface.face_count()); ++f)
    for (const Index v : surface.face(f)) {
      if (!is_counted[v]) ++found.components[component_of_face(surface, weld_map, components, f)].vertices;
      is_counted[v] = true;
    }
  for (const Component& component : components.list) found.closed_non_orientable += component.obstructed();
}

/// Takes the pairs in blocks, those to resolve and those that are allowed. Throws LimitReached.
void find_pairs(const PreparedSurface& prepared, const CheckLimits& limits,
                const std::function<void(std::span<const IntersectingPair>)>& take,
                const std::function<void(std::span<const IntersectingPair>)>& take_allowed) {
  RepairOptions wanted;
  wanted.time_limit_s = limits.time_limit_s;
  wanted.memory_limit_mb = limits.memory_limit_mb;
  const Context nobody;
  Limits watch(wanted, nobody);
  try {
    const auto visit = [&](FacePairFinder::Which which, const auto& taker) {
      FacePairFinder(prepared, which).visit(prepared.rest, watch.stopper(), [&](auto pairs) {
        taker(pairs);
        if (watch.reached()) throw WorkStopped();
      });
    };
    visit(FacePairFinder::Which::to_resolve, take);
    if (prepared.allowed.any()) visit(FacePairFinder::Which::allowed, take_allowed);
  } catch (const WorkStopped&) {
    throw LimitReached(watch.status_or(Status::time_limit));
  }
}

}  // namespace

CheckReport check(const SurfaceView& surface, const FindOptions& options, const CheckLimits& limits) {
  if (!(limits.time_limit_s >= 0) || !(limits.memory_limit_mb >= 0))
    throw std::invalid_argument("CheckLimits: limits must not be negative");
  CheckReport found;
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  found.triangulation = prepared.triangulation.statistics.describe();
  const EdgeTable edges = build_edges(prepared.triangles());
  const Components components = find_components(surface, prepared.weld_map, prepared.triangles(), edges);
  found.topology = describe_topology(surface, prepared.weld_map, prepared.triangulation, edges, components);
  describe_components(surface, prepared.weld_map, components, found);
  PairTally tally(surface.face_count(), components, limits.pairs_listed);
  const auto component_of = [&](Index f) { return component_of_face(surface, prepared.weld_map, components, f); };
  FirstPairs allowed(limits.pairs_listed);
  find_pairs(
      prepared, limits, [&](std::span<const IntersectingPair> pairs) { tally.add(pairs, component_of); },
      [&](std::span<const IntersectingPair> pairs) {
        for (const IntersectingPair& pair : pairs) ++found.allowed[pair.kind];
        allowed.add(pairs);
      });
  found.allowed_pairs = allowed.take();
  tally.describe(found);
  found.overlapping_components = overlapping_components(prepared, components, tally.meeting());
  found.places = tally.places(surface, prepared.weld_map, found.faces);
  return found;
}

}  // namespace unsnarl
