#include "recover/recovery_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/fit.h"
#include "mesh/union_find.h"
#include "scene/trajectory.h"

namespace unsnarl {
namespace {

/// Sweeps over the faces when a step is projected so that it flips none, at most (unit: sweeps)
constexpr int slide_sweeps = 10;

}  // namespace

RecoveryProblem::RecoveryProblem(Patch& patch, ContactRules& rules, const IndexLists& neighbours, Objective& objective,
                                 const StepOptions& options, double h, std::size_t tolerated_pairs)
    : patch_(patch),
      neighbours_(neighbours),
      objective_(objective),
      options_(options),
      h_(h),
      tolerated_pairs_(tolerated_pairs),
      contacts_(rules, h) {}

bool RecoveryProblem::start(std::vector<std::uint8_t> moves, double activation, double stationary,
                            int stationary_steps) {
  activation_ = activation;
  stationary_ = stationary;
  stationary_steps_ = stationary_steps;
  small_steps_.assign(moves.size(), 0);
  set_moving(std::move(moves));
  if (unknowns() == 0) return false;
  contacts_.gather(patch_.x, activation_, moving());
  hold(contacts_.touching());
  is_new_state_ = true;
  return unknowns() > 0;
}

void RecoveryProblem::finish() {
  contacts_.clear();
  std::vector<BarrierStencil>().swap(objective_.contacts());
  hessian_ = {};
}

void RecoveryProblem::set_moving(std::vector<std::uint8_t> moves) {
  objective_.restrict_to(MovingVertices(std::move(moves)));
  const MovingVertices& now = moving();
  UnionFind parts(now.count());
  for (Index i = 0; i < now.count(); ++i)
    for (Index w : neighbours_[now.vertices[i]])
      if (now.slot[w] >= 0) parts.unite(i, now.slot[w]);
  part_ = parts.dense_ids();
  part_count_ = part_.empty() ? 0 : 1 + *std::max_element(part_.begin(), part_.end());
}

void RecoveryProblem::hold_stationary() {
  const auto is_stationary = [&](Index v) { return small_steps_[v] >= stationary_steps_; };
  const std::vector<Index>& vertices = moving().vertices;
  const auto count = std::count_if(vertices.begin(), vertices.end(), is_stationary);
  if (count == 0 || count == unknowns()) return;
  std::vector<std::uint8_t> moves = moving().moves;
  for (Index v : vertices)
    if (is_stationary(v)) moves[v] = 0;
  set_moving(std::move(moves));
}

bool RecoveryProblem::hold(std::span<const Stencil> stencils) {
  std::vector<std::uint8_t> moves = moving().moves;
  for (const Stencil& s : stencils)
    for (int i = 0; i < s.size(); ++i) moves[s.v[i]] = 0;
  if (moves == moving().moves) return false;
  set_moving(std::move(moves));
  contacts_.gather(patch_.x, activation_, moving());
  return true;
}

bool RecoveryProblem::remove_blocked() {
  std::vector<Stencil> collided;
  for (const BarrierStencil& s : objective_.contacts())
    if (!(std::sqrt(squared_distance(s.stencil, trial_)) > s.separation)) collided.push_back(s.stencil);
  return hold(collided) && unknowns() > 0;
}

double RecoveryProblem::linearise(Eigen::Matrix3Xd& gradient) {
  if (!std::exchange(has_contacts_, false)) contacts_.pick_near(patch_.x, moving(), objective_.contacts());
  gradient_.resize(3, patch_.x.cols());
  const double value = objective_.linearise(patch_.x, gradient_, hessian_);
  fit(gradient, 3, unknowns());
  for (Index i = 0; i < unknowns(); ++i) gradient.col(i) = gradient_.col(moving().vertices[i]);
  if (is_new_state_) note_iteration();
  is_new_state_ = false;
  return value;
}

void RecoveryProblem::note_iteration() {
  if (!patch_.trajectory) return;
  IterationRecord iteration = objective_.terms();
  iteration.pairs = tolerated_pairs_;
  for (const BarrierStencil& s : objective_.contacts()) {
    if (s.stencil.kind == StencilKind::vertex_edge) continue;  // it holds a single face, not two parts
    const double distance = std::sqrt(squared_distance(s.stencil, patch_.x));
    if (distance < s.activation) iteration.min_gap = std::fmin(iteration.min_gap, distance);
  }
  record(patch_, patch_.x, iteration);
}

Positions& RecoveryProblem::spread(const Eigen::Matrix3Xd& step) {
  displacement_.setZero(3, patch_.x.cols());
  for (Index i = 0; i < unknowns(); ++i) displacement_.col(moving().vertices[i]) = step.col(i);
  return displacement_;
}

void RecoveryProblem::collect(Eigen::Matrix3Xd& step) const {
  for (Index i = 0; i < unknowns(); ++i) step.col(i) = displacement_.col(moving().vertices[i]);
}

std::vector<std::uint8_t> RecoveryProblem::touched_parts() {
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(part_count_), 0);
  for (const BarrierStencil& s : objective_.contacts()) {
    if (s.stencil.kind == StencilKind::vertex_edge) continue;
    if (std::sqrt(squared_distance(s.stencil, patch_.x)) >= s.activation) continue;
    const Index first = part_of(s.stencil.v[0]), last = part_of(s.stencil.v[3]);
    if (first >= 0) touched[first] = 1;
    if (last >= 0) touched[last] = 1;
  }
  // A part that is connected to vertices that do not move is not free.
  for (Index i = 0; i < unknowns(); ++i)
    for (Index w : neighbours_[moving().vertices[i]])
      if (moving().slot[w] < 0) touched[part_[i]] = 1;
  return touched;
}

