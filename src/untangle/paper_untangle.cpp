#include "untangle/paper_untangle.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact/bvh.h"
#include "contact/intersection_finder.h"
#include "energy/arap.h"
#include "energy/gaussian_bandwidth.h"
#include "energy/gaussian_contact.h"
#include "energy/intersection_length.h"
#include "energy/minkowski_penalty.h"
#include "energy/polygon_penalty.h"
#include "geometry/portable_math.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"
#include "optimize/lbfgs.h"
#include "scene/trajectory.h"

namespace unsnarl {
namespace {

/// Least bandwidth. Between vertices at one place it would fall to zero, and their energy would be 0/0. [E148] (unit:
/// mean edges)
constexpr double smallest_bandwidth = 0.01;

std::vector<std::vector<Index>> faces_of(const Patch& patch, std::span<const Index> face_of) {
  std::vector<Index> face;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t)
    face.push_back(face_of.empty() ? static_cast<Index>(t) : face_of[patch.faces[t]]);
  return convex_faces(patch.triangles, face, patch.rest);
}

class PaperUntangle {
 public:
  PaperUntangle(Patch& patch, const PaperOptions& options, std::span<const Index> face_of)
      : patch_(patch),
        options_(options),
        n_(patch.free_count),
        triangles_(patch.triangles),
        scale_(1 / (patch.rest.rowwise().maxCoeff() - patch.rest.rowwise().minCoeff()).maxCoeff()),
        full_(scaled_start(patch, scale_)),
        rest_(full_),
        edge_(mean_edge_length(rest_, triangles_)),
        neighbours_(vertex_neighbours(build_edges(triangles_).edges, static_cast<Index>(rest_.cols()))),
        arap_(active(), rest_, n_),
        penalty_(triangles_, {.one_vertex = false, .folded = false}),
        polygon_penalty_(faces_of(patch, face_of)),
        whole_polygons_(options.whole_polygons && options.mesh_energy == PaperMeshEnergy::penetration_depth &&
                        polygon_penalty_.polygons().size() < triangles_.size()),
        finder_(triangles_, patch.active_count) {
    finder_.expect_small_steps();
    squared_bandwidth_.resize(rest_.cols());
    for (Index v = 0; v < rest_.cols(); ++v) {
      double length = 0;
      for (const Index u : neighbours_[v]) length += (rest_.col(u) - rest_.col(v)).norm();
      const std::size_t count = neighbours_[v].size();
      const double start = options.start_bandwidth * (count > 0 ? length / static_cast<double>(count) : edge_);
      squared_bandwidth_[v] = start * start;
    }
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
    options.line_search.accept_step = options.line_search.smallest_step;
    options.line_search.stop = stop;
    gaussian_.independent = options_.bandwidth == PaperBandwidth::independent;
    const auto objective = [this](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) { return value(x, gradient); };
    const LbfgsResult found = minimize_lbfgs(objective, x_, options, {}, [&](LbfgsIteration& state) {
      unpack(state.x);
      result.disjoint_left = count_disjoint();
      if (patch_.trajectory) record_iteration(result.disjoint_left);
      if (result.disjoint_left == 0 || (stop && stop())) return true;
      if (state.iteration == 0) return false;
      if (state.iteration % options_.area_refresh == 0) {
        refresh_areas();
        faces_tree_ = {};
      }
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
    const std::vector<double> bandwidths = free_bandwidths();
    result.mean_bandwidth = mean(bandwidths);
    if (patch_.trajectory) patch_.trajectory->bandwidths = bandwidths;
    if (found.iterations > 0) patch_.x.leftCols(n_) = full_.leftCols(n_) / scale_;
    return result;
  }

 private:
  static double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }

  /// In the units of the patch.
  std::vector<double> free_bandwidths() const {
    std::vector<double> bandwidths;
    for (Index v = 0; v < n_; ++v)
      bandwidths.push_back(options_.bandwidth_scale * std::sqrt(squared_bandwidth_[v]) / scale_);
    return bandwidths;
  }

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
    const std::vector<double> bandwidths = free_bandwidths();
    const auto [smallest, largest] = std::minmax_element(bandwidths.begin(), bandwidths.end());
    iteration.bandwidth = {*smallest, mean(bandwidths), *largest};
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
  double squared_reach(Index i, Index j, double factor) const {
    return factor * factor * 0.5 * (squared_bandwidth_[i] + squared_bandwidth_[j]);
  }

  // Pairs within so many of their own bandwidths (§3.5.4). Weights: 0 for adjacent vertices, else 1 (§3.5.2).
  void gather_neighbours() {
    gaussian_.pairs.clear();
    if (options_.lambda_gaussian == 0) return;
    const double factor = options_.neighbourhood * std::max(1.0, options_.bandwidth_scale);
    // As eps_ij <= (eps_i + eps_j) / sqrt(2), the boxes of such pairs overlap.
    boxes_.assign(full_.cols(), {});
    for (Index v = 0; v < full_.cols(); ++v) {
      boxes_[v].extend(Vec3(full_.col(v)));
      boxes_[v] = boxes_[v].inflated(factor * std::sqrt(0.5 * squared_bandwidth_[v]));
    }
    const Bvh bvh(boxes_);
    std::vector<std::vector<GaussianContact<3>::Pair>> found(bvh.task_count());
    bvh.self_pairs_parallel([&](Index task, Index i, Index j) {
      if (i >= n_ && j >= n_) return;
      if ((full_.col(i) - full_.col(j)).squaredNorm() > squared_reach(i, j, factor)) return;
      const std::span<const Index> around = neighbours_[i];
      if (std::binary_search(around.begin(), around.end(), j)) return;
      found[task].push_back({std::min(i, j), std::max(i, j), areas_[i] * areas_[j]});
    });
    for (const auto& pairs : found) gaussian_.pairs.insert(gaussian_.pairs.end(), pairs.begin(), pairs.end());
  }

  // What the bandwidths are found from does not depend on how they are scaled.
  std::vector<BandwidthPair> bandwidth_pairs() const {
    std::vector<BandwidthPair> pairs;
    pairs.reserve(gaussian_.pairs.size());
    for (const auto& [i, j, w] : gaussian_.pairs) {
      const double squared = (full_.col(i) - full_.col(j)).squaredNorm();
      if (squared <= squared_reach(i, j, options_.neighbourhood)) pairs.push_back({i, j, squared, w});
    }
    return pairs;
  }

  BandwidthOptions bandwidth_options(int iterations) const {
    BandwidthOptions options;
    options.damping = options_.damping;
    options.max_iterations = iterations;
    options.smallest = smallest_bandwidth * edge_;
    return options;
  }

  void start_bandwidths() {
    if (options_.bandwidth == PaperBandwidth::global) {
      const std::vector<GlobalBandwidth> maxima =
          global_bandwidths(bandwidth_pairs(), bandwidth_options(options_.start_iterations));
      // A clamped maximum is not stationary: the energy of vertices at one place grows down to the least bandwidth.
      const auto found =
          std::find_if(maxima.begin(), maxima.end(), [](const GlobalBandwidth& m) { return !m.clamped; });
      if (!maxima.empty()) set_global((found != maxima.end() ? *found : maxima.front()).epsilon);
    } else {
      adapt(options_.start_iterations);
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
    if (options_.bandwidth == PaperBandwidth::symmetric) {
      symmetric_local_bandwidths(pairs, squared_bandwidth_, bandwidth_options(iterations));
      return;
    }
    if (options_.bandwidth == PaperBandwidth::independent) {
      independent_local_bandwidths(pairs, squared_bandwidth_, bandwidth_options(iterations));
      return;
    }
    // The damped global iteration (App. B.1), from where it stands.
    const BandwidthOptions options = bandwidth_options(iterations);
    double squared = squared_bandwidth_.front();
    for (int k = 0; k < iterations; ++k) {
      double m0 = 0, m2 = 0;
      for (const BandwidthPair& pair : pairs) {
        const double term = pair.weight * portable::exp(-pair.squared_distance / squared);
        m0 += term;
        m2 += term * pair.squared_distance;
      }
      if (!(m0 > 0)) break;
      squared = (1 - options.damping) * squared + options.damping * 2 * m2 / (options.exponent * m0);
      squared = std::max(squared, options.smallest * options.smallest);
    }
    set_global(std::sqrt(squared));
  }

  double value(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    unpack(x);
    Positions sum = Positions::Zero(3, full_.cols());
    terms_[EnergyTerm::gaussian] = gaussian_.value_and_gradient(full_, sum, options_.lambda_gaussian);
    terms_[EnergyTerm::minkowski] = mesh_energy(sum);
    terms_[EnergyTerm::arap] = arap_.value_and_gradient(full_, sum, options_.lambda_arap);
    gradient = Eigen::Map<const Eigen::VectorXd>(sum.data(), 3 * n_);
    return terms_[EnergyTerm::gaussian] + terms_[EnergyTerm::minkowski] + terms_[EnergyTerm::arap];
  }

  double mesh_energy(Positions& gradient) {
    const double weight = options_.lambda_mesh * edge_;
    if (weight == 0) return 0;
    if (whole_polygons_) {
      find_overlapping(polygon_penalty_.polygons(), polygon_penalty_.pairs);
      return polygon_penalty_.value_and_gradient(full_, gradient, weight);
    }
    find_overlapping(triangles_, penalty_.pairs);
    if (options_.mesh_energy == PaperMeshEnergy::intersection_length)
      return intersection_length(full_, triangles_, penalty_.pairs, gradient, weight);
    return penalty_.value_and_gradient(full_, gradient, weight);
  }

  /// Pairs of faces whose boxes overlap and of which one can move.
  template <class Faces>
  void find_overlapping(const Faces& faces, std::vector<std::array<Index, 2>>& pairs) {
    boxes_.assign(faces.size(), {});
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const Index v : faces[f]) boxes_[f].extend(Vec3(full_.col(v)));
    if (faces_tree_.size() == static_cast<Index>(boxes_.size()))
      faces_tree_.refit(boxes_);
    else
      faces_tree_.build(boxes_);
    const auto can_move = [&](Index f) {
      return std::any_of(faces[f].begin(), faces[f].end(), [this](Index v) { return v < n_; });
    };
    pairs.clear();
    faces_tree_.self_pairs([&](Index a, Index b) {
      if (can_move(a) || can_move(b)) pairs.push_back({std::min(a, b), std::max(a, b)});
    });
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
  PolygonPenalty polygon_penalty_;
  bool whole_polygons_;  // else their triangles
  IntersectionFinder finder_;
  GaussianContact<3> gaussian_;
  std::vector<double> squared_bandwidth_;  // eps_i^2 as found, before they are scaled
  std::vector<double> areas_;
  std::vector<Box> boxes_;
  Bvh faces_tree_;  // of all boxes of faces; built anew with the areas, fitted to the faces in between
  Eigen::VectorXd x_;
  IterationRecord terms_;  // of the energy, where it was last evaluated
};

}  // namespace

PaperResult paper_untangle(Patch& patch, const PaperOptions& options, std::span<const Index> face_of,
                           const std::function<bool()>& stop) {
  if (patch.free_count == 0 || patch.triangles.empty()) return {};
  return PaperUntangle(patch, options, face_of).run(stop);
}

void check_paper_options(const PaperOptions& options) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("PaperOptions: ") + what);
  };
  const auto is_weight = [](double weight) { return weight >= 0 && std::isfinite(weight); };
  const auto is_factor = [](double factor) { return factor > 0 && std::isfinite(factor); };
  require(is_weight(options.lambda_gaussian) && is_weight(options.lambda_mesh) && is_weight(options.lambda_arap),
          "weights must not be negative");
  require(is_factor(options.bandwidth_scale) && is_factor(options.start_bandwidth) && is_factor(options.neighbourhood),
          "bandwidths and neighbourhoods must be positive");
  require(options.damping > 0 && options.damping <= 1, "damping is greater than 0 and at most 1");
  require(options.start_iterations >= 0 && options.max_iterations >= 0, "iterations must not be negative");
  require(options.area_refresh >= 1 && options.memory >= 1, "area_refresh and memory are at least 1");
}

}  // namespace unsnarl
