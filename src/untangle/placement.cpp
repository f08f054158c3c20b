#include "untangle/placement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "contact/blocking_pairs.h"
#include "contact/bvh.h"
#include "contact/bvh_traversal.h"
#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "mesh/union_find.h"
#include "rigid/free_place.h"

namespace unsnarl {
namespace {

/// Clearance: share of its motion by which a component goes beyond the first free place; it shrinks to this share at
/// least (no unit)
constexpr double margin = 0.05;
/// Number of a component's own vertices that it shrinks toward, at most about (unit: vertices)
constexpr std::size_t most_centres = 16;

/// Components that have more stay at rest, since each try takes an exact test of them all (unit: faces)
constexpr std::size_t most_faces = 4000;

/// A component of the patch that may be placed.
struct Component {
  std::vector<Index> vertices, triangles;
  double diagonal = 0;
};

/// A one-parameter family of motions, at 0 where the component is.
struct Motion {
  Vec3 direction = Vec3::Zero();  // of a translation by the parameter, or zero:
  Vec3 centre = Vec3::Zero();     // it shrinks toward this point by the share that the parameter is

  bool is_translation() const { return direction != Vec3::Zero(); }
  Vec3 apply(const Vec3& p, double parameter) const {
    return is_translation() ? Vec3(p + parameter * direction) : Vec3(p + parameter * (centre - p));
  }
};

class Placement {
 public:
  Placement(Patch& patch, std::span<const IntersectingPair> tolerated, const std::function<bool()>& stop)
      : patch_(patch), tolerated_(tolerated), stop_(stop), x_(patch.x) {
    find_components();
    boxes_.resize(patch.triangles.size());
    is_present_.assign(patch.triangles.size(), 1);
    for (std::size_t t = 0; t < boxes_.size(); ++t) boxes_[t] = box_of(x_, patch.triangles[t]);
    tree_.build(boxes_);
    for (const Component& component : components_) {
      for (Index t : component.triangles) is_present_[t] = 0;
      go_back_to_rest(component);
    }
  }

  int run() {
    int placed = 0;
    for (const Component& component : components_) {
      if (stopped()) break;
      placed += place(component);
      for (Index t : component.triangles) is_present_[t] = 1;
    }
    patch_.x = x_;
    return placed;
  }

 private:
  bool stopped() const { return stop_ && stop_(); }

  void find_components() {
    const std::span<const Triangle> active(patch_.triangles.data(), static_cast<std::size_t>(patch_.active_count));
    UnionFind sets = vertices_joined_by(active, static_cast<Index>(x_.cols()));
    std::vector<Index> of_root(x_.cols(), -1);
    for (Index v = 0; v < patch_.free_count; ++v) {
      Index& number = of_root[sets.find(v)];
      if (number < 0) {
        number = static_cast<Index>(components_.size());
        components_.emplace_back();
      }
      components_[number].vertices.push_back(v);
    }
    std::vector<double> area(components_.size(), 0);
    for (Index t = 0; t < patch_.active_count; ++t) {
      const Index c = of_root[sets.find(active[t][0])];
      components_[c].triangles.push_back(t);
      area[c] += triangle_area(x_, active[t]);
    }
    for (Component& component : components_) {
      Box box;
      for (Index v : component.vertices) box.extend(Vec3(x_.col(v)));
      component.diagonal = box.diagonal();
    }
    std::vector<Index> order(components_.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return area[a] > area[b]; });
    std::vector<Component> sorted;
    for (Index c : order) sorted.push_back(std::move(components_[c]));
    components_ = std::move(sorted);
  }

  /// The two triangles may intersect.
  bool is_tolerated(Index t, Index u) const {
    return !patch_.passing().meet(patch_.triangles, t, u) ||
           is_among({std::min(t, u), std::max(t, u), PairClass::disjoint}, tolerated_);
  }

  bool meets_something(Index t) const {
    PairClass kind;
    return tree_.find(box_of(x_, patch_.triangles[t]), [&](Index u) {
      return is_present_[u] && !is_tolerated(t, u) && intersects(x_, patch_.triangles[t], patch_.triangles[u], kind);
    });
  }

  /// The component, where it is in x_, meets nothing that is present. Its own triangles are not. `met`: one of its
  /// triangles, tried first; becomes one that meets something.
  bool is_free(const Component& component, Index& met) const {
    if (meets_something(met)) return false;
    const auto& triangles = component.triangles;
    const auto found = std::find_if(triangles.begin(), triangles.end(), [&](Index t) { return meets_something(t); });
    if (found == triangles.end()) return true;
    met = *found;
    return false;
  }

