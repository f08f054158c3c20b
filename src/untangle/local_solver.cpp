#include "untangle/local_solver.h"

#include <oneapi/tbb/parallel_for.h>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "contact/blocking_pairs.h"
#include "contact/intersection_finder.h"
#include "energy/minkowski_penalty.h"
#include "geometry/jitter.h"
#include "geometry/splitmix.h"
#include "mesh/areas.h"
#include "scene/patch_progress.h"
#include "scene/trajectory.h"
#include "untangle/contours.h"
#include "untangle/flip_guard.h"
#include "untangle/zero_length_edges.h"

namespace unsnarl {
namespace {

/// Cotangent weight of an equilateral mesh; uniform weights keep slivers harmless.
constexpr double laplacian_weight = std::numbers::inv_sqrt3;

/// The metric in which directions are taken: Laplacian + area / range^2 on the free vertices, the others held.
class Metric {
 public:
  Metric(const Patch& patch, const EdgeTable& edges, double range) {
    const Index n = patch.free_count;
    std::vector<double> diagonal(n, 0);
    for (Index t = 0; t < patch.active_count; ++t) {
      const double share = triangle_area(patch.x, patch.triangles[t]) / 3;
      for (Index v : patch.triangles[t])
        if (v < n) diagonal[v] += share / (range * range);
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [u, v] : edges.edges) {
      if (u < n) diagonal[u] += laplacian_weight;
      if (v < n) diagonal[v] += laplacian_weight;
      if (u < n && v < n) entries.emplace_back(v, u, -laplacian_weight);  // lower triangle, u < v
    }
    for (Index v = 0; v < n; ++v) entries.emplace_back(v, v, diagonal[v] > 0 ? diagonal[v] : 1);
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(matrix);
  }
  bool ok() const { return factor_.info() == Eigen::Success; }
  /// Free columns of force -> direction.
  Eigen::MatrixX3d solve(const Positions& force, Index n) const {
    Eigen::MatrixX3d direction(n, 3);
    oneapi::tbb::parallel_for(
        0, 3, [&](int k) { direction.col(k) = factor_.solve(Eigen::VectorXd(force.row(k).leftCols(n).transpose())); });
    return direction;
  }

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

/// The Minkowski penalty of all pairs within a margin of each other.
class PenaltyForce {
 public:
  PenaltyForce(const Patch& patch, double margin)
      : patch_(patch),
        margin_(margin),
        penalty_(patch.triangles, {.margin = margin}),
        tree_(patch.triangles, patch.active_count) {}

  void set_margin(double margin) {
    margin_ = margin;
    penalty_ = MinkowskiPenalty(patch_.triangles, {.margin = margin});
  }

  void add(const Positions& x, Positions& force) {
    tree_.update(x, 0.5 * margin_);
    std::vector<std::vector<MinkowskiPenalty::Pair>> found(tree_.task_count());
    tree_.self_pairs([&](Index task, Index a, Index b) { found[task].push_back({a, b}); });
    gather_sorted(found);
    penalty_.value_and_gradient(x, force, -1);
  }
  const MinkowskiPenalty& penalty() const { return penalty_; }

 private:
  /// The pairs of all lists, ascending: by their first triangles at once, then by the second ones of each.
  void gather_sorted(const std::vector<std::vector<MinkowskiPenalty::Pair>>& lists) {
    ends_.assign(patch_.triangles.size() + 1, 0);
    for (const auto& list : lists)
      for (const auto& [a, b] : list) ++ends_[a + 1];
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    penalty_.pairs.resize(static_cast<std::size_t>(ends_.back()));
    for (const auto& list : lists)
      for (const auto& pair : list) penalty_.pairs[ends_[pair[0]]++] = pair;
    auto begin = penalty_.pairs.begin();
    for (std::size_t a = 0; a + 1 < ends_.size(); ++a) {
      const auto end = penalty_.pairs.begin() + ends_[a];
      std::sort(begin, end);
      begin = end;
    }
  }

