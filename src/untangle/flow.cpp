#include "untangle/flow.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "contact/bvh.h"
#include "contact/intersection_finder.h"
#include "energy/arap.h"
#include "energy/gaussian_contact.h"
#include "energy/minkowski_penalty.h"
#include "geometry/box.h"
#include "mesh/areas.h"
#include "optimize/lbfgs.h"
#include "scene/patch_progress.h"
#include "scene/trajectory.h"
#include "untangle/finish_by_contours.h"
#include "untangle/flow_samples.h"
#include "untangle/local_solver.h"

namespace unsnarl {
namespace {

/// The contour method that takes away what the flow leaves, tried in this order: it needs four iterations, or gets
/// nowhere.
constexpr std::array<LocalSettings, 3> finishing = {
    {{LocalMethod::contour, 0.3, 8, 25}, {LocalMethod::contour, 0.3, 4, 25}, {LocalMethod::contour, 0.3, 16, 25}}};

/// Candidate pairs of triangles for the penalty, gathered with some room and kept until a vertex has used it up.
class Candidates {
 public:
  Candidates(const Patch& patch, double margin, double reach)
      : patch_(patch), margin_(margin), largest_reach_(reach), reach_(reach) {}

  /// True where `pairs` has changed.
  bool update(const Positions& x, std::vector<MinkowskiPenalty::Pair>& pairs) {
    if (gathered_.cols() == x.cols()) {
      const double motion = std::sqrt((x - gathered_).leftCols(patch_.free_count).colwise().squaredNorm().maxCoeff());
      if (motion <= reach_) return false;
      // Room that the next step would use up at once only costs.
      reach_ = motion > 2 * largest_reach_ ? 0 : largest_reach_;
    }
    gathered_ = x;
    boxes_.resize(patch_.triangles.size());
    const double room = 0.5 * margin_ + reach_;
    for (std::size_t t = 0; t < boxes_.size(); ++t) boxes_[t] = box_of(x, patch_.triangles[t]).inflated(room);
    bvh_.build(boxes_);
    std::vector<std::vector<MinkowskiPenalty::Pair>> found(bvh_.task_count());
    bvh_.self_pairs_parallel([&](Index task, Index a, Index b) {
      if (a < patch_.active_count || b < patch_.active_count) found[task].push_back({std::min(a, b), std::max(a, b)});
    });
    pairs.clear();
    for (const auto& list : found) pairs.insert(pairs.end(), list.begin(), list.end());
    return true;
  }

 private:
  const Patch& patch_;
  double margin_, largest_reach_, reach_;
  Positions gathered_;
  std::vector<Box> boxes_;
  Bvh bvh_;
};

/// 2 (L + locality A/S) on the free vertices, the fixed ones held, factorised once.
class LaplacianMetric {
 public:
  LaplacianMetric(const Patch& patch, const Arap& arap, double locality) : n_(patch.free_count) {
    std::vector<double> diagonal(n_, 0.0);
    double total = 0;
    for (Index t = 0; t < patch.active_count; ++t) {
      const double area = triangle_area(patch.rest, patch.triangles[t]);
      total += area;
      for (const Index v : patch.triangles[t]) {
        if (v < n_) diagonal[v] += area / 3;
      }
    }
    // Never nothing at all: a vertex of zero-area faces, or a patch of them, still needs a finite metric.
    const double least = 1e-9 / std::max<Index>(1, n_);
    for (double& d : diagonal) d = 2 * locality * std::max(total > 0 ? d / total : 0, least);
    std::vector<Eigen::Triplet<double>> entries;
    for (const Arap::WeightedEdge& e : arap.edges()) {
      const double w = 2 * e.weight;
      if (e.i < n_) diagonal[e.i] += w;
      if (e.j < n_) diagonal[e.j] += w;
      if (e.i < n_ && e.j < n_) entries.emplace_back(e.j, e.i, -w);
    }
    for (Index v = 0; v < n_; ++v) entries.emplace_back(v, v, diagonal[v]);
    Eigen::SparseMatrix<double> matrix(n_, n_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(matrix);
  }
  bool ok() const { return factor_.info() == Eigen::Success; }
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
    const Eigen::MatrixX3d columns = Eigen::Map<const Eigen::Matrix3Xd>(v.data(), 3, n_).transpose();
    const Eigen::MatrixX3d solved = factor_.solve(columns);
    out.resize(v.size());
    Eigen::Map<Eigen::Matrix3Xd>(out.data(), 3, n_) = solved.transpose();
  }

 private:
  Index n_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

/// The shape-level term: which clusters repel, how far, and the force on the vertices.
class ShapeRepulsion {
 public:
  ShapeRepulsion(const Patch& patch, const FlowOptions& options, double spacing)
      : patch_(patch), options_(options), samples_(patch.triangles, patch.rest, patch.free_count, spacing) {
    gaussian_.squared_bandwidth.assign(samples_.size(), bandwidth() * bandwidth());
  }
  double spacing() const { return samples_.spacing(); }

