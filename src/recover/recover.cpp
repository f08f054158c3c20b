#include "recover/recover.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/stop_check.h"
#include "mesh/areas.h"
#include "recover/contact_rules.h"
#include "recover/embedding_guard.h"
#include "recover/open_gaps.h"
#include "recover/recovery_problem.h"
#include "recover/snap_to_rest.h"
#include "scene/patch_progress.h"

namespace unsnarl {
namespace {

/// A computed distance below this means nothing, and no smaller gap can be asked for (unit: units in the last place of
/// the largest coordinate)
constexpr double roundoff_ulps = 1024;
/// The stages with a contact region free this many rings around the vertices that are not at rest (unit: rings)
constexpr int contact_rings = 2;
/// Steps against flipped faces free this many rings around the faces' corners (unit: rings)
constexpr int unflip_rings = 2;

double edge_length_of(const Patch& patch) {
  const std::span<const Triangle> active(patch.triangles.data(), static_cast<std::size_t>(patch.active_count));
  return patch.edge_length > 0 ? patch.edge_length : mean_edge_length(patch.rest, active);
}

/// Length below which computed distances mean nothing.
double roundoff_of(const Patch& patch) {
  const double largest = std::max(patch.x.cwiseAbs().maxCoeff(), patch.rest.cwiseAbs().maxCoeff());
  return roundoff_ulps * (std::numeric_limits<double>::epsilon() * largest);
}

/// Whether most edges that have a length are shorter than round-off at the largest coordinate, so that distances mean
/// nothing.
bool is_below_roundoff(const Patch& patch) {
  std::vector<double> lengths;
  for (Index t = 0; t < patch.active_count; ++t)
    for (int k = 0; k < 3; ++k) {
      const Triangle& f = patch.triangles[t];
      const double length = (patch.rest.col(f[k]) - patch.rest.col(f[(k + 1) % 3])).norm();
      if (length > 0) lengths.push_back(length);
    }
  if (lengths.empty()) return false;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle < roundoff_of(patch);
}

/// Least activation distance of a barrier, and least distance to which gaps are opened, for this share of h.
double above_gap(double min_gap, double share_of_h, double h, const RecoverOptions& options) {
  return std::min(options.least_gaps * min_gap, min_gap + share_of_h * h);
}

ContactRules contact_rules_of(const Patch& patch, const RecoverOptions& recovery, const std::function<bool()>& stop) {
  IntersectionFinder at_rest(patch.triangles, patch.active_count, patch.passing());
  ContactRuleOptions options;
  options.roundoff = roundoff_of(patch);
  options.min_gap = std::max(recovery.min_gap, options.roundoff);
  options.reach_gaps = recovery.least_gaps;
  options.h = edge_length_of(patch);
  if (recovery.knows_sheets)
    options.one_sheet_within = above_gap(options.min_gap, recovery.activation, options.h, recovery);
  options.stop = stop;
  return ContactRules(patch, at_rest.find(patch.rest, stop), options);
}

class Recovery {
 public:
  Recovery(Patch& patch, const RecoverOptions& options, const std::function<bool()>& stop);
  /// If it is stopped on the way, the patch gets the last state that the exact guard found embedded.
  RecoverResult run();

 private:
  void work();
  /// Per vertex: whether it is free.
  std::vector<std::uint8_t> everything() const;
  /// One flag a vertex: it is free and among `front` or within `rings` rings around these.
  std::vector<std::uint8_t> rings_around(std::vector<Index> front, int rings) const;
  /// One flag a vertex: it is free and not at rest, or within contact_rings around such vertices.
  std::vector<std::uint8_t> contact_region() const;
  /// Takes Newton steps until the energy falls by less than the share `decrease`, at most `most`. Returns their number.
  int step(const std::vector<std::uint8_t>& moves, double activation, int most, double decrease);
  /// Takes Newton steps with these vertices, at most as many as max_steps leaves.
  void stage(const std::vector<std::uint8_t>& moves, double activation);
  double above_min_gap(double share_of_h) const {
    return above_gap(rules_.options().min_gap, share_of_h, h_, options_);
  }
  /// Opens gaps to `target`, or to what the barrier needs if that is more; ends at an exactly checked state.
  void open(double target);
  /// Active faces that are flipped.
  std::vector<Index> flipped_faces() const;
  /// Turns flipped faces over: rounds of steps around them with a heavier penalty each, kept if fewer are left.
  void unflip(double activation);
  void snap(std::span<const std::uint8_t> moves);
  void measure_gap(double radius);
  OrientedFaces orientation_of_all() {
    objective_.restrict_to(MovingVertices(everything()));
    return {objective_.orientation(), objective_.triangles(), options_.step.kept_area};
  }

