#pragma once

#include <span>
#include <utility>
#include <vector>

#include "contact/bvh.h"
#include "contact/bvh_traversal.h"
#include "geometry/types.h"

namespace unsnarl {

/// A tree over triangles whose vertices move. Where most edges run along a few slanted directions (extruded shapes with
/// long thin triangles), the boxes are aligned with those: boxes along the coordinate axes would hold mostly air.
class FaceTree {
 public:
  /// The span must outlive the tree.
  explicit FaceTree(std::span<const Triangle> triangles) : FaceTree(triangles, static_cast<Index>(triangles.size())) {}
  /// Pairs of two triangles >= active_count are left out.
  FaceTree(std::span<const Triangle> triangles, Index active_count)
      : triangles_(triangles), active_count_(active_count) {}

  /// Takes over the positions; every box is inflated by `margin`.
  void update(const Positions& x, double margin = 0);
  /// The same if only these triangles (ids, each once) have moved since the last call, and neither call has a margin.
  /// The cost grows with their number. Precondition: there was such a call.
  void update(const Positions& x, std::span<const Index> moved);

  /// From now on all pairs with an active triangle are visited, as at first.
  void set_active();
  /// From now on only pairs with one of these triangles (ids, each once) are visited.
  void set_only_active(std::span<const Index> active) { bvh_.set_only_active(active); }

  /// Calls visit(Index) once for every triangle that reaches into `box`, and for some that are only near it.
  template <class Visit>
  void query(const Box& box, Visit&& visit) const {
    bvh_.query(in_frame(box), visit);
  }

  /// Calls visit(task, i, j), i < j, once for each pair of triangles whose boxes overlap; in parallel over the tasks
  /// [0, task_count()), in a fixed order within each.
  template <class Visit>
  void self_pairs(Visit&& visit) const {
    bvh_.self_pairs_parallel([&](Index task, Index i, Index j) { visit(task, std::min(i, j), std::max(i, j)); });
  }
  Index task_count() const { return bvh_.task_count(); }
  /// Whether the boxes are not along the coordinate axes.
  bool is_turned() const { return is_turned_; }

 private:
  void choose_frame(const Positions& x);
  Box own_box(const Positions& x, Index t) const;
  /// A box along the axes of the tree's boxes around one along the coordinate axes.
  Box in_frame(const Box& box) const;

  std::span<const Triangle> triangles_;
  Index active_count_;
  bool is_turned_ = false;
  Eigen::Matrix3d frame_ = Eigen::Matrix3d::Identity();  // rows: the axes of the boxes
  std::vector<Box> boxes_;
  Bvh bvh_;
};

}  // namespace unsnarl
