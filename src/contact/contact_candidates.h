#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "contact/bvh.h"
#include "contact/distances.h"
#include "contact/four_boxes.h"
#include "contact/motion_bounds.h"
#include "geometry/block_list.h"
#include "geometry/parallel_lists.h"
#include "mesh/adjacency.h"

namespace unsnarl {

struct NearStencil {
  Stencil stencil;
  double distance = 0;            ///< between its primitives
  Vec3 direction = Vec3::Zero();  ///< of the shortest way (Closest::direction)
  /// Lower bound of the distance while vertices keep to their bounds: least_distance() along `direction`.
  double least_distance = 0;
  friend bool operator==(const NearStencil& s, const NearStencil& t) = default;
};

/// How long a list of stencils may become.
struct ListLimit {
  std::size_t most = std::numeric_limits<std::size_t>::max();  ///< stencils
  bool counts_listed = false;  ///< only those that are listed count; else all that are found do
};

/// Radius of a stencil where every vertex has one: the mean of its two primitives', of which each has that of its
/// vertex with the largest.
inline double radius_of(const Stencil& stencil, std::span<const double> radius) {
  return 0.5 * approach(stencil, radius);
}

/// Lists the stencils of a triangle mesh that are close together: every vertex against every triangle it is not a
/// corner of, every edge against every edge it shares no end point with. Stencils between triangles that share a vertex
/// or an edge are among them; they keep neighbours from folding through each other.
class ContactCandidates {
 public:
  /// The triangles may include obstacles; vertices without a triangle take part in nothing. The span must outlive this.
  ContactCandidates(std::span<const Triangle> triangles, Index vertex_count);

  /// Finds all stencils with a vertex v with moves[v] != 0 whose primitives may come closer than their radius while
  /// every vertex keeps to its bounds, and a few more. `moves` and `radius`, a length, have one entry a vertex; the
  /// radius of a stencil is radius_of(). `items` (a vector or BlockList) gets what `make(near, item)` makes of those of
  /// which it returns true; it is called from many threads. Parallel; the order depends only on the arguments, and on
  /// those of the first call. Throws WorkStopped soon after `stop` says so.
  template <class Items, class Make>
  void gather(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
              std::span<const std::uint8_t> moves, Make&& make, Items& items, const std::function<bool()>& stop = {}) {
    items.clear();
    start(x, radius, bounds, moves);
    gather_active(x, radius, bounds, moves, std::forward<Make>(make), items, stop, {});
  }
  /// All of these stencils.
  void gather(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
              std::span<const std::uint8_t> moves, std::vector<NearStencil>& stencils,
              const std::function<bool()>& stop = {}) {
    gather(x, radius, bounds, moves, list_as_is, stencils, stop);
  }

  /// The same for the stencils with one of `vertices`, after only the positions and bounds of these have changed since
  /// the last gathering. The cost grows with their number. Finds each stencil once, and adds to `items`. Returns false,
  /// and adds nothing, where they are more than the limit.
  template <class Items, class Make>
  bool gather_around(std::span<const Index> vertices, const Positions& x, std::span<const double> radius,
                     const MotionBounds& bounds, Make&& make, Items& items, const std::function<bool()>& stop = {},
                     const ListLimit& limit = {}) {
    start_around(vertices, x, radius, bounds);
    return gather_active(x, radius, bounds, around_, std::forward<Make>(make), items, stop, limit);
  }
  bool gather_around(std::span<const Index> vertices, const Positions& x, std::span<const double> radius,
                     const MotionBounds& bounds, std::vector<NearStencil>& stencils) {
    stencils.clear();
    return gather_around(vertices, x, radius, bounds, list_as_is, stencils);
  }

  /// Whether a triangle at the one primitive shares a vertex with a triangle at the other. For listed stencils.
  bool are_neighbours(const Stencil& stencil) const;

  /// The stencil of two primitives: see Stencil::primitives. `kind` is not vertex_edge.
  Stencil stencil_of(StencilKind kind, const std::array<Index, 2>& primitives) const;

  const EdgeTable& edges() const { return edges_; }
  const IndexLists& triangles_of_vertex() const { return triangles_of_vertex_; }

 private:
  /// Updates where triangle t may be.
  void update_triangle(const Positions& x, std::span<const double> radius, const MotionBounds& bounds, Index t);
  /// Gets each stencil, with the number of the task that finds it, in [0, bvh_.task_count()); tasks run in parallel.
  /// Returns whether it lists the stencil.
  using OnStencil = std::function<bool(Index task, const NearStencil& near)>;
  static bool list_as_is(const NearStencil& near, NearStencil& item) {
    item = near;
    return true;
  }
  void start(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
             std::span<const std::uint8_t> moves);
  void start_around(std::span<const Index> vertices, const Positions& x, std::span<const double> radius,
                    const MotionBounds& bounds);
  bool visit_active(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
                    std::span<const std::uint8_t> moves, const OnStencil& on_stencil, const std::function<bool()>& stop,
                    const ListLimit& limit) const;
  /// Whether triangle b stays beyond a slab of triangle a, farther than any stencil of theirs may be from active.
  bool stays_beyond(const Positions& x, const MotionBounds& bounds, Index a, Index b) const;
  /// Returns the number of stencils: those that are found, or that are listed.
  std::size_t visit_pair(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
                         std::span<const std::uint8_t> moves, Index a, Index b, Index task, const OnStencil& on_stencil,
                         bool counts_listed) const;
  template <class Items, class Make>
  bool gather_active(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
                     std::span<const std::uint8_t> moves, Make&& make, Items& items, const std::function<bool()>& stop,
                     const ListLimit& limit) const {
    using Item = typename Items::value_type;
    std::vector<std::deque<Item>> lists(static_cast<std::size_t>(bvh_.task_count()));  // no room for what may come
    const auto list = [&](Index task, const NearStencil& near) {
      Item item;
      if (!make(near, item)) return false;
      lists[static_cast<std::size_t>(task)].push_back(item);
      return true;
    };
    if (!visit_active(x, radius, bounds, moves, list, stop, limit)) return false;
    append_lists(std::move(lists), items);
    return true;
  }

  std::span<const Triangle> triangles_;
  EdgeTable edges_;
  IndexLists triangles_of_vertex_;
  IndexLists around_vertex_;  // the corners of the triangles at each vertex, itself among them; ascending
  IndexLists around_edge_;    // the same of each edge
  // Every vertex and edge belongs to its first triangle, so that a stencil is listed once.
  std::vector<std::uint8_t> owned_corners_;  // bit k: corner k; bit 3 + k: edge k of the triangle
  std::vector<std::uint8_t> moving_;         // per triangle: has a vertex that is gathered around
  std::vector<std::uint8_t> around_;         // per vertex: it is gathered around
  std::vector<Box> boxes_;
  std::vector<FourIndices> corners_;  // of the triangles; the last is -1
  // Of the last gathering:
  struct Slab {
    Vec3 axis;      // unit or zero
    double lo, hi;  // where the corners of a triangle may be along it, from the first one
  };
  struct Slabs {
    Slab normal;        // along the triangle's normal
    Slab across;        // within its plane, across its longest edge: what bounds a sliver
    double around = 0;  // the largest of its corners
    double radius = 0;  // the same
  };
  struct Reach {
    FourBoxes corners;  // of those the triangle looks after, and its own
    FourBoxes edges;    // of those it looks after
  };
  std::vector<Slabs> slabs_;
  std::vector<Reach> reach_;
  Bvh bvh_;
  bool built_ = false;
};

}  // namespace unsnarl
