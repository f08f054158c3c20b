#include "untangle/local/local_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "contact/blocking_pairs.h"
#include "contact/intersection_finder.h"
#include "geometry/jitter.h"
#include "scene/patch_progress.h"
#include "scene/trajectory.h"
#include "untangle/local/flip_guard.h"
#include "untangle/local/separating_forces.h"
#include "untangle/local/smoothing_metric.h"
#include "untangle/local/zero_length_edges.h"

namespace unsnarl {
namespace {

/// What stays as it is while a patch is solved.
struct LocalProblem {
  const Patch& patch;
  const LocalSettings& settings;
  const LocalOptions& options;
  std::span<const IntersectingPair> tolerated;
  const Positions& start;
  const EdgeTable& edges;
  const SmoothingMetric& metric;
};

/// How far a solve has got.
struct Descent {
  Positions x, best;
  std::size_t pairs_left = not_counted;  // in best
  int iterations = 0;
  double pairs_at_progress = std::numeric_limits<double>::infinity();  // when their number last fell by enough
  int waited = 0;                                                      // iterations since
  double least_overlap = 0;  // length: the least overlap that steps of `shallow` are for
  Trajectory::Mark mark;
};

/// The pairs known at Descent::x.
struct KnownPairs {
  std::vector<IntersectingPair> pairs;
  int counted_at = 0;  // the iteration at which these were all
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

/// The start of a solve: zero-length edges are opened, and symmetry is broken. (`shallow` needs no broken symmetry.)
Descent begin_descent(const LocalProblem& problem) {
  Descent descent;
  descent.x = descent.best = problem.start;
  descent.least_overlap = problem.options.least_overlap * problem.patch.edge_length;
  open_zero_length_edges(problem.patch, problem.edges.edges, problem.options.opening, descent.x);
  if (problem.settings.method != LocalMethod::shallow)
    add_jitter(problem.patch, problem.edges.edges, problem.options.jitter, descent.x);
  return descent;
}

/// Iterations without progress after which a descent is given up.
int patience_of(const LocalProblem& problem, const Descent& descent) {
  if (problem.settings.motion == SheetMotion::free) return problem.settings.max_iterations;
  const bool is_late = descent.iterations > problem.settings.max_iterations;
  return is_late ? problem.options.patience : problem.options.give_up_after;
}

void note_pairs(const LocalProblem& problem, std::size_t count, Descent& descent) {
  record(problem.patch, descent.x, {.pairs = count});
  if (problem.patch.progress) problem.patch.progress->set_pairs(count);
  if (count == 0) return;
  if (descent.iterations == 0) descent.pairs_left = count;
  if (static_cast<double>(count) <= (1 - problem.options.progress) * descent.pairs_at_progress) {
    descent.pairs_at_progress = static_cast<double>(count);
    descent.waited = 0;
  }
  if (count < descent.pairs_left &&
      !has_squeezed_face(problem.patch, problem.start, descent.x, problem.options.area_floor)) {
    descent.pairs_left = count;
    descent.best = descent.x;
  }
}

/// Counts the pairs. A long descent only follows those that it knows, until it has moved by `recount_distance` or they
/// are gone.
void update_pairs(const LocalProblem& problem, IntersectionFinder& finder, Descent& descent, KnownPairs& known) {
  const LocalOptions& options = problem.options;
  const bool follows = problem.settings.method != LocalMethod::shallow && descent.iterations >= options.follow_after &&
                       (descent.iterations - known.counted_at) * problem.settings.step < options.recount_distance;
  if (follows) {
    std::erase_if(known.pairs, [&](IntersectingPair& pair) {
      const std::vector<Triangle>& triangles = problem.patch.triangles;
      return !intersects(descent.x, triangles[pair.a], triangles[pair.b], pair.kind);
    });
    if (!known.pairs.empty()) return;
  }
  known.pairs = blocking_pairs(finder.find(descent.x), problem.tolerated);
  known.counted_at = descent.iterations;
  note_pairs(problem, known.pairs.size(), descent);
}

/// The longest motion of a vertex in the next step. Steps of `shallow` are as long as the deepest overlap; the first
/// one gives the penalty its margin.
double step_length(const LocalProblem& problem, std::span<const IntersectingPair> pairs, bool is_first,
                   PenaltyForce& penalty, Descent& descent) {
  const double h = problem.patch.edge_length, longest = problem.settings.step * h;
  if (problem.settings.method != LocalMethod::shallow) return longest;
  const LocalOptions& options = problem.options;
  const double deepest =
      std::max({deepest_overlap(problem.patch, descent.x, pairs), descent.least_overlap, options.min_gap});
  if (is_first) {
    descent.least_overlap = deepest;
    penalty.set_margin(std::min(options.margin * h, options.shallow_margin * deepest));
  }
  return std::min(longest, deepest);
}

/// Moves the vertices along the smoothed force on these pairs. False: there is none.
bool take_step(const LocalProblem& problem, std::span<const IntersectingPair> pairs, PenaltyForce& penalty,
               Descent& descent) {
  const int iteration = descent.iterations++;
  ++descent.waited;
  const double length = step_length(problem, pairs, iteration == 0, penalty, descent);
  Positions force = Positions::Zero(3, descent.x.cols());
  // In turn: the penalty knows nothing of pairs that only touch at a vertex, the contours nothing of depth.
  if (problem.settings.method == LocalMethod::shallow && iteration % 2 == 0)
    penalty.add(descent.x, force);
  else
    add_contour_force(problem.patch, descent.x, problem.edges, pairs, penalty.penalty(), problem.settings.motion,
                      force);
  Eigen::MatrixX3d direction = problem.metric.solve(force);
  const double size = direction.rowwise().norm().maxCoeff();
  if (!(size > 0) || !std::isfinite(size)) return false;
  direction *= length / size;
  descent.x.leftCols(problem.patch.free_count) += direction.transpose();
  return true;
}

/// Keeps faces from flipping. `unguarded`: takes the state before the first time that this moves a vertex; may be null.
void keep_orientation(const Patch& patch, const FlipGuard& guard, Descent& descent, std::optional<Descent>* unguarded) {
  const bool is_asked = unguarded && !*unguarded;
  const Positions before = is_asked ? descent.x : Positions();
  if (!guard.project(descent.x) || !is_asked) return;
  *unguarded = descent;
  (*unguarded)->x = before;
  if (patch.trajectory) (*unguarded)->mark = patch.trajectory->mark();
}

/// Goes on with a descent until no pair is left and no face is squeezed (true), or it is given up. `guard` may be null.
bool descend(const LocalProblem& problem, IntersectionFinder& finder, PenaltyForce& penalty, const FlipGuard* guard,
             const std::function<bool()>& stop, Descent& descent, std::optional<Descent>* unguarded) {
  KnownPairs known;
  while (!(stop && stop()) && descent.waited < patience_of(problem, descent)) {
    update_pairs(problem, finder, descent, known);
    if (known.pairs.empty())
      return !has_squeezed_face(problem.patch, problem.start, descent.x, problem.options.area_floor);
    if (!take_step(problem, known.pairs, penalty, descent)) break;
    if (guard) keep_orientation(problem.patch, *guard, descent, unguarded);
  }
  return false;
}

}  // namespace

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
  assert(std::is_sorted(tolerated.begin(), tolerated.end()));
  const double h = patch.edge_length;
  if (patch.free_count == 0 || !(h > 0)) return {};
  const Positions start = patch.x;
  const EdgeTable edges = build_edges(patch.triangles);
  const SmoothingMetric metric(patch, edges, strategy.locality * h);
  if (!metric.ok()) return {};
  const LocalProblem problem{patch, strategy, options, tolerated, start, edges, metric};
  IntersectionFinder finder(patch.triangles, patch.active_count, patch.passing());
  finder.expect_small_steps();
  PenaltyForce penalty(patch, options.margin * h);
  const FlipGuard guard(patch, in_conflict(patch, finder.find(start)));

