#include "recover/recover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "energy/ipc_barrier.h"
#include "geometry/parallel_lists.h"
#include "geometry/parallel_sums.h"
#include "mesh/areas.h"
#include "recover/contact_rules.h"
#include "recover/embedding_guard.h"
#include "recover/open_gaps.h"
#include "recover/shape_energy.h"
#include "recover/snap_to_rest.h"
#include "recover/step_filter.h"
#include "recover/step_operator.h"
#include "scene/trajectory.h"

namespace unsnarl {
namespace {

constexpr Index chunk = 1024;       // stencils a task
constexpr Index list_chunk = 8192;  // the same where each only takes a look
/// Share of the moving vertices up to which lists are gathered anew around those that leave their bounds.
constexpr double few = 0.3;

class Recovery {
 public:
  Recovery(Patch& patch, const RecoverOptions& options, const std::function<bool()>& stop);
  RecoverResult run();

 private:
  void release_everything();
  void release_contact_region();
  void set_moving(const std::vector<std::uint8_t>& moves);
  /// Steps at one activation distance until converged or `steps` are used up.
  void steps_at(double activation, int steps, const RecoverOptions::Stop& stop);
  /// Lists the stencils that may be active while no vertex goes far.
  void gather(double activation);
  /// Lists anew what the vertices may meet that leave their bounds in this step; updates travelled_ and travel_.
  void keep_up_with(const Positions& step);
  /// Those of the moving vertices that are so close to something that round-off hides it, or had no room left at the
  /// state that near_ was picked for, stay where they are until others are released. True if there were any.
  bool hold_touching();
  bool hold_collided(const Positions& x);
  bool hold(std::span<const Stencil> stencils);
  /// Picks out of the list the stencils that may be active at x, by bounds of the motion since it was gathered.
  void pick_near(const Positions& x);
  double energy(const Positions& x);
  /// Energy, gradient and the rank-one terms of the Hessian at x_.
  double linearise();
  /// Notes the state that was linearised.
  void record_iteration();
  /// Stencils that may collide in the coming step.
  void pick_in_the_way();
  void snap();
  void check();
  double measure_gap();
  OrientedFaces upright() const { return {shape_->orientation(), shape_->triangles(), options_.turn_share}; }
  bool stopped() {
    if (stop_ && !result_.stopped) result_.stopped = stop_();
    return result_.stopped;
  }

  Patch& patch_;
  const RecoverOptions& options_;
  const std::function<bool()>& stop_;
  RecoverResult result_;

  Positions& x_;
  Positions start_;
  double h_ = 0;
  double min_gap_ = 0;
  EmbeddingGuard guard_;
  std::unique_ptr<ContactRules> rules_;
  Positions safe_;  // last state the exact guard has seen

  std::unique_ptr<ShapeEnergy> shape_;
  IpcBarrier barrier_;
  std::vector<double> snap_reach_;

  MovingVertices moving_;
  StepOperator operator_;

  std::vector<ContactRule> gathered_;
  std::vector<BarrierStencil> near_;
  std::vector<BarrierContact> contacts_;    // among near_
  double contact_energy_ = 0;               // where it was last linearised
  std::vector<double> travelled_, travel_;  // per vertex: since gathering, in the coming step
  Positions gathered_at_;                   // where each vertex was when it was last gathered around ...
  MotionBounds bounds_;                     // ... and where the list lets it go from there
  std::vector<Index> leaving_;              // vertices that would leave their bounds
  std::vector<SeparatedStencil> in_the_way_;
  double activation_ = 0;
  double last_longest_ = 0;  // of the Newton steps: how far the farthest vertex would have gone