  std::vector<IntersectingPair> contacts_of(const Component& component) const {
    std::vector<IntersectingPair> contacts;
    for (Index t : component.triangles)
      tree_.query(box_of(x_, patch_.triangles[t]), [&](Index u) {
        PairClass kind;
        if (is_present_[u] && !is_tolerated(t, u) && intersects(x_, patch_.triangles[t], patch_.triangles[u], kind))
          contacts.push_back({t, u, kind});
      });
    std::sort(contacts.begin(), contacts.end());
    return contacts;
  }

  std::vector<Motion> motions_of(const Component& component, std::span<const IntersectingPair> contacts) const {
    std::vector<Motion> motions;
    const auto add_both_ways = [&](const Vec3& d) {
      const double length = d.norm();
      if (!(length > 0)) return;
      motions.push_back({.direction = d / length});
      motions.push_back({.direction = -d / length});
    };
    for (const IntersectingPair& pair : some_contacts(contacts)) {
      add_both_ways(area_vector(x_, patch_.triangles[pair.a]));
      add_both_ways(area_vector(x_, patch_.triangles[pair.b]));
    }
    for (const Vec3& direction : lattice_directions()) add_both_ways(direction);
    Vec3 middle = Vec3::Zero();
    for (Index v : component.vertices) middle += x_.col(v);
    motions.push_back({.centre = middle / static_cast<double>(component.vertices.size())});
    const std::size_t step = component.vertices.size() / most_centres + 1;
    for (std::size_t k = 0; k < component.vertices.size(); k += step)
      motions.push_back({.centre = x_.col(component.vertices[k])});
    return motions;
  }

  static MotionFamily family_of(const Motion& motion, const Positions& from, double diagonal) {
    if (motion.is_translation()) return {diagonal, diagonal};
    return {1 - margin, 1 - margin, std::sqrt((from.colwise() - motion.centre).colwise().squaredNorm().mean())};
  }

  void move(const Component& component, const Positions& from, const Motion& motion, double parameter) {
    for (std::size_t k = 0; k < component.vertices.size(); ++k)
      x_.col(component.vertices[k]) = motion.apply(from.col(static_cast<Index>(k)), parameter);
  }

  /// Moves the component back to rest if it does not intersect itself there.
  void go_back_to_rest(const Component& component) {
    for (Index v : component.vertices) x_.col(v) = patch_.rest.col(v);
    update_boxes(component);
    std::vector<std::uint8_t> is_own(boxes_.size(), 0);
    for (Index t : component.triangles) is_own[t] = 1;
    const auto intersects_own = [&](Index t) {
      return tree_.find(boxes_[t], [&](Index u) {
        PairClass kind;
        return u > t && is_own[u] && !is_tolerated(t, u) &&
               intersects(x_, patch_.triangles[t], patch_.triangles[u], kind);
      });
    };
    if (!std::any_of(component.triangles.begin(), component.triangles.end(), intersects_own)) return;
    for (Index v : component.vertices) x_.col(v) = patch_.x.col(v);
    update_boxes(component);
  }

  void update_boxes(const Component& component) {
    for (Index t : component.triangles) boxes_[t] = box_of(x_, patch_.triangles[t]);
    tree_.refit(boxes_, component.triangles);
  }

  /// True where it is at a free place then.
  bool place(const Component& component) {
    const std::vector<IntersectingPair> contacts = contacts_of(component);
    if (contacts.empty()) return true;
    if (component.triangles.size() > most_faces) return false;
    Positions from(3, static_cast<Index>(component.vertices.size()));
    for (std::size_t k = 0; k < component.vertices.size(); ++k)
      from.col(static_cast<Index>(k)) = x_.col(component.vertices[k]);
    const std::vector<Motion> motions = motions_of(component, contacts);
    std::vector<MotionFamily> families;
    for (const Motion& motion : motions) families.push_back(family_of(motion, from, component.diagonal));
    Index met = component.triangles.front();
    const auto is_free_at = [&](std::size_t k, double parameter) {
      move(component, from, motions[k], parameter);
      return is_free(component, met);
    };
    const std::optional<FreePlace> found = nearest_free_place(families, is_free_at, {margin, false, stop_});
    if (found)
      move(component, from, motions[found->family], found->parameter);
    else
      for (const Index v : component.vertices) x_.col(v) = patch_.x.col(v);
    update_boxes(component);
    return found.has_value();
  }

  Patch& patch_;
  std::span<const IntersectingPair> tolerated_;
  const std::function<bool()>& stop_;
  Positions x_;
  std::vector<Component> components_;     // largest first
  std::vector<std::uint8_t> is_present_;  // per triangle; those of components that are to be placed are not
  std::vector<Box> boxes_;
  Bvh tree_;
};

}  // namespace

int place(Patch& patch, std::span<const IntersectingPair> tolerated, const std::function<bool()>& stop) {
  return Placement(patch, tolerated, stop).run();
}

}  // namespace unsnarl
