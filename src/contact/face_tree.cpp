#include "contact/face_tree.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

#include "geometry/parallel_sums.h"

namespace unsnarl {
namespace {

/// Boxes are turned where that shrinks their total surface below this share, as for bundles of needles; turned boxes
/// cost a product for each vertex [E176] (no unit)
constexpr double worth_turning = 0.25;
/// A box of turned positions is enlarged by this, since products are rounded (unit: largest coordinate)
constexpr double turned_reserve = 4e-15;
constexpr Index grain = 4096;  ///< A task of a parallel loop has this many triangles (unit: triangles)

double half_surface(const Box& box) {
  const Vec3 d = box.hi - box.lo;
  return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

Box with_reserve(const Box& box) {
  return box.inflated(turned_reserve * std::max(box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff()));
}

Box turned_box(const Eigen::Matrix3d& frame, const Positions& x, const Triangle& t) {
  Box box;
  for (Index v : t) box.extend(Vec3(frame * x.col(v)));
  return with_reserve(box);
}

}  // namespace

void FaceTree::choose_frame(const Positions& x) {
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  for (const Triangle& t : triangles_)
    for (int k = 0; k < 3; ++k) {
      const Vec3 e = x.col(t[(k + 1) % 3]) - x.col(t[k]);
      directions += e * e.transpose();
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(directions);
  if (solver.info() != Eigen::Success) return;
  const Eigen::Matrix3d frame = solver.eigenvectors().transpose();
  if (!frame.allFinite()) return;
  double along_axes = 0, turned = 0;
  for (const Triangle& t : triangles_) {
    along_axes += half_surface(box_of(x, t));
    turned += half_surface(turned_box(frame, x, t));
  }
  is_turned_ = turned < worth_turning * along_axes;
  if (is_turned_) frame_ = frame;
}

Box FaceTree::own_box(const Positions& x, Index t) const {
  return is_turned_ ? turned_box(frame_, x, triangles_[t]) : box_of(x, triangles_[t]);
}

Box FaceTree::in_frame(const Box& box) const {
  if (!is_turned_ || !(box.lo.array() <= box.hi.array()).all()) return box;
  Box turned;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? box.hi[0] : box.lo[0], corner & 2 ? box.hi[1] : box.lo[1],
                 corner & 4 ? box.hi[2] : box.lo[2]);
    turned.extend(Vec3(frame_ * p));
  }
  return with_reserve(turned);
}

void FaceTree::update(const Positions& x, double margin) {
  const bool is_new = boxes_.empty();
  const Index n = static_cast<Index>(triangles_.size());
  boxes_.resize(n);
  if (is_new) choose_frame(x);
  for_chunks(n, grain, [&](Index begin, Index end) {
    for (Index t = begin; t < end; ++t) {
      const Box box = own_box(x, t);
      boxes_[t] = margin > 0 ? box.inflated(margin) : box;
    }
  });
  if (!is_new) {
    bvh_.refit(boxes_);
    return;
  }
  bvh_.build(boxes_);
  if (active_count_ < n) set_active();
}

void FaceTree::update(const Positions& x, std::span<const Index> moved) {
  for (Index t : moved) boxes_[t] = own_box(x, t);
  bvh_.refit(boxes_, moved);
}

void FaceTree::set_active() {
  std::vector<std::uint8_t> active(triangles_.size(), 0);
  std::fill(active.begin(), active.begin() + active_count_, std::uint8_t{1});
  bvh_.set_active(active);
}

}  // namespace unsnarl
