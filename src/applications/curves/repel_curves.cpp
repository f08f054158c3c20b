#include "applications/curves/repel_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "energy/gaussian_bandwidth.h"
#include "geometry/portable_math.h"
#include "optimize/lbfgs.h"

namespace unsnarl {
namespace {

using Map = Eigen::Map<const Points2>;

class Repulsion {
 public:
  Repulsion(const CurveNet& net, const CurveState& start, const RepelOptions& options)
      : net_(net), options_(options), start_(start.x), tree_(net) {
    double length = 0;
    for (const auto& [a, b] : net.segments) length += (net.rest.col(b) - net.rest.col(a)).norm();
    edge_ = length / net.segment_count();
    if (net.vertex_count() > options.most_points) return;
    gaussian_.pairs = contact_pairs(net, options.nearest_samples * edge_);
    std::vector<BandwidthPair> pairs;
    for (const auto& pair : gaussian_.pairs) {
      const double squared = (start_.col(pair.i) - start_.col(pair.j)).squaredNorm();
      if (squared < portable::pow(options.seen_rel * net.diagonal, 2))
        pairs.push_back({pair.i, pair.j, squared, pair.weight});
    }
    const double least = options.least_bandwidth * edge_;
    const auto maxima = global_bandwidths(pairs, {.exponent = 1, .smallest = least, .starts = options.starts});
    // The lowest maximum of the energy over the scales, which come highest first.
    double epsilon = least;
    if (!maxima.empty())
      epsilon = std::max(least, std::min(maxima.back().epsilon, options.most_bandwidth_rel * net.diagonal));
    const double reach = 9 * epsilon * epsilon;
    std::erase_if(gaussian_.pairs,
                  [&](const auto& pair) { return (start_.col(pair.i) - start_.col(pair.j)).squaredNorm() > reach; });
    gaussian_.squared_bandwidth.assign(net.vertex_count(), epsilon * epsilon);
  }

  double operator()(const Eigen::VectorXd& flat, Eigen::VectorXd& gradient) {
    const Points2 x = Map(flat.data(), 2, net_.vertex_count());
    Points2 g = Points2::Zero(2, net_.vertex_count());
    double value = 0;
    if (!gaussian_.pairs.empty()) value += gaussian_.value_and_gradient(x, g, options_.gaussian / net_.diagonal);
    tree_.refit(x);
    crossings_ = 0;
    tree_.pairs_within(0, [&](Index i, Index j) {
      const Edge &a = net_.segments[i], &b = net_.segments[j];
      if (meeting_of(x, a, b) == SegmentMeeting::none) return;
      ++crossings_;
      if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) return;
      const SegmentPenetration p = segment_penetration(x.col(a[0]), x.col(a[1]), x.col(b[0]), x.col(b[1]));
      if (!(p.depth > 0)) return;
      // Counts as a little deeper, so that segments that just touch are pushed apart.
      value += p.depth + options_.overshoot * edge_;
      for (int k = 0; k < 2; ++k) {
        g.col(a[k]) -= p.weight_a[k] * p.normal;
        g.col(b[k]) += p.weight_b[k] * p.normal;
      }
    });
    for (const auto& [a, b] : net_.segments) {
      const Vec2 rest = start_.col(b) - start_.col(a), d = x.col(b) - x.col(a) - rest;
      const double weight = options_.elastic / std::max(rest.norm(), options_.least_edge * edge_);
      value += 0.5 * weight * d.squaredNorm();
      g.col(a) -= weight * d;
      g.col(b) += weight * d;
    }
    for (Index v = 0; v < net_.vertex_count(); ++v)
      if (net_.fixed[v]) g.col(v).setZero();
    gradient = Eigen::Map<const Eigen::VectorXd>(g.data(), g.size());
    return value;
  }

  std::size_t crossings() const { return crossings_; }

 private:
  const CurveNet& net_;
  const RepelOptions& options_;
  Points2 start_;
  SegmentTree tree_;
  GaussianContact<2> gaussian_;
  double edge_ = 0;
  std::size_t crossings_ = 0;
};

}  // namespace

SegmentPenetration segment_penetration(const Vec2& a0, const Vec2& a1, const Vec2& b0, const Vec2& b1) {
  const std::array<Vec2, 2> a{a0, a1}, b{b0, b1};
  SegmentPenetration best;
  best.depth = std::numeric_limits<double>::infinity();
  for (const bool of_a : {true, false}) {
    const Vec2 edge = of_a ? Vec2(a1 - a0) : Vec2(b1 - b0);
    const double length = edge.norm();
    if (length == 0) continue;
    const Vec2 normal = Vec2(-edge.y(), edge.x()) / length;
    for (const double sign : {1.0, -1.0}) {
      const Vec2 n = sign * normal;
      // Support of A - B against n: moving A along n by this much leaves B behind.
      int low_a = 0, high_b = 0;
      if (n.dot(a[1]) < n.dot(a[0])) low_a = 1;
      if (n.dot(b[1]) > n.dot(b[0])) high_b = 1;
      const double depth = n.dot(b[high_b]) - n.dot(a[low_a]);
      if (depth >= best.depth) continue;
      best = {.depth = depth, .normal = n};
      // The end of one segment against the inside of the other: the weights are those of the foot point.
      if (of_a) {
        const double t = nearest_fraction(b[high_b], a0, a1);
        best.weight_a = {1 - t, t};
        best.weight_b[high_b] = 1;
      } else {
        const double t = nearest_fraction(a[low_a], b0, b1);
        best.weight_b = {1 - t, t};
        best.weight_a[low_a] = 1;
      }
    }
  }
  if (!std::isfinite(best.depth)) best.depth = 0;
  return best;
}

std::vector<GaussianContact<2>::Pair> contact_pairs(const CurveNet& net, double nearest) {
  const ArcLengths arcs(net, net.rest);
  std::vector<GaussianContact<2>::Pair> pairs;
  for (Index i = 0; i < net.vertex_count(); ++i)
    for (Index j = i + 1; j < net.vertex_count(); ++j) {
      double w = 1;
      if (const Index chain = arcs.chain_of[i]; chain == arcs.chain_of[j]) {
        const double along = arcs.between(i, j);
        if (along < nearest) continue;
        w = along / (arcs.closed[chain] ? 0.5 * arcs.length[chain] : arcs.length[chain]);
      }
      pairs.push_back({i, j, w * net.weight[i] * net.weight[j]});
    }
  return pairs;
}

std::vector<SegmentPair> repel_curves(const CurveNet& net, CurveState& state, const RepelOptions& options,
                                      const std::function<bool()>& stop) {
  const std::vector<SegmentPair> before = find_meetings(net, state.x);
  Repulsion repulsion(net, state, options);
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(state.x.data(), state.x.size());
  LbfgsOptions lbfgs;
  lbfgs.max_iterations = options.max_iterations;
  lbfgs.block = 2;
  lbfgs.max_motion = options.step_rel * net.diagonal;
  minimize_lbfgs([&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) { return repulsion(at, gradient); }, x,
                 lbfgs, {}, [&](LbfgsIteration&) { return repulsion.crossings() == 0 || stop(); });
  const Points2 moved = Map(x.data(), 2, net.vertex_count());
  std::vector<SegmentPair> after = find_meetings(net, moved);
  if (after.size() >= before.size()) return before;
  state.x = moved;
  return after;
}

}  // namespace unsnarl