  Patch& patch_;
  const RecoverOptions& options_;
  const std::function<bool()>& stop_;
  RecoverResult result_;
  const double h_;
  const Positions start_;
  const double start_motion_;  // of the farthest vertex
  EmbeddingGuard guard_;
  ContactRules rules_;
  const IndexLists neighbours_;
  Objective objective_;
  RecoveryProblem problem_;
  Positions safe_;  // the last state that the exact guard has seen
  int steps_left_;  // of all stages
};

Recovery::Recovery(Patch& patch, const RecoverOptions& options, const std::function<bool()>& stop)
    : patch_(patch),
      options_(options),
      stop_(stop),
      h_(edge_length_of(patch)),
      start_(patch.x),
      start_motion_((patch.x - patch.rest).colwise().norm().maxCoeff()),
      guard_(patch),
      rules_(contact_rules_of(patch, options, stop)),
      neighbours_(vertex_neighbours(rules_.candidates().edges().edges, static_cast<Index>(patch.x.cols()))),
      objective_(patch, rules_.candidates().edges(), options.objective, h_),
      problem_(patch, rules_, neighbours_, objective_, options.step, h_, guard_.pairs_at_start()),
      safe_(patch.x),
      steps_left_(options.max_steps) {}

std::vector<std::uint8_t> Recovery::everything() const {
  std::vector<std::uint8_t> moves(static_cast<std::size_t>(patch_.x.cols()), 0);
  std::fill(moves.begin(), moves.begin() + patch_.free_count, std::uint8_t{1});
  return moves;
}

std::vector<std::uint8_t> Recovery::rings_around(std::vector<Index> front, int rings) const {
  std::vector<std::uint8_t> moves(static_cast<std::size_t>(patch_.x.cols()), 0);
  std::vector<Index> next;
  for (int ring = 0;; ++ring) {
    next.clear();
    for (Index v : front) {
      if (v >= patch_.free_count || moves[v]) continue;
      moves[v] = 1;
      next.insert(next.end(), neighbours_[v].begin(), neighbours_[v].end());
    }
    if (ring == rings) return moves;
    front.swap(next);
  }
}

std::vector<std::uint8_t> Recovery::contact_region() const {
  std::vector<Index> elsewhere;
  for (Index v = 0; v < patch_.free_count; ++v)
    if (patch_.x.col(v) != patch_.rest.col(v)) elsewhere.push_back(v);
  return rings_around(std::move(elsewhere), contact_rings);
}

std::vector<Index> Recovery::flipped_faces() const {
  std::vector<Index> flipped;
  for (Index t = 0; t < patch_.active_count; ++t)
    if (objective_.orientation().is_flipped(patch_.x, t)) flipped.push_back(t);
  return flipped;
}

int Recovery::step(const std::vector<std::uint8_t>& moves, double activation, int most, double decrease) {
  NewtonOptions newton;
  newton.motion = options_.stop_activation * activation;
  if (!problem_.start(moves, activation, newton.motion, options_.stationary_steps)) return 0;
  newton.max_steps = most;
  newton.solver = options_.solver;
  newton.direct_solver = options_.direct_solver;
  newton.decrease = decrease;
  newton.window = options_.stop_window;
  int taken = result_.iterations;
  const NewtonResult done = minimise_newton(problem_, newton, [&] {
    if (patch_.progress) patch_.progress->done = std::min(1.0, static_cast<double>(taken) / options_.max_steps);
    ++taken;
    return stop_ && stop_();
  });
  problem_.finish();
  result_.iterations += done.iterations;
  result_.solver_iterations += done.solver_iterations;
  result_.stopped |= done.stopped;
  return done.iterations;
}

void Recovery::stage(const std::vector<std::uint8_t>& moves, double activation) {
  if (!result_.stopped && std::find(moves.begin(), moves.end(), 1) != moves.end())
    steps_left_ -= step(moves, activation, steps_left_, options_.stop_decrease);
}

void Recovery::open(double target) {
  OpenGapsOptions open;
  open.target = std::max(target, above_min_gap(options_.last_activation));
  open.step_cap = std::min(open.target, options_.open_cap * h_);
  open.max_rounds = options_.open_rounds + static_cast<int>(std::ceil(open.target / (2 * open.step_cap))) - 1;
  open.stop = stop_;
  open_gaps(patch_.x, rules_, orientation_of_all(), guard_, everything(), open);
  guard_.roll_back(patch_.x, safe_);
  safe_ = patch_.x;
}

void Recovery::unflip(double activation) {
  std::vector<Index> flipped = flipped_faces();
  double factor = options_.unflip_factor;
  for (int round = 0; round < options_.unflip_rounds && !flipped.empty() && !result_.stopped; ++round) {
    std::vector<Index> corners;
    for (Index t : flipped) corners.insert(corners.end(), patch_.triangles[t].begin(), patch_.triangles[t].end());
    const Positions before = patch_.x;
    objective_.scale_flip_penalty(factor);
    const double decrease = options_.stop_decrease / options_.unflip_persistence;
    step(rings_around(std::move(corners), unflip_rings), activation, options_.max_steps, decrease);
    objective_.scale_flip_penalty(1);
    std::vector<Index> left = flipped_faces();
    if (left.size() < flipped.size())
      flipped = std::move(left);
    else
      patch_.x = before;
    factor *= options_.unflip_factor;
  }
}

void Recovery::snap(std::span<const std::uint8_t> moves) {
  guard_.roll_back(patch_.x, safe_);
  if (options_.snaps)
    snap_to_rest(patch_.x, patch_.rest, options_.snap_distance * h_, rules_, orientation_of_all(), guard_, moves);
  safe_ = patch_.x;
}

void Recovery::measure_gap(double radius) {
  const ContactRules::Close close = rules_.measure(patch_.x, radius, everything());
  result_.min_gap = close.least;
  result_.closed = close.closed;
}

RecoverResult Recovery::run() {
  try {
    work();
  } catch (const WorkStopped&) {
    patch_.x = safe_;
    result_.stopped = true;
  }
  for (Index v = 0; v < patch_.free_count; ++v) {
    result_.at_rest += patch_.x.col(v) == patch_.rest.col(v);
    result_.moved |= patch_.x.col(v) != start_.col(v);
  }
  return result_;
}

void Recovery::work() {
  const auto activation_of = [&](double share_of_h) {
    return std::max(std::min(share_of_h * h_, options_.activation_motion * start_motion_), above_min_gap(share_of_h));
  };
  const double activation = activation_of(options_.activation);
  const double last_activation = activation_of(options_.last_activation);

  open(last_activation);
  const Positions opened = patch_.x;

  stage(everything(), activation);
  snap(everything());
  unflip(activation);
  if (options_.has_last_stage) {
    if (last_activation < activation) stage(contact_region(), activation);
    stage(contact_region(), last_activation);
  }
  guard_.roll_back(patch_.x, safe_);
  safe_ = patch_.x;
  const double motion = (patch_.x - patch_.rest).norm();
  if (motion > options_.most_farther * (opened - patch_.rest).norm()) safe_ = patch_.x = opened;
  snap(everything());

  measure_gap(last_activation);
  if (result_.closed > 0 && !result_.stopped) {
    open(0);  // vertices have room now that others have moved back
    measure_gap(last_activation);
  }
}

}  // namespace

RecoverOptions RecoverOptions::paper() {
  RecoverOptions options;
  options.max_steps = 500;
  options.has_last_stage = false;
  options.stop_decrease = 0;
  options.stop_window = 1;
  options.stationary_steps = std::numeric_limits<int>::max();
  options.stop_activation = 0.01;
  options.solver = {1e-6, 2000};
  options.direct_solver = true;
  options.step.shorten_all = true;
  options.step.kept_distance = CcdOptions{}.slack;
  options.objective.time_step = 1;
  // The default adds these to the paper.
  options.objective.flip_weight = 0;
  options.objective.volume_weight = 0;
  options.step.kept_area = -std::numeric_limits<double>::infinity();
  options.step.cap = std::numeric_limits<double>::infinity();
  options.snaps = false;
  options.unflip_rounds = 0;
  options.most_farther = std::numeric_limits<double>::infinity();
  return options;
}

RecoverResult recover(Patch& patch, const RecoverOptions& options, const std::function<bool()>& stop) {
  if (patch.free_count == 0 || is_below_roundoff(patch)) return {};
  try {
    return Recovery(patch, options, stop).run();
  } catch (const WorkStopped&) {  // before the first step
    RecoverResult result;
    result.stopped = true;
    return result;
  }
}

}  // namespace unsnarl