  // patch.x stays what the metric and the guard were made of until the end.
  LocalResult result;
  Descent descent = begin_descent(problem);
  std::optional<Descent> unguarded;
  const bool may_flip = options.orientation == KeepOrientation::at_first;
  result.clean = descend(problem, finder, penalty, &guard, stop, descent, may_flip ? &unguarded : nullptr);
  result.iterations = descent.iterations;
  if (!result.clean && unguarded && descent.pairs_left > options.few_enough) {
    // Restores the state from before the guard moved a vertex; a rerun without it would reach that identically.
    result.iterations -= unguarded->iterations;
    descent = std::move(*unguarded);
    if (patch.trajectory) patch.trajectory->rewind(std::move(descent.mark));
    result.clean = descend(problem, finder, penalty, nullptr, stop, descent, nullptr);
    result.iterations += descent.iterations;
  }
  result.pairs_left = result.clean ? 0 : descent.pairs_left;
  patch.x = result.clean ? descent.x : descent.best;
  if (!result.clean) return result;
  shrink_displacement(patch, start, options.bisections, [&](const Positions& x) {
    return blocking_pairs(finder.find(x), tolerated).empty() && !has_squeezed_face(patch, start, x, options.area_floor);
  });
  result.displacement = (patch.x - start).leftCols(patch.free_count).colwise().norm().maxCoeff();
  return result;
}

}  // namespace unsnarl