  /// Chooses the interacting pairs at x. The energy changes.
  void refresh(const Positions& x) {
    samples_.points(x, points_);
    gaussian_.pairs.clear();
    for (const auto& [i, j] : pairs_within<3>(points_, options_.cutoff * bandwidth())) {
      if ((!samples_.is_free(i) && !samples_.is_free(j)) || samples_.adjacent(i, j)) continue;
      gaussian_.pairs.push_back({i, j, samples_.area(i) * samples_.area(j)});
    }
  }

  /// Adds the gradient.
  double value_and_gradient(const Positions& x, Positions& gradient) {
    samples_.points(x, points_);
    point_gradient_ = Positions::Zero(3, samples_.size());
    const double value = gaussian_.value_and_gradient(points_, point_gradient_, 1);
    samples_.spread(point_gradient_, gradient);
    return value;
  }

 private:
  double bandwidth() const { return options_.bandwidth * spacing(); }

  const Patch& patch_;
  const FlowOptions& options_;
  FlowSamples samples_;
  GaussianContact<3> gaussian_;
  Positions points_, point_gradient_;
};

class Flow {
 public:
  Flow(Patch& patch, const std::function<bool()>& stop, std::span<const IntersectingPair> tolerated,
       const FlowOptions& options)
      : patch_(patch),
        stop_(stop),
        tolerated_(tolerated),
        options_(options),
        n_(patch.free_count),
        h_(patch.edge_length),
        finder_(patch.triangles, patch.active_count),
        active_(patch.triangles.data(), static_cast<std::size_t>(patch.active_count)),
        arap_(active_, patch.rest, patch.free_count),
        metric_(patch, arap_, options.locality),
        penalty_(patch.triangles, {.margin = options.margin * h_, .vertex_trim = options.vertex_trim}),
        candidates_(patch, options.margin * h_, options.candidate_reach * h_),
        lbfgs_(Lbfgs::default_memory,
               [this](const Eigen::VectorXd& v, Eigen::VectorXd& out) { metric_.apply(v, out); }) {
    Box box;
    for (const Triangle& t : active_) box.extend(box_of(patch.rest, t));
    diagonal_ = box.diagonal();
  }

  FlowResult run() {
    FlowResult result;
    patch_.x.leftCols(n_) = patch_.rest.leftCols(n_);
    full_ = patch_.x;
    std::vector<IntersectingPair> pairs = find(full_);
    result.pairs_left = pairs.size();
    result.clean = pairs.empty();
    if (result.clean || n_ == 0 || !(h_ > 0) || !metric_.ok()) return result;
    for (Index v = 0; v < n_; ++v) {
      for (int k = 0; k < 3; ++k) full_(k, v) += options_.jitter * h_ * jitter_of(v, k);
    }
    best_ = patch_.x;
    make_shape(std::max(options_.spacing_edges * h_, options_.spacing_rel * diagonal_));
    finish_tried_ = pairs.size();
    pairs = find(full_);
    x_ = Eigen::Map<const Eigen::VectorXd>(full_.data(), 3 * n_);
    evaluate_mesh(x_);
    refresh();
    for (;; ++result.iterations) {
      record_iteration(pairs.size());
      if (pairs.size() < result.pairs_left) {
        result.pairs_left = pairs.size();
        best_ = full_;
      }
      if (pairs.empty() && !has_squeezed_face(patch_, patch_.rest, full_, options_.area_floor)) {
        result.clean = true;
        break;
      }
      if (stop_ && stop_()) break;
      const bool stall = stalled(pairs.size());
      if (2 * pairs.size() <= finish_tried_ && !pairs.empty() && finish(full_)) {
        result.clean = true;
        break;
      }
      if (stall && !coarsen(pairs.size())) break;
      if (!step()) break;
      unpack(x_);
      pairs = find(full_);
      refresh();
    }
    // One last try from the best state.
    if (!result.clean && !(stop_ && stop_()) && 2 * result.pairs_left <= finish_tried_) {
      full_ = best_;
      result.clean = finish(full_);
    }
    if (result.clean) result.pairs_left = 0;
    patch_.x = result.clean ? full_ : best_;
    if (result.clean) {
      shrink_displacement(patch_, patch_.rest, options_.bisections, [&](const Positions& y) {
        return find(y).empty() && !has_squeezed_face(patch_, patch_.rest, y, options_.area_floor);
      });
    }
    return result;
  }

 private:
  std::vector<IntersectingPair> find(const Positions& x) { return pairs_to_resolve(finder_, x, tolerated_); }

  void make_shape(double spacing) { shape_ = std::make_unique<ShapeRepulsion>(patch_, options_, spacing); }

  void record_iteration(std::size_t pairs) {
    IterationRecord iteration{.pairs = pairs};
    iteration[EnergyTerm::arap] = arap_value_;
    iteration[EnergyTerm::minkowski] = options_.lambda_minkowski * penalty_value_;
    iteration[EnergyTerm::gaussian] = value_ - arap_value_ - options_.lambda_minkowski * penalty_value_;
    record(patch_, full_, iteration);
    if (patch_.progress) patch_.progress->set_pairs(pairs);
  }

