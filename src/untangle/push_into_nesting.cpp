#include "untangle/push_into_nesting.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "contact/closed_surface.h"
#include "geometry/parallel.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

/// Margin of its first push [E147] (unit: mean edges at the vertex)
constexpr double nesting_margin = 0.03;
/// The pushes end if the number of crossing faces has not fallen in so many (unit: iterations)
constexpr int nesting_patience = 12;

class Push {
 public:
  Push(Scene& scene, SceneIndex& index, std::span<const Index> component_of_vertex, const NestedSurfaces& nested,
       const std::function<bool()>& stop)
      : scene_(scene), index_(index), component_of_(component_of_vertex), nested_(nested), stop_(stop) {
    normals_.resize(nested.triangles.size());
    vertex_normals_ = Positions::Zero(3, scene.vertex_count());
    for (std::size_t s = 0; s < nested.triangles.size(); ++s) {
      surfaces_.emplace_back(nested.triangles[s]);
      const double outward = signed_volume(scene.rest, nested.triangles[s]) < 0 ? -1 : 1;
      for (const Triangle& t : nested.triangles[s]) {
        normals_[s].emplace_back(outward * area_vector(scene.rest, t));
        if (nested.closed[s])
          for (const Index v : t) vertex_normals_.col(v) += normals_[s].back();
      }
    }
    for (const auto& [inner, outer] : nested.pairs) {
      const auto add = [&](Index of, Index against, Side right) {
        roles_.push_back({of,
                          against,
                          right,
                          std::vector<std::uint8_t>(scene.vertex_count(), 0),
                          std::vector<double>(scene.vertex_count(), 0),
                          {}});
      };
      add(inner, outer, Side::inside);
      if (nested.closed[inner]) add(outer, inner, Side::outside);
    }
  }

  PushResult run() {
    PushResult result;
    const Positions start = scene_.x;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (int waited = 0; waited < nesting_patience && !(stop_ && stop_()); ++waited, ++result.iterations) {
      const std::size_t crossing = note_crossings();
      if (crossing == 0) break;
      if (crossing < fewest) waited = 0;
      fewest = std::min(fewest, crossing);
      for (ClosedSurface& surface : surfaces_) surface.update(scene_.x);
      in_ = out_ = Positions::Zero(3, scene_.vertex_count());
      for (Role& role : roles_) add_pushes(role);
      scene_.x += in_ + out_;
    }
    index_.update();
    for (Index v = 0; v < scene_.vertex_count(); ++v)
      if (scene_.x.col(v) != start.col(v)) result.moved.push_back(v);
    return result;
  }

 private:
  /// One surface with respect to another that it is to be inside or outside of.
  struct Role {
    Index of, against;
    Side right;
    std::vector<std::uint8_t> ties;  // by component: it crosses or has crossed the other surface
    std::vector<double> margin;      // of each vertex, a length; 0: of no face that crosses or has crossed
    std::vector<double> distance;    // that was found last, of each vertex of the surface
  };

  /// Ties the components that cross, and grows the margins where they do. Returns how many faces cross.
  std::size_t note_crossings() {
    const std::vector<IntersectingPair> pairs = index_.find_pairs();
    std::size_t count = 0;
    std::vector<std::uint8_t> has_grown(scene_.vertex_count());
    for (Role& role : roles_) {
      std::fill(has_grown.begin(), has_grown.end(), 0);
      for (const IntersectingPair& pair : pairs)
        for (const auto& [own, other] : {std::pair{pair.a, pair.b}, std::pair{pair.b, pair.a}}) {
          if (surface_of(own) != role.of || surface_of(other) != role.against) continue;
          ++count;
          for (const Index v : scene_.triangles[own])
            if (std::exchange(has_grown[v], 1) == 0) tie(role, v);
        }
    }
    return count;
  }

  Index surface_of(Index t) const { return nested_.surface_of_vertex[scene_.triangles[t][0]]; }

  void tie(Role& role, Index v) const {
    role.ties[component_of_[v]] = 1;
    const double edge = edge_at(v);
    role.margin[v] = std::min(std::max(2 * role.margin[v], nesting_margin * edge), 0.5 * edge);
  }

  /// Mean length of the edges at a vertex, at rest.
  double edge_at(Index v) const {
    double sum = 0;
    for (const Index w : scene_.neighbours[v]) sum += (scene_.rest.col(w) - scene_.rest.col(v)).norm();
    return sum / static_cast<double>(std::max<std::size_t>(1, scene_.neighbours[v].size()));
  }

  void add_pushes(Role& role) {
    const std::vector<Index>& vertices = nested_.vertices[role.of];
    role.distance.resize(vertices.size(), 0);
    Positions& pushes = role.right == Side::inside ? in_ : out_;
    parallel_for(vertices.size(), [&](std::size_t i) {
      const Index v = vertices[i];
      if (scene_.fixed[v] || !role.ties[component_of_[v]]) return;
      const Vec3 push = push_of(role, v, role.distance[i]);
      if (push.squaredNorm() > pushes.col(v).squaredNorm()) pushes.col(v) = push;
    });
  }

  Vec3 push_of(const Role& role, Index v, double& distance) const {
    const ClosedSurface& other = surfaces_[role.against];
    const Vec3 p = scene_.x.col(v);
    const bool is_right = other.side_of(p) == role.right;
    if (is_right && !(role.margin[v] > 0)) return Vec3::Zero();
    const double margin = role.margin[v] > 0 ? role.margin[v] : nesting_margin * edge_at(v);
    const std::vector<Vec3>& normals = normals_[role.against];
    const auto faces_the_same_way = [&](Index t) { return normals[t].dot(vertex_normals_.col(v)) > 0; };
    const double guess = std::max(distance, margin);
    ClosedSurface::Nearest nearest;
    if (vertex_normals_.col(v).squaredNorm() > 0) nearest = other.nearest(p, guess, faces_the_same_way);
    if (nearest.triangle < 0) nearest = other.nearest(p, guess);
    const auto& [triangle, closest] = nearest;
    distance = closest.distance;
    const double missing = margin - (is_right ? distance : -distance);
    if (!(missing > 0)) return Vec3::Zero();
    Vec3 direction = is_right ? closest.direction : Vec3(-closest.direction);
    const Triangle& t = other.triangles()[triangle];
    if (direction.isZero()) {
      direction = triangle_normal(scene_.x, t);
      if (other.side_of(p + margin * direction) != role.right) direction = -direction;
    }
    const bool gives_way = std::any_of(t.begin(), t.end(), [&](Index w) { return !scene_.fixed[w]; });
    return (gives_way ? 0.5 : 1.0) * missing * direction;
  }

  Scene& scene_;
  SceneIndex& index_;
  std::span<const Index> component_of_;
  const NestedSurfaces& nested_;
  const std::function<bool()>& stop_;
  std::vector<ClosedSurface> surfaces_;
  std::vector<std::vector<Vec3>> normals_;  // outward, of the triangles of each, at rest
  Positions vertex_normals_;                // the same of closed surfaces, their sums at each vertex
  std::vector<Role> roles_;
  Positions in_, out_;  // of each vertex the longest push of either kind
};

}  // namespace

PushResult push_into_nesting(Scene& scene, SceneIndex& index, std::span<const Index> component_of_vertex,
                             const NestedSurfaces& nested, const std::function<bool()>& stop) {
  return Push(scene, index, component_of_vertex, nested, stop).run();
}

}  // namespace unsnarl