void RecoveryProblem::limit(Eigen::Matrix3Xd& step) {
  hessian_ = {};  // it has given the step: the lists of contacts need room now
  for (Index i = 0; i < unknowns(); ++i) {
    int& small_steps = small_steps_[moving().vertices[i]];
    small_steps = step.col(i).norm() < stationary_ ? small_steps + 1 : 0;
  }
  const double cap = options_.cap * h_;
  if (options_.shorten_all) {
    const double longest = std::sqrt(step.colwise().squaredNorm().maxCoeff());
    step *= std::min(1.0, cap / longest);
    step *= contacts_.follow(patch_.x, spread(step), moving());
    step *= largest_step(contacts_.in_the_way(), patch_.x, displacement_);
    return;
  }
  const std::size_t parts = static_cast<std::size_t>(part_count_);
  const auto longest_of = [&](const Eigen::Matrix3Xd& p) {
    std::vector<double> longest(parts, 0);
    for (Index i = 0; i < unknowns(); ++i) longest[part_[i]] = std::max(longest[part_[i]], p.col(i).norm());
    return longest;
  };
  const std::vector<double> wanted = longest_of(step);
  const bool limited = std::any_of(wanted.begin(), wanted.end(), [&](double length) { return length > cap; });
  if (limited) {
    const std::vector<std::uint8_t> touched = touched_parts();
    Eigen::Matrix3Xd translation = Eigen::Matrix3Xd::Zero(3, part_count_);
    std::vector<Index> size(parts, 0);
    for (Index i = 0; i < unknowns(); ++i) {
      ++size[part_[i]];
      if (!touched[part_[i]]) translation.col(part_[i]) += step.col(i);
    }
    for (Index k = 0; k < part_count_; ++k) translation.col(k) /= size[k];
    for (Index i = 0; i < unknowns(); ++i) step.col(i) -= translation.col(part_[i]);
    const std::vector<double> deformation = longest_of(step);
    for (Index i = 0; i < unknowns(); ++i) {
      const Index k = part_[i];
      step.col(i) = translation.col(k) + std::min(1.0, cap / deformation[k]) * step.col(i);
    }
  }
  const std::vector<double> longest = longest_of(step);
  // Faces slide before the contacts are gathered, since sliding may lead to other contacts.
  slide_along_flips(step);
  step *= contacts_.follow(patch_.x, displacement_, moving());
  if (!limited) return;
  // A part that goes farther than the cap stops as a whole where one of its vertices would collide.
  std::vector<double> time(parts, 1);
  for (const SeparatedStencil& s : contacts_.in_the_way()) {
    const Index first = part_of(s.stencil.v[0]), last = part_of(s.stencil.v[s.stencil.size() - 1]);
    const bool first_far = first >= 0 && longest[first] > cap, last_far = last >= 0 && longest[last] > cap;
    if (!first_far && !last_far) continue;
    const double t = time_of_impact(s, patch_.x, displacement_);
    if (first_far) time[first] = std::min(time[first], t);
    if (last_far) time[last] = std::min(time[last], t);
  }
  for (Index i = 0; i < unknowns(); ++i) {
    const Index k = part_[i];
    if (longest[k] > cap) step.col(i) *= std::max(time[k], cap / longest[k]);
  }
}

OrientedFaces RecoveryProblem::oriented() const {
  return {objective_.orientation(), objective_.triangles(), options_.kept_area};
}

void RecoveryProblem::slide_along_flips(Eigen::Matrix3Xd& step) {
  spread(step);
  for (int sweep = 0; sweep < slide_sweeps; ++sweep)
    if (!oriented().project(patch_.x, moving().moves, displacement_)) break;
  collect(step);
}

void RecoveryProblem::filter(Eigen::Matrix3Xd& step) {
  filter_step(contacts_.in_the_way(), oriented(), patch_.x, spread(step), OnCollision::shorten,
              {.slack = options_.kept_distance, .stop = contacts_.stop()});
  collect(step);
}

double RecoveryProblem::value(const Eigen::Matrix3Xd& step) {
  trial_ = patch_.x + spread(step);
  contacts_.pick_near(trial_, moving(), objective_.contacts());
  return objective_.value(trial_);
}

void RecoveryProblem::accept(const Eigen::Matrix3Xd& step) {
  patch_.x += spread(step);
  is_new_state_ = has_contacts_ = true;
  hold_stationary();
}

}  // namespace unsnarl