  double cap() const { return std::max(h_, 0.5 * shape_->spacing()); }

  void unpack(const Eigen::VectorXd& x) { full_.leftCols(n_) = Eigen::Map<const Positions>(x.data(), 3, n_); }

  // The terms that do not change between iterations, at x: mesh_value_, mesh_gradient_.
  void evaluate_mesh(const Eigen::VectorXd& x) {
    unpack(x);
    candidates_.update(full_, penalty_.pairs);
    arap_gradient_ = Positions::Zero(3, full_.cols());
    arap_value_ = arap_.value_and_gradient(full_, arap_gradient_);
    penalty_gradient_ = Positions::Zero(3, full_.cols());
    penalty_value_ = penalty_.value_and_gradient(full_, penalty_gradient_, h_);
  }

  double total(Eigen::VectorXd& gradient) {
    Positions sum = arap_gradient_ + options_.lambda_minkowski * penalty_gradient_;
    double value = arap_value_ + options_.lambda_minkowski * penalty_value_;
    value += shape_->value_and_gradient(full_, sum);
    gradient = Eigen::Map<const Eigen::VectorXd>(sum.data(), 3 * n_);
    return value;
  }

  double objective(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    evaluate_mesh(x);
    return total(gradient);
  }

  // A new objective at the point reached: only the shape-level term has to be evaluated again.
  void refresh() {
    shape_->refresh(full_);
    value_ = total(gradient_);
  }

  bool step() {
    Eigen::VectorXd d;
    lbfgs_.direction(gradient_, d);
    const double fastest = largest_block_norm(d, 3);
    if (!(fastest > 0) || !std::isfinite(fastest)) return false;
    LineSearchOptions search;
    search.stop = stop_;
    search.first_step = std::min(1.0, cap() / fastest);
    search.accept_step = std::min(search.first_step, options_.accept_motion * h_ / fastest);
    const Eigen::VectorXd old_x = x_, old_gradient = gradient_;
    const LineSearchResult found = backtrack(
        [this](const Eigen::VectorXd& y, Eigen::VectorXd& g) { return objective(y, g); }, d, search, x_, value_,
        gradient_, [this](const Eigen::VectorXd&) { return penalty_.overlaps() == 0 && find(full_).empty(); });
    if (!(found.step > 0)) return false;
    if (found.sufficient) {
      lbfgs_.remember(x_ - old_x, gradient_ - old_gradient);
    } else {
      lbfgs_.clear();
    }
    return true;
  }

  // The contour method from x on; x is the result where it is clean, else unchanged.
  bool finish(Positions& x) {
    finish_tried_ = find(x).size();
    int iterations = 0;
    for (const LocalSettings& settings : finishing)
      if (finish_by_contours(patch_, x, finder_, settings, tolerated_, {0, options_.area_floor}, stop_, iterations))
        return true;
    return false;
  }

  // No sufficient drop of the number of pairs for some iterations.
  bool stalled(std::size_t count) {
    if (count == 0 || static_cast<double>(count) <= (1 - options_.stall_drop) * reference_) {
      reference_ = static_cast<double>(count);
      waited_ = 0;
      return false;
    }
    return ++waited_ >= options_.stall_iterations;
  }

  // Repels coarser clusters, from a state with so many pairs. False: there are none.
  bool coarsen(std::size_t count) {
    reference_ = static_cast<double>(count);
    waited_ = 0;
    lbfgs_.clear();
    const double coarser = options_.spacing_growth * shape_->spacing();
    if (coarser > options_.max_spacing_rel * diagonal_) return false;
    make_shape(coarser);
    refresh();
    return true;
  }

  Patch& patch_;
  const std::function<bool()>& stop_;
  std::span<const IntersectingPair> tolerated_;
  const FlowOptions& options_;
  Index n_;
  double h_, diagonal_ = 0;
  IntersectionFinder finder_;
  std::span<const Triangle> active_;
  Arap arap_;
  LaplacianMetric metric_;
  MinkowskiPenalty penalty_;
  Candidates candidates_;
  std::unique_ptr<ShapeRepulsion> shape_;
  Lbfgs lbfgs_;

  Positions full_, best_;
  Positions arap_gradient_, penalty_gradient_;
  double arap_value_ = 0, penalty_value_ = 0;
  Eigen::VectorXd x_, gradient_;
  double value_ = 0;
  double reference_ = std::numeric_limits<double>::infinity();
  int waited_ = 0;
  std::size_t finish_tried_ = 0;  // pairs there were at the start, or when finishing last failed
};

}  // namespace

FlowResult flow(Patch& patch, const std::function<bool()>& stop, std::span<const IntersectingPair> tolerated,
                const FlowOptions& options) {
  return Flow(patch, stop, tolerated, options).run();
}

}  // namespace unsnarl
