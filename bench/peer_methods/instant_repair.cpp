// Jang, Jung, Lee, Lee: "Instant Self-Intersection Repair for 3D Meshes", ACM Transactions on Graphics (2025).
//
// A signed tangent-point energy between the triangles that intersect pushes each triangle's corners to the front of the
// other; its gradient is spread over the surface by optimising u = (0.01 I + 0.99 L) x in place of x, L the cotangent
// Laplacian of the input; steps follow the mean of past gradients, which is forgotten, vertex by vertex, where the
// gradient leaves three standard deviations around it; changes of L x are penalised ("curvature"). Constants and the
// stopping rule (60 iterations, of which the best is kept) are those the authors publish with their program.
// Deviations: double precision; all pairs of a triangle count, not eight at most; on meshes of fewer than 1,300
// vertices the penalty is lowered to what steps of that length can bear, since they diverge there.
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "cotangent_laplacian.h"
#include "mesh/areas.h"
#include "peer.h"

namespace unsnarl::peers {
namespace {

struct InstantRepairOptions {
  double size = 16.5;             // of the largest coordinate less the smallest, over all axes, after scaling
  double diffusion = 0.99;        // share of the Laplacian in the change of variables
  double learning_rate = 0.001;   // times the doubled mean of the gradients
  double mean_decay = 0.99;       // of the mean of the gradients, a step
  double square_decay = 0.999;    // of the mean of their squares
  double band = 3;                // standard deviations that the gradient may be away from the mean
  int steps_before_band = 10;     // steps before the band counts
  double curvature_weight = 1e6;  // of the mean squared change of L x
  int most_iterations = 60;
};

class InstantRepair : public Peer {
 public:
  InstantRepair(const Start& start, const InstantRepairOptions& options)
      : options_(options), triangles_(start.triangles), laplacian_(cotangent_laplacian(start.rest, start.triangles)) {
    const double range = start.rest.maxCoeff() - start.rest.minCoeff();
    scale_ = range > 0 ? options_.size / range : 1;
    const Index n = static_cast<Index>(start.rest.cols());
    SparseMatrix identity(n, n);
    identity.setIdentity();
    const SparseMatrix system = (1 - options_.diffusion) * identity + options_.diffusion * laplacian_;
    solver_.compute(system);
    const Eigen::MatrixX3d x = scale_ * start.rest.transpose();
    u_ = system * x;
    rest_laplacian_ = laplacian_ * x;
    mean_.setZero(n, 3);
    square_.setZero(n, 3);
  }

  bool sees(PairClass kind) const override { return kind == PairClass::disjoint; }
  int most_iterations() const override { return options_.most_iterations; }

  bool step(const std::vector<IntersectingPair>& pairs, Positions& x) override {
    if (solver_.info() != Eigen::Success) return false;
    const Positions scaled = scale_ * x;
    Eigen::MatrixX3d gradient = penetration_gradient(pairs, scaled);
    const Eigen::MatrixX3d bent = laplacian_ * scaled.transpose() - rest_laplacian_;
    // A step multiplies a bent mode by 1 - 4 rate weight / (3 n), or nearly so.
    const double entries = static_cast<double>(bent.size());
    const double weight = std::min(options_.curvature_weight, entries / (4 * options_.learning_rate));
    gradient += weight * 2 / entries * (laplacian_ * bent);
    descend(solver_.solve(gradient));
    x = solver_.solve(u_).transpose() / scale_;
    return true;
  }

 private:
  /// The gradient of the penetration: area(b) times the cosine between the normal of b and the way from each corner of
  /// a to the centre of b, summed over pairs and both orders of each. Areas and normals count as constants.
  Eigen::MatrixX3d penetration_gradient(const std::vector<IntersectingPair>& pairs, const Positions& x) const {
    Eigen::MatrixX3d gradient = Eigen::MatrixX3d::Zero(x.cols(), 3);
    for (const IntersectingPair& pair : pairs) {
      for (const auto& [a, b] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
        const Triangle& other = triangles_[b];
        const Vec3 normal = triangle_normal(x, other);
        const double area = triangle_area(x, other);
        const Vec3 centre = (x.col(other[0]) + x.col(other[1]) + x.col(other[2])) / 3;
        for (Index v : triangles_[a]) {
          const Vec3 way = centre - x.col(v);
          const double length = way.norm();
          if (!(length > 0)) continue;
          const Vec3 force = area / length * (normal - way * (way.dot(normal) / (length * length)));
          gradient.row(v) -= force.transpose();
          for (Index w : other) gradient.row(w) += force.transpose() / 3;
        }
      }
    }
    return gradient;
  }

  /// A step of u along the mean of the gradients so far.
  void descend(const Eigen::MatrixX3d& gradient) {
    ++steps_;
    const double mean_share = 1 - std::pow(options_.mean_decay, steps_);
    const double square_share = 1 - std::pow(options_.square_decay, steps_);
    for (Eigen::Index v = 0; v < gradient.rows(); ++v) {
      double decay = options_.mean_decay;
      if (steps_ > options_.steps_before_band && !is_within_band(gradient, v, mean_share, square_share)) decay = 0;
      mean_.row(v) = decay * mean_.row(v) + (1 - decay) * gradient.row(v);
      square_.row(v) = options_.square_decay * square_.row(v) +
                       (1 - options_.square_decay) * gradient.row(v).array().square().matrix();
    }
    u_ -= options_.learning_rate * 2 / mean_share * mean_;
  }

  bool is_within_band(const Eigen::MatrixX3d& gradient, Eigen::Index v, double mean_share, double square_share) const {
    for (int k = 0; k < 3; ++k) {
      const double mean = mean_(v, k) / mean_share;
      const double variance = square_(v, k) / square_share - mean * mean;
      if (!(variance >= 0) || std::abs(gradient(v, k) - mean) > options_.band * std::sqrt(variance)) return false;
    }
    return true;
  }

  InstantRepairOptions options_;
  std::span<const Triangle> triangles_;
  SparseMatrix laplacian_;
  Eigen::SimplicialLDLT<SparseMatrix> solver_;
  double scale_ = 1;
  Eigen::MatrixX3d u_, rest_laplacian_;  // of the scaled positions, a row a vertex
  Eigen::MatrixX3d mean_, square_;       // of the gradients and of their squares, decayed
  int steps_ = 0;
};

}  // namespace

std::unique_ptr<Peer> make_instant_repair(const Start& start) {
  return std::make_unique<InstantRepair>(start, InstantRepairOptions{});
}

std::unique_ptr<Peer> make_long_instant_repair(const Start& start) {
  InstantRepairOptions options;
  // As in Minarcik, Liu, Crane, Li: "Untangling Surfaces via Shape and Mesh Repulsion", §5.2.
  options.most_iterations = 15000;
  return std::make_unique<InstantRepair>(start, options);
}

}  // namespace unsnarl::peers