  Positions gradient_, step_, shortened_, trial_;
  Eigen::Matrix3Xd rhs_, solution_;
  std::vector<Eigen::Matrix3d> blocks_;
  BlockJacobiPcg pcg_;
};

Recovery::Recovery(Patch& patch, const RecoverOptions& options, const std::function<bool()>& stop)
    : patch_(patch), options_(options), stop_(stop), x_(patch.x), start_(patch.x), guard_(patch), safe_(patch.x) {
  const Index n = static_cast<Index>(x_.cols());
  const std::span<const Triangle> active(patch.triangles.data(), static_cast<std::size_t>(patch.active_count));
  h_ = patch.edge_length > 0 ? patch.edge_length : mean_edge_length(patch.rest, active);

  const double largest = std::max(x_.cwiseAbs().maxCoeff(), patch.rest.cwiseAbs().maxCoeff());
  const double ulp = std::numeric_limits<double>::epsilon() * largest;
  ContactRuleOptions rule_options;
  rule_options.roundoff = 64 * ulp;
  rule_options.min_gap = min_gap_ = std::max(options.min_gap, 1024 * ulp);

  std::vector<std::uint8_t> in_conflict(patch.triangles.size(), 0);
  IntersectionFinder at_rest(patch.triangles, patch.active_count);
  for (const IntersectingPair& pair : at_rest.find(patch.rest)) in_conflict[pair.a] = in_conflict[pair.b] = 1;
  rules_ = std::make_unique<ContactRules>(patch, std::move(in_conflict), rule_options);

  shape_ = std::make_unique<ShapeEnergy>(patch, rules_->candidates().edges(),
                                         rules_->candidates().triangles_of_vertex(), options, h_);
  barrier_ = IpcBarrier(shape_->contact_force());

  snap_reach_.assign(n, 0);
  for (Index v = 0; v < patch.free_count; ++v) {
    double sum = 0;
    for (Index w : shape_->neighbours()[v]) sum += (patch.rest.col(w) - patch.rest.col(v)).norm();
    const auto count = static_cast<double>(shape_->neighbours()[v].size());
    if (count > 0) snap_reach_[v] = options.snap_reach * sum / count;
  }
  gradient_.resize(3, n);
  step_.resize(3, n);
  release_everything();
}

void Recovery::set_moving(const std::vector<std::uint8_t>& moves) {
  moving_.moves = moves;
  moving_.vertices.clear();
  moving_.slot.assign(moves.size(), -1);
  for (Index v = 0; v < patch_.free_count; ++v) {
    if (!moves[v]) continue;
    moving_.slot[v] = static_cast<Index>(moving_.vertices.size());
    moving_.vertices.push_back(v);
  }
  shape_->restrict_to(moving_);
  shape_->build_matrix(operator_);
}

void Recovery::release_everything() {
  std::vector<std::uint8_t> moves(static_cast<std::size_t>(x_.cols()), 0);
  std::fill(moves.begin(), moves.begin() + patch_.free_count, std::uint8_t{1});
  set_moving(moves);
}

void Recovery::release_contact_region() {
  std::vector<std::uint8_t> moves(static_cast<std::size_t>(x_.cols()), 0);
  std::vector<Index> front;
  const auto release = [&](Index v) {
    if (v >= patch_.free_count || moves[v]) return;
    moves[v] = 1;
    front.push_back(v);
  };
  for (Index v = 0; v < patch_.free_count; ++v) {
    if (x_.col(v) != patch_.rest.col(v)) release(v);
  }
  std::vector<Index> previous;
  for (int ring = 0; ring < options_.contact_rings; ++ring) {
    previous.swap(front);
    front.clear();
    for (Index v : previous) {
      for (Index w : shape_->neighbours()[v]) release(w);
    }
  }
  set_moving(moves);
}

void Recovery::gather(double activation) {
  activation_ = activation;
  travelled_.assign(moving_.moves.size(), 0);
  travel_.assign(moving_.moves.size(), 0);
  gathered_at_ = x_;
  bounds_.reset(static_cast<Index>(x_.cols()));
  for (Index v : moving_.vertices) bounds_.around[v] = options_.margin_min * h_;
  rules_->gather(x_, activation, bounds_, moving_.moves, gathered_);
}

bool Recovery::hold_touching() {
  std::vector<Stencil> touching;
  for (const ContactRule& rule : gathered_)
    if (!rule.own_altitude && !(rule.distance > rules_->options().roundoff)) touching.push_back(rule.stencil.stencil);
  return hold(touching);
}

bool Recovery::hold_collided(const Positions& x) {
  std::vector<Stencil> collided;
  for (const BarrierStencil& s : near_)
    if (!(std::sqrt(squared_distance(s.stencil, x)) > s.separation)) collided.push_back(s.stencil);
  return hold(collided);
}

bool Recovery::hold(std::span<const Stencil> stencils) {
  std::vector<std::uint8_t> moves = moving_.moves;
  for (const Stencil& s : stencils)
    for (int i = 0; i < s.size(); ++i) moves[s.v[i]] = 0;
  if (moves == moving_.moves) return false;
  set_moving(moves);
  gather(activation_);
  return true;
}

void Recovery::keep_up_with(const Positions& p) {
  leaving_.clear();
  for (Index v : moving_.vertices)
    if (!bounds_.allow(v, x_.col(v) + p.col(v) - gathered_at_.col(v))) leaving_.push_back(v);
  if (!leaving_.empty()) {
    const double most = few * static_cast<double>(moving_.vertices.size());
    const bool anew = static_cast<double>(leaving_.size()) > most;
    // Room lasts where few go far; else the next list is made anew in any case.
    const double far = options_.margin_reuse * h_;
    const auto goes_far = [&](Index v) { return p.col(v).norm() > far; };
    const auto far_count = std::count_if(moving_.vertices.begin(), moving_.vertices.end(), goes_far);
    const bool lasts = static_cast<double>(far_count) <= most;
    for (Index v : anew ? moving_.vertices : leaving_) {
      const double length = p.col(v).norm();
      gathered_at_.col(v) = x_.col(v);
      bounds_.along.col(v) = p.col(v);
      bounds_.around[v] = lasts && length <= far ? std::max(length, options_.margin_min * h_) : 0;
    }
    if (anew)
      rules_->gather(x_, activation_, bounds_, moving_.moves, gathered_);
    else
      rules_->gather_around(leaving_, gathered_at_, x_, activation_, bounds_, gathered_);
  }
  for (Index v : moving_.vertices) {
    travelled_[v] = (x_.col(v) - gathered_at_.col(v)).norm();
    travel_[v] = p.col(v).norm();
  }
}

void Recovery::pick_near(const Positions& x) {
  for (Index v : moving_.vertices) travelled_[v] = (x.col(v) - gathered_at_.col(v)).norm();
  gather_in_chunks(static_cast<Index>(gathered_.size()), list_chunk, near_,
                   [&](Index begin, Index end, std::vector<BarrierStencil>& list) {
                     for (Index k = begin; k < end; ++k) {
                       const ContactRule& rule = gathered_[k];
                       if (rule.distance - approach(rule.stencil.stencil, travelled_) < rule.stencil.activation)
                         list.push_back(rule.stencil);
                     }
                   });
}

double Recovery::energy(const Positions& x) {
  pick_near(x);
  const double contact = sum_in_chunks(static_cast<Index>(near_.size()), chunk, [&](Index begin, Index end) {
    return barrier_.value(x, std::span(near_).subspan(begin, end - begin));
  });
  return shape_->value(x) + contact;
}

double Recovery::linearise() {
  const double shape = shape_->linearise(x_, gradient_, operator_);
  pick_near(x_);
  contact_energy_ = barrier_.evaluate(x_, near_, contacts_);
  IpcBarrier::add_gradient(near_, contacts_, 1, gradient_);
  StepOperator::RankOne term;
  for (const BarrierContact& c : contacts_) {
    const Stencil& s = near_[c.stencil].stencil;
    term.g.setZero();
    term.slot = {-1, -1, -1, -1};
    for (int k = 0; k < s.size(); ++k) {
      term.slot[k] = moving_.slot[s.v[k]];
      term.g.col(k) = c.closest.weights[k] * c.closest.direction;
    }
    term.stiffness = c.stiffness;
    operator_.terms.push_back(term);
  }
  return shape + contact_energy_;
}

void Recovery::record_iteration() {
  if (!patch_.trajectory) return;
  IterationRecord iteration = shape_->terms();
  iteration[EnergyTerm::barrier] = contact_energy_;
  iteration.pairs = guard_.pairs_at_start();
  for (const BarrierContact& contact : contacts_)
    if (near_[contact.stencil].stencil.kind != StencilKind::vertex_edge)  // those watch the shape of single faces
      iteration.min_gap = std::fmin(iteration.min_gap, contact.closest.distance);
  record(patch_, x_, iteration);
}

void Recovery::pick_in_the_way() {
  gather_in_chunks(static_cast<Index>(gathered_.size()), list_chunk, in_the_way_,
                   [&](Index begin, Index end, std::vector<SeparatedStencil>& list) {
                     for (Index k = begin; k < end; ++k) {
                       const BarrierStencil& s = gathered_[k].stencil;
                       const double left =
                           gathered_[k].distance - approach(s.stencil, travelled_) - approach(s.stencil, travel_);
                       if (left <= s.separation + rules_->options().roundoff) list.push_back({s.stencil, s.separation});
                     }
                   });
}

void Recovery::steps_at(double activation, int steps, const RecoverOptions::Stop& stop) {
  if (moving_.vertices.empty()) return;
  gather(activation);
  hold_touching();
  if (moving_.vertices.empty()) return;
  double current = linearise();
  record_iteration();
  std::vector<double> history = {current};
  for (int count = 0; count < steps && !stopped(); ++count) {
    const Index n = static_cast<Index>(moving_.vertices.size());
    rhs_.resize(3, n);
    for (Index i = 0; i < n; ++i) rhs_.col(i) = -gradient_.col(moving_.vertices[i]);
    operator_.inverse_blocks(options_.scalar_jacobi, blocks_);
    PcgOptions solver = options_.solver;
    if (last_longest_ > options_.far_caps * options_.step_cap * h_)
      solver.relative_tolerance = std::max(solver.relative_tolerance, options_.far_tolerance);
    result_.solver_iterations +=
        pcg_.solve([&](const auto& v, auto& out) { operator_.apply(v, out); }, blocks_, rhs_, solution_, solver);
    ++result_.iterations;
    const double longest = std::sqrt(solution_.colwise().squaredNorm().maxCoeff());
    last_longest_ = longest;
    if (!(longest > 0) || !(rhs_.cwiseProduct(solution_).sum() > 0)) break;

    const double wanted = std::min(longest, options_.step_cap * h_);
    step_.setZero();
    for (Index i = 0; i < n; ++i) step_.col(moving_.vertices[i]) = (wanted / longest) * solution_.col(i);
    keep_up_with(step_);
    pick_in_the_way();
    // Whoever would collide goes as far as that allows, everyone else all the way.
    bool accepted = false;
    double alpha = options_.shorten_all ? largest_step(in_the_way_, x_, step_, options_.ccd) : 1;
    double next = current;
    for (int halving = 0; halving < 40 && !accepted; ++halving, alpha *= 0.5) {
      shortened_ = alpha * step_;
      filter_step(in_the_way_, upright(), x_, shortened_, OnCollision::shorten, options_.ccd);
      const double slope = gradient_.cwiseProduct(shortened_).sum();
      trial_ = x_ + shortened_;
      next = energy(trial_);
      if (!std::isfinite(next)) break;
      const auto decreases = [&] { return slope < 0 && next <= current + options_.armijo * slope; };
      accepted = decreases();
      if (!accepted && halving == 0) {
        current = energy(x_);  // with the rules as they are since they were gathered anew for this step
        accepted = decreases();
      }
    }
    if (!std::isfinite(next)) {
      if (!hold_collided(trial_) || moving_.vertices.empty()) break;
      current = linearise();
      history = {current};
      continue;
    }
    if (!accepted) break;
    x_.swap(trial_);
    current = linearise();
    record_iteration();
    history.push_back(current);
    if (longest < std::max(options_.stop_motion * h_, options_.stop_activation * activation)) break;
    if (static_cast<int>(history.size()) > stop.window &&
        history[history.size() - 1 - stop.window] - current < stop.decrease * current) {
      break;
    }
  }
}

void Recovery::snap() {
  result_.home = 0;
  snap_to_rest(x_, patch_.rest, snap_reach_, *rules_, upright(), guard_, moving_.moves);
  safe_ = x_;
}

void Recovery::check() {
  guard_.roll_back(x_, safe_);
  safe_ = x_;
}

double Recovery::measure_gap() {
  release_everything();
  bounds_.reset(static_cast<Index>(x_.cols()));
  bounds_.around.assign(moving_.moves.size(), std::max(2 * min_gap_, activation_));
  rules_->gather(x_, 0, bounds_, moving_.moves, gathered_);
  double gap = std::numeric_limits<double>::infinity();
  result_.closed = 0;
  for (const ContactRule& rule : gathered_) {
    if (rule.own_altitude) continue;
    gap = std::min(gap, rule.distance);
    result_.closed += rule.closed;
  }
  return gap;
}

RecoverResult Recovery::run() {
  const double start_motion = (start_ - patch_.rest).colwise().norm().maxCoeff();
  OpenGapsOptions open;
  open.target = std::max(std::min(options_.open_target * h_, options_.open_motion * start_motion), 3 * min_gap_);
  open.max_rounds = options_.open_rounds;
  open.step_cap = open.target;  // five of them end as close, but look 11 gaps around, not 3: up to 9 GB, not 2
  open_gaps(x_, *rules_, upright(), guard_, moving_.moves, open);
  safe_ = x_;

  const Positions opened = x_;
  const double least = options_.activation_gaps * min_gap_;
  const auto activation_of = [&](double share_of_h) {
    return std::max(std::min(share_of_h * h_, options_.activation_motion * start_motion), least);
  };
  double activation = activation_of(options_.activation);
  steps_at(activation, std::min(options_.first_steps, options_.max_steps), options_.coarse);
  check();
  snap();
  const double last_activation =
      activation_of(options_.activation * std::pow(options_.activation_factor, options_.stages - 1));
  for (bool last = options_.stages == 0; !last && !stopped();) {
    release_contact_region();
    if (moving_.vertices.empty()) break;
    last = activation <= 1.001 * last_activation;
    steps_at(activation, options_.max_steps - result_.iterations, last ? options_.fine : options_.coarse);
    activation = std::max(activation * options_.activation_factor, last_activation);
  }
  check();
  if ((x_ - patch_.rest).norm() > options_.most_farther * (opened - patch_.rest).norm()) x_ = opened;
  release_everything();
  snap();

  result_.min_gap = measure_gap();
  result_.home = 0;
  for (Index v = 0; v < patch_.free_count; ++v) {
    result_.home += x_.col(v) == patch_.rest.col(v);
    result_.moved |= x_.col(v) != start_.col(v);
  }
  return result_;
}

}  // namespace

RecoverOptions RecoverOptions::paper() {
  RecoverOptions options;
  options.max_steps = 500;
  options.first_steps = 500;
  options.stages = 0;
  options.coarse = options.fine = {0, 1};
  options.stop_motion = options.stop_activation = 0;
  options.solver = {1e-6, 2000};
  options.far_tolerance = 0;
  options.scalar_jacobi = true;
  options.shorten_all = true;
  options.time_step = 1;
  options.most_farther = std::numeric_limits<double>::infinity();
  return options;
}

RecoverResult recover(Patch& patch, const RecoverOptions& options, const std::function<bool()>& stop) {
  if (patch.free_count == 0) return {};
  return Recovery(patch, options, stop).run();
}

}  // namespace unsnarl