  const Patch& patch_;
  double margin_;
  std::vector<Index> ends_;  // of the pairs of each first triangle
  MinkowskiPenalty penalty_;
  FaceTree tree_;
};

/// Depth of the deepest of these pairs, without any margin.
double deepest_overlap(const Patch& patch, const Positions& x, std::span<const IntersectingPair> pairs) {
  double deepest = 0;
  for (const IntersectingPair& pair : pairs)
    deepest = std::max(deepest, overlap_depth(x, patch.triangles[pair.a], patch.triangles[pair.b]));
  return deepest;
}

/// Pushes the two sheets of every intersection curve apart.
void add_contour_force(const Patch& patch, const Positions& x, const EdgeTable& edges,
                       std::span<const IntersectingPair> pairs, const MinkowskiPenalty& penalty, SheetMotion motion,
                       Positions& force) {
  const Contours contours = trace_contours(x, patch.triangles, edges, pairs);
  const std::vector<Vec3> pushes = sheet_pushes(contours, motion);
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    const Crossing& c = contours.crossings[i];
    const Vec3 push = c.side * pushes[i];  // of the edge
    const auto [u, v] = edges.edges[c.edge];
    force.col(u) += (1 - c.along) * push;
    force.col(v) += c.along * push;
    for (int k = 0; k < 3; ++k) force.col(patch.triangles[c.face][k]) -= c.weights[k] * push;
  }
  for (const IntersectingPair& pair : contours.uncrossed) {
    const Penetration p = penalty.evaluate(x, pair.a, pair.b);
    if (!(p.depth > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      force.col(patch.triangles[pair.a][k]) += p.weight_a[k] * p.normal;
      force.col(patch.triangles[pair.b][k]) -= p.weight_b[k] * p.normal;
    }
  }
}

/// How far a strategy has got.
struct Try {
  Positions x, best;
  std::size_t pairs_left = not_counted;  // in best
  int iterations = 0;
  double reference = std::numeric_limits<double>::infinity();  // pairs at the last progress
  int waited = 0;                                              // iterations since
  Trajectory::Mark mark;
};

std::vector<std::uint8_t> in_conflict(const Patch& patch, std::span<const IntersectingPair> pairs) {
  std::vector<std::uint8_t> result(patch.triangles.size(), 0);
  for (const IntersectingPair& pair : pairs) result[pair.a] = result[pair.b] = 1;
  return result;
}

/// Moves the free vertices of x at random by up to `share` of the shortest edge (at patch.x) at each, or of h if
/// shorter.
void add_jitter(const Patch& patch, std::span<const Edge> edges, double share, Positions& x) {
  std::vector<double> reach(patch.free_count, patch.edge_length);
  for (const auto& [u, v] : edges) {
    const double length = (patch.x.col(u) - patch.x.col(v)).norm();
    if (!(length > 0)) continue;
    for (Index end : {u, v})
      if (end < patch.free_count) reach[end] = std::min(reach[end], length);
  }
  for (Index v = 0; v < patch.free_count; ++v)
    for (int k = 0; k < 3; ++k) x(k, v) += share * reach[v] * jitter(v, k);
}

}  // namespace

bool has_squeezed_face(const Patch& patch, const Positions& start, const Positions& x, double floor) {
  for (Index t = 0; t < patch.active_count; ++t)
    if (triangle_area(x, patch.triangles[t]) < floor * triangle_area(start, patch.triangles[t])) return true;
  return false;
}

void shrink_displacement(Patch& patch, const Positions& start, int bisections,
                         const std::function<bool(const Positions&)>& is_clean) {
  const Index n = patch.free_count;
  const Positions whole = patch.x;
  double dirty = 0, clean = 1;
  Positions x = whole;
  for (int k = 0; k < bisections; ++k) {
    const double middle = 0.5 * (dirty + clean);
    x.leftCols(n) = start.leftCols(n) + middle * (whole.leftCols(n) - start.leftCols(n));
    if (is_clean(x)) {
      clean = middle;
      patch.x = x;
    } else {
      dirty = middle;
    }
  }
}

LocalResult solve_locally(Patch& patch, const LocalSettings& strategy, std::span<const IntersectingPair> tolerated,
                          const LocalOptions& options, const std::function<bool()>& stop) {
  LocalResult result;
  const Index n = patch.free_count;
  const double h = patch.edge_length;
  if (n == 0 || !(h > 0)) return result;
  const Positions start = patch.x;
  const EdgeTable edges = build_edges(patch.triangles);
  const Metric metric(patch, edges, strategy.locality * h);
  if (!metric.ok()) return result;
  IntersectionFinder finder(patch.triangles, patch.active_count);
  PenaltyForce penalty(patch, options.margin * h);

  std::optional<FlipGuard> guard(std::in_place, patch, in_conflict(patch, finder.find(start)));

  auto is_clean = [&](const Positions& y) {
    return blocking_pairs(finder.find(y), tolerated).empty() && !has_squeezed_face(patch, start, y, options.area_floor);
  };
  double at_least = options.negligible * h;  // overlap that steps are for
  std::optional<Try> before_keeping;         // where the guard was first needed
  // Iterations without progress after which a try is left.
  const auto patience = [&](const Try& t) {
    if (strategy.motion == SheetMotion::free) return strategy.max_iterations;
    return t.iterations > strategy.max_iterations ? options.patience : options.despair;
  };
  const auto note_pairs = [&](Try& t, std::size_t count) {
    record(patch, t.x, {.pairs = count});
    if (patch.progress) patch.progress->set_pairs(count);
    if (count == 0) return;
    if (t.iterations == 0) t.pairs_left = count;
    if (static_cast<double>(count) <= (1 - options.progress) * t.reference) {
      t.reference = static_cast<double>(count);
      t.waited = 0;
    }
    if (count < t.pairs_left && !has_squeezed_face(patch, start, t.x, options.area_floor)) {
      t.pairs_left = count;
      t.best = t.x;
    }
  };
  // Goes on with a try until it is clean (true) or left.
  const auto go_on = [&](Try& t) {
    bool clean = false;
    std::vector<IntersectingPair> pairs;  // those known at t.x
    int looked_at = 0;                    // the iteration at which they were all
    while (!(stop && stop())) {
      if (t.waited >= patience(t)) break;
      const bool follows = strategy.method != LocalMethod::shallow && t.iterations >= options.despair &&
                           (t.iterations - looked_at) * strategy.step < options.look_distance;
      if (follows)
        std::erase_if(pairs, [&](IntersectingPair& pair) {
          return !intersects(t.x, patch.triangles[pair.a], patch.triangles[pair.b], pair.kind);
        });
      if (!follows || pairs.empty()) {
        pairs = blocking_pairs(finder.find(t.x), tolerated);
        looked_at = t.iterations;
        note_pairs(t, pairs.size());
        clean = pairs.empty();
        if (clean) break;
      }
      const int iteration = t.iterations++;
      ++t.waited;
      Positions force = Positions::Zero(3, t.x.cols());
      double limit = strategy.step * h;
      if (strategy.method == LocalMethod::shallow) {
        const double deepest = std::max({deepest_overlap(patch, t.x, pairs), at_least, options.min_gap});
        if (iteration == 0) {
          at_least = deepest;
          penalty.set_margin(std::min(options.margin * h, options.shallow_margin * deepest));
        }
        limit = std::min(limit, deepest);
      }
      // In turn: the penalty knows nothing of pairs that only touch at a vertex, the contours nothing of depth.
      if (strategy.method == LocalMethod::shallow && iteration % 2 == 0)
        penalty.add(t.x, force);
      else
        add_contour_force(patch, t.x, edges, pairs, penalty.penalty(), strategy.motion, force);
      Eigen::MatrixX3d direction = metric.solve(force, n);
      const double size = direction.rowwise().norm().maxCoeff();
      if (!(size > 0) || !std::isfinite(size)) break;
      direction *= limit / size;
      t.x.leftCols(n) += direction.transpose();
      if (!guard) continue;
      const bool is_first = options.orientation == KeepOrientation::at_first && !before_keeping;
      const Positions unkept = is_first ? t.x : Positions();
      if (!guard->project(t.x) || !is_first) continue;
      before_keeping = t;
      before_keeping->x = unkept;
      if (patch.trajectory) before_keeping->mark = patch.trajectory->mark();
    }
    return clean && !has_squeezed_face(patch, start, t.x, options.area_floor);
  };

  // patch.x stays what the metric was made of.
  Try current{.x = start, .best = start, .mark = {}};
  open_zero_length_edges(patch, edges.edges, options.opening, current.x);
  if (strategy.method != LocalMethod::shallow) add_jitter(patch, edges.edges, options.negligible, current.x);
  result.clean = go_on(current);
  result.iterations = current.iterations;
  if (!result.clean && before_keeping && current.pairs_left > options.few_enough) {
    // Up to there it would go the same way.
    result.iterations -= before_keeping->iterations;
    current = std::move(*before_keeping);
    guard.reset();
    if (patch.trajectory) patch.trajectory->rewind(std::move(current.mark));
    result.clean = go_on(current);
    result.iterations += current.iterations;
  }
  if (!result.clean) {
    result.pairs_left = current.pairs_left;
    patch.x = current.best;
    return result;
  }
  result.pairs_left = 0;
  patch.x = current.x;
  shrink_displacement(patch, start, options.bisections, is_clean);
  result.displacement = (patch.x - start).leftCols(n).colwise().norm().maxCoeff();
  return result;
}

}  // namespace unsnarl
