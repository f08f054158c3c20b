#include "untangle/paper_untangle.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/bvh.h"
#include "contact/intersection_finder.h"
#include "energy/arap.h"
#include "energy/gaussian_bandwidth.h"
#include "energy/gaussian_contact.h"
#include "energy/intersection_length.h"
#include "energy/minkowski_penalty.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"
#include "optimize/lbfgs.h"
#include "scene/trajectory.h"

namespace unsnarl {
namespace {

class PaperUntangle {
 public:
  PaperUntangle(Patch& patch, const PaperOptions& options)
      : patch_(patch),
        options_(options),
        n_(patch.free_count),
        triangles_(patch.triangles),
        scale_(1 / (patch.rest.rowwise().maxCoeff() - patch.rest.rowwise().minCoeff()).maxCoeff()),
        full_(scaled_start(patch, scale_)),
        rest_(full_),
        edge_(mean_edge_length(rest_, triangles_)),
        neighbours_(vertex_neighbours(build_edges(triangles_).edges, static_cast<Index>(rest_.cols()))),
        arap_(active(), rest_, n_, {.weights = ArapWeights::cotangent}),
        penalty_(triangles_, {.one_vertex = false, .folded = false}),
        finder_(triangles_, patch.active_count) {
    const double start = options.start_bandwidth * edge_;
    squared_bandwidth_.assign(rest_.cols(), start * start);
  }

  PaperResult run(const std::function<bool()>& stop) {
    PaperResult result;
    x_ = Eigen::Map<const Eigen::VectorXd>(full_.data(), 3 * n_);
    refresh_areas();
    gather_neighbours();
    start_bandwidths();
    LbfgsOptions options;
    options.memory = options_.memory;
    options.max_iterations = options_.max_iterations;
    const auto objective = [this](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) { return value(x, gradient); };
    const LbfgsResult found = minimize_lbfgs(objective, x_, options, {}, [&](LbfgsIteration& state) {
      unpack(state.x);
      result.disjoint_left = count_disjoint();
      if (patch_.trajectory) record_iteration(result.disjoint_left);
      if (result.disjoint_left == 0 || (stop && stop())) return true;
      if (state.iteration == 0) return false;
      if (state.iteration % options_.area_refresh == 0) refresh_areas();
      gather_neighbours();
      if (options_.adaptive) {
        adapt(1);
        use_bandwidths();
      }
      state.objective_changed = true;
      return false;
    });
    unpack(x_);
    result.disjoint_left = count_disjoint();
    result.clean = result.disjoint_left == 0;
    result.iterations = found.iterations;
    result.evaluations = found.evaluations;
    for (const double squared : squared_bandwidth_) result.mean_bandwidth += std::sqrt(squared);
    result.mean_bandwidth *= options_.bandwidth_scale / (scale_ * static_cast<double>(squared_bandwidth_.size()));
    if (found.iterations > 0) patch_.x.leftCols(n_) = full_.leftCols(n_) / scale_;
    return result;
  }

 private:
  static Positions scaled_start(const Patch& patch, double scale) {
    Positions start = patch.x;
    start.leftCols(patch.free_count) = patch.rest.leftCols(patch.free_count);
    return scale * start;
  }

  std::span<const Triangle> active() const { return triangles_.first(static_cast<std::size_t>(patch_.active_count)); }
  void unpack(const Eigen::VectorXd& x) { full_.leftCols(n_) = Eigen::Map<const Positions>(x.data(), 3, n_); }

  void record_iteration(std::size_t disjoint_left) {
    IterationRecord iteration = terms_;
    iteration.pairs = disjoint_left;
    record(patch_, full_ / scale_, iteration);
  }

  std::size_t count_disjoint() {
    const std::vector<IntersectingPair> pairs = finder_.find(full_);
    return static_cast<std::size_t>(std::count_if(
        pairs.begin(), pairs.end(), [](const IntersectingPair& pair) { return pair.kind == PairClass::disjoint; }));
  }

  void refresh_areas() {
    areas_.assign(full_.cols(), 0.0);
    for (const Triangle& t : triangles_) {
      for (const Index v : t) areas_[v] += triangle_area(full_, t) / 3;
    }
  }

  void use_bandwidths() {
    gaussian_.squared_bandwidth = squared_bandwidth_;
    for (double& squared : gaussian_.squared_bandwidth) squared *= options_.bandwidth_scale * options_.bandwidth_scale;
  }
  double widest() const { return std::sqrt(*std::max_element(squared_bandwidth_.begin(), squared_bandwidth_.end())); }

  // Weights: 0 for adjacent vertices, else 1 (§3.5.2).
  void gather_neighbours() {
    gaussian_.pairs.clear();
    if (options_.lambda_gaussian == 0) return;
    const double reach = options_.neighbourhood * std::max(1.0, options_.bandwidth_scale) * widest();
    for (const auto& [i, j] : pairs_within<3>(full_, reach)) {
      if (i >= n_ && j >= n_) continue;
      const std::span<const Index> around = neighbours_[i];
      if (std::binary_search(around.begin(), around.end(), j)) continue;
      gaussian_.pairs.push_back({i, j, areas_[i] * areas_[j]});
    }
  }

  // What the bandwidths are found from does not depend on how they are scaled.
  std::vector<BandwidthPair> bandwidth_pairs() const {
    const double reach = options_.neighbourhood * widest();
    std::vector<BandwidthPair> pairs;
    pairs.reserve(gaussian_.pairs.size());
    for (const auto& [i, j, w] : gaussian_.pairs) {
      const double squared = (full_.col(i) - full_.col(j)).squaredNorm();
      if (squared <= reach * reach) pairs.push_back({i, j, squared, w});
    }
    return pairs;
  }

  BandwidthOptions bandwidth_options(int iterations) const {
    BandwidthOptions options;
    options.damping = options_.damping;
    options.max_iterations = iterations;
    options.smallest = 0.5 * edge_;
    options.largest = options_.largest_bandwidth * edge_;
    return options;
  }

  void start_bandwidths() {
    if (options_.scope == BandwidthScope::global) {
      const std::vector<GlobalBandwidth> maxima =
          global_bandwidths(bandwidth_pairs(), bandwidth_options(options_.bandwidth_iterations));
      if (!maxima.empty()) set_global(maxima.front().epsilon);
    } else {
      adapt(options_.bandwidth_iterations);
    }
    use_bandwidths();
    gather_neighbours();
  }

  void set_global(double epsilon) {
    std::fill(squared_bandwidth_.begin(), squared_bandwidth_.end(), epsilon * epsilon);
  }

  void adapt(int iterations) {
    const std::vector<BandwidthPair> pairs = bandwidth_pairs();
    if (pairs.empty()) return;
    if (options_.scope == BandwidthScope::local) {
      symmetric_local_bandwidths(pairs, squared_bandwidth_, bandwidth_options(iterations));
      return;
    }
    // The damped global iteration (App. B.1), from where it stands.
    const BandwidthOptions options = bandwidth_options(iterations);
    double squared = squared_bandwidth_.front();
    for (int k = 0; k < iterations; ++k) {
      double m0 = 0, m2 = 0;
      for (const BandwidthPair& pair : pairs) {
        const double term = pair.weight * std::exp(-pair.squared_distance / squared);
        m0 += term;
        m2 += term * pair.squared_distance;
      }
      if (!(m0 > 0)) break;
      squared = (1 - options.damping) * squared + options.damping * 2 * m2 / (options.exponent * m0);
      squared = std::clamp(squared, options.smallest * options.smallest, options.largest * options.largest);
    }
    set_global(std::sqrt(squared));
  }

  double value(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    unpack(x);
    boxes_.resize(triangles_.size());
    for (std::size_t t = 0; t < boxes_.size(); ++t) boxes_[t] = box_of(full_, triangles_[t]);
    bvh_.build(boxes_);
    penalty_.pairs.clear();
    bvh_.self_pairs([&](Index a, Index b) {
      if (a < patch_.active_count || b < patch_.active_count)
        penalty_.pairs.push_back({std::min(a, b), std::max(a, b)});
    });
    Positions sum = Positions::Zero(3, full_.cols());
    terms_[EnergyTerm::gaussian] = gaussian_.value_and_gradient(full_, sum, options_.lambda_gaussian);
    terms_[EnergyTerm::minkowski] = mesh_energy(sum);
    terms_[EnergyTerm::arap] = arap_.value_and_gradient(full_, sum, options_.lambda_arap);
    gradient = Eigen::Map<const Eigen::VectorXd>(sum.data(), 3 * n_);
    return terms_[EnergyTerm::gaussian] + terms_[EnergyTerm::minkowski] + terms_[EnergyTerm::arap];
  }

  double mesh_energy(Positions& gradient) {
    if (options_.lambda_minkowski == 0) return 0;
    if (options_.mesh_energy == MeshEnergy::intersection_length)
      return intersection_length(full_, triangles_, penalty_.pairs, gradient, options_.lambda_minkowski);
    return penalty_.value_and_gradient(full_, gradient, options_.lambda_minkowski);
  }

  Patch& patch_;
  const PaperOptions& options_;
  Index n_;
  std::span<const Triangle> triangles_;
  double scale_;
  Positions full_, rest_;
  double edge_;
  IndexLists neighbours_;
  Arap arap_;
  MinkowskiPenalty penalty_;
  IntersectionFinder finder_;
  GaussianContact<3> gaussian_;
  std::vector<double> squared_bandwidth_;  // eps_i^2 as found, before they are scaled
  std::vector<double> areas_;
  std::vector<Box> boxes_;
  Bvh bvh_;
  Eigen::VectorXd x_;
  IterationRecord terms_;  // of the energy, where it was last evaluated
};

}  // namespace

PaperResult paper_untangle(Patch& patch, const PaperOptions& options, const std::function<bool()>& stop) {
  if (patch.free_count == 0 || patch.triangles.empty()) return {};
  return PaperUntangle(patch, options).run(stop);
}

}  // namespace unsnarl
