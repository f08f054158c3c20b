#include "repair/recover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "energy/arap_triangle.h"
#include "energy/bending.h"
#include "energy/ipc_barrier.h"
#include "energy/orientation_penalty.h"
#include "energy/quadratic_pull.h"
#include "geometry/parallel_sums.h"
#include "mesh/areas.h"
#include "repair/contact_rules.h"
#include "repair/embedding_guard.h"
#include "repair/open_gaps.h"
#include "repair/snap_home.h"
#include "repair/trajectory.h"

namespace unsnarl {
namespace {

constexpr Index chunk = 1024;  // vertices, triangles or hinges a task

using Matrix34 = Eigen::Matrix<double, 3, 4>;

/// Symmetric positive semidefinite operator over the moving vertices: a scalar sparse matrix on each coordinate plus
/// rank-one terms of up to four vertices.
struct StepOperator {
  struct RankOne {
    std::array<Index, 4> slot;  // -1: does not move
    Matrix34 g;                 // the term is stiffness * g g^T
    double stiffness;
  };
  std::vector<Index> row_begin, column;
  std::vector<double> entry;
  struct Strained {
    Triangle slot;
    ArapTriangle::Strain strain;
    double stiffness;
  };
  std::vector<RankOne> terms;
  std::vector<Strained> strains;
  double shift = 0;  // times the mass
  std::vector<double> mass;

  mutable ScatteredSum scattered;

  void apply(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const {
    const Index n = static_cast<Index>(mass.size());
    for_chunks(n, chunk, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        Vec3 sum = (shift * mass[i]) * v.col(i);
        for (Index k = row_begin[i]; k < row_begin[i + 1]; ++k) sum += entry[k] * v.col(column[k]);
        result.col(i) = sum;
      }
    });
    // One range for both, so that one sum over the parts does.
    const Index strain_count = static_cast<Index>(strains.size());
    const Index count = strain_count + static_cast<Index>(terms.size());
    scattered(count, 2 * chunk, result, [&](Index begin, Index end, Eigen::Matrix3Xd& out) {
      for (Index k = begin; k < std::min(end, strain_count); ++k) add_strain(strains[k], v, out);
      for (Index k = std::max(begin, strain_count); k < end; ++k) add_term(terms[k - strain_count], v, out);
    });
  }

  static void add_strain(const Strained& t, const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      if (t.slot[k] >= 0) {
        corners.col(k) = t.stiffness * v.col(t.slot[k]);
      } else {
        corners.col(k).setZero();
      }
    }
    corners = t.strain.apply(corners);
    for (int k = 0; k < 3; ++k) {
      if (t.slot[k] >= 0) result.col(t.slot[k]) += corners.col(k);
    }
  }

  static void add_term(const RankOne& t, const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
    double dot = 0;
    for (int k = 0; k < 4; ++k) {
      if (t.slot[k] >= 0) dot += t.g.col(k).dot(v.col(t.slot[k]));
    }
    dot *= t.stiffness;
    for (int k = 0; k < 4; ++k) {
      if (t.slot[k] >= 0) result.col(t.slot[k]) += dot * t.g.col(k);
    }
  }

  void inverse_blocks(bool diagonal_only, std::vector<Eigen::Matrix3d>& blocks) const {
    const Index n = static_cast<Index>(mass.size());
    blocks.resize(n);
    for (Index i = 0; i < n; ++i) {
      double diagonal = shift * mass[i];
      for (Index k = row_begin[i]; k < row_begin[i + 1]; ++k) {
        if (column[k] == i) diagonal += entry[k];
      }
      blocks[i] = diagonal * Eigen::Matrix3d::Identity();
    }
    for (const Strained& t : strains) {
      for (int k = 0; k < 3; ++k) {
        if (t.slot[k] >= 0) blocks[t.slot[k]] += t.stiffness * t.strain.block(k);
      }
    }
    for (const RankOne& t : terms) {
      for (int k = 0; k < 4; ++k) {
        if (t.slot[k] >= 0) blocks[t.slot[k]].noalias() += t.stiffness * t.g.col(k) * t.g.col(k).transpose();
      }
    }
    for_chunks(n, chunk, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        Eigen::Matrix3d& block = blocks[i];
        if (diagonal_only) {
          block = Vec3(block.diagonal().cwiseInverse()).asDiagonal();
        } else {
          const Eigen::Matrix3d inverse = block.inverse();
          block = 0.5 * (inverse + inverse.transpose());
        }
      }
    });
  }
};

class Recovery {
 public:
  Recovery(Patch& patch, const RecoverOptions& options, const std::function<bool()>& stop);
  RecoverResult run();

 private:
  void release_everything();
  void release_contact_region();
  void set_moving(const std::vector<std::uint8_t>& moves);
  void build_operator();
  /// Steps at one activation distance until converged or `steps` are used up.
  void steps_at(double activation, int steps, const RecoverOptions::Stop& stop);
  /// Lists the stencils that may be active while no vertex goes farther than its allowance.
  void gather(double activation);
  /// Whether the list holds for these steps too; updates travelled_ and travel_.
  bool list_allows(const Positions& p);
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

  ArapTriangle arap_;
  Bending bending_;
  QuadraticPull pull_;
  IpcBarrier barrier_;
  OrientationPenalty orientation_;
  IndexLists neighbours_;
  std::vector<double> snap_reach_;

  std::vector<std::uint8_t> moves_;        // per vertex
  std::vector<Index> moving_;              // slot -> vertex
  std::vector<Index> slot_;                // vertex -> slot or -1
  std::vector<Index> triangles_, hinges_;  // with a moving vertex
  StepOperator operator_;

  std::vector<ContactRule> gathered_;
  std::vector<BarrierStencil> near_;
  std::vector<BarrierContact> contacts_;    // among near_
  std::vector<double> energies_;            // of triangles_ and hinges_
  IterationRecord terms_;                   // of the energy, where it was last linearised; but for energies_
  std::vector<double> travelled_, travel_;  // per vertex: since gathering, in the coming step
  std::vector<double> allowance_;           // per vertex: motion since the last gathering that the list allows
  std::vector<SeparatedStencil> in_the_way_;
  Positions gathered_at_;
  double activation_ = 0;

  Positions gradient_, step_, shortened_, trial_;
  ScatteredSum scattered_;
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

  const EdgeTable& edges = rules_->candidates().edges();
  neighbours_ = vertex_neighbours(edges.edges, n);
  arap_ = ArapTriangle(patch.rest, active);
  std::vector<Hinge> hinges = hinges_of(patch.triangles, edges);
  std::erase_if(hinges, [&](const Hinge& hinge) {
    return std::all_of(hinge.begin(), hinge.end(), [&](Index v) { return v >= patch.free_count; });
  });
  Bending::Options bending;
  bending.edge_length = h_;
  bending_ = Bending(patch.rest, patch.x, hinges, bending);

  pull_.mass = vertex_areas(patch.rest, patch.triangles);
  pull_.rest = patch.rest;
  double mass = 0;
  for (Index v = 0; v < patch.free_count; ++v) mass += pull_.mass[v];
  mass /= std::max<Index>(patch.free_count, 1);
  barrier_ = IpcBarrier(options.contact_force * mass * h_);
  OrientationPenalty::Options orientation;
  orientation.scale = options.turn_weight * options.contact_force * mass * h_;
  orientation.activation = options.turn_activation;
  orientation_ = OrientationPenalty(patch.rest, active, orientation);

  snap_reach_.assign(n, 0);
  for (Index v = 0; v < patch.free_count; ++v) {
    double sum = 0;
    for (Index w : neighbours_[v]) sum += (patch.rest.col(w) - patch.rest.col(v)).norm();
    const auto count = static_cast<double>(neighbours_[v].size());
    if (count > 0) snap_reach_[v] = options.snap_reach * sum / count;
  }
  gradient_.resize(3, n);
  step_.resize(3, n);
  release_everything();
}

void Recovery::set_moving(const std::vector<std::uint8_t>& moves) {
  moves_ = moves;
  moving_.clear();
  slot_.assign(moves_.size(), -1);
  for (Index v = 0; v < patch_.free_count; ++v) {
    if (!moves_[v]) continue;
    slot_[v] = static_cast<Index>(moving_.size());
    moving_.push_back(v);
  }
  triangles_.clear();
  for (Index t = 0; t < arap_.size(); ++t) {
    const Triangle& f = arap_.triangle(t);
    if (moves_[f[0]] || moves_[f[1]] || moves_[f[2]]) triangles_.push_back(t);
  }
  hinges_.clear();
  for (Index e = 0; e < bending_.size(); ++e) {
    const Hinge& f = bending_.hinge(e);
    if (moves_[f[0]] || moves_[f[1]] || moves_[f[2]] || moves_[f[3]]) hinges_.push_back(e);
  }
  build_operator();
  allowance_.assign(moves_.size(), 0);
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
      for (Index w : neighbours_[v]) release(w);
    }
  }
  set_moving(moves);
}

void Recovery::build_operator() {
  // Hessian of pull and of a share of ARAP with the rotations held: a scalar matrix with the pattern of the mesh.
  const Index n = static_cast<Index>(moving_.size());
  const double arap_scale = options_.arap_length * options_.arap_length * h_ * h_;
  const double arap = options_.rotation_damping * arap_scale * arap_.weight();
  operator_.mass.resize(n);
  operator_.row_begin.assign(n + 1, 0);
  operator_.column.clear();
  operator_.entry.clear();
  const IndexLists& triangles_of_vertex = rules_->candidates().triangles_of_vertex();
  for (Index i = 0; i < n; ++i) {
    const Index v = moving_[i];
    operator_.mass[i] = pull_.mass[v];
    double diagonal = options_.pull * pull_.mass[v];
    const Index begin = static_cast<Index>(operator_.column.size());
    for (Index w : neighbours_[v]) {
      if (slot_[w] < 0) continue;
      operator_.column.push_back(slot_[w]);
      operator_.entry.push_back(0);
    }
    for (Index t : triangles_of_vertex[v]) {
      if (t >= arap_.size()) continue;
      for (Index w : arap_.triangle(t)) {
        if (w == v) continue;
        diagonal += arap;
        if (slot_[w] < 0) continue;
        for (Index k = begin; k < static_cast<Index>(operator_.column.size()); ++k) {
          if (operator_.column[k] == slot_[w]) operator_.entry[k] -= arap;
        }
      }
    }
    operator_.column.push_back(i);
    operator_.entry.push_back(diagonal);
    operator_.row_begin[i + 1] = static_cast<Index>(operator_.column.size());
  }
  operator_.shift = options_.time_step > 0 ? 1 / options_.time_step : 0;
}

void Recovery::gather(double activation) {
  activation_ = activation;
  gathered_at_ = x_;
  travelled_.assign(moves_.size(), 0);
  travel_.assign(moves_.size(), 0);
  rules_->gather(x_, activation, allowance_, moves_, gathered_);
}

bool Recovery::list_allows(const Positions& p) {
  bool allows = true;
  for (Index v : moving_) {
    travelled_[v] = (x_.col(v) - gathered_at_.col(v)).norm();
    travel_[v] = p.col(v).norm();
    allows &= travelled_[v] + travel_[v] <= allowance_[v];
  }
  return allows;
}

void Recovery::pick_near(const Positions& x) {
  for (Index v : moving_) travelled_[v] = (x.col(v) - gathered_at_.col(v)).norm();
  near_.clear();
  for (const ContactRule& rule : gathered_) {
    if (rule.distance - approach(rule.stencil.stencil, travelled_) < rule.stencil.activation)
      near_.push_back(rule.stencil);
  }
}

double Recovery::energy(const Positions& x) {
  pick_near(x);
  const double pull = sum_in_chunks(static_cast<Index>(moving_.size()), chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i) {
      const Index v = moving_[i];
      sum += pull_.mass[v] * (x.col(v) - patch_.rest.col(v)).squaredNorm();
    }
    return sum;
  });
  const double arap = sum_in_chunks(static_cast<Index>(triangles_.size()), chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i) sum += arap_.triangle_energy(x, triangles_[i]);
    return sum;
  });
  const double orientation = sum_in_chunks(static_cast<Index>(triangles_.size()), chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i) sum += orientation_.value(x, triangles_[i]);
    return sum;
  });
  const double bending = sum_in_chunks(static_cast<Index>(hinges_.size()), chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i) {
      const double r = bending_.residual(x, hinges_[i], nullptr);
      sum += bending_.weight(hinges_[i]) * r * r;
    }
    return sum;
  });
  const double contact = sum_in_chunks(static_cast<Index>(near_.size()), chunk, [&](Index begin, Index end) {
    return barrier_.value(x, std::span(near_).subspan(begin, end - begin));
  });
  const double arap_scale = options_.arap_length * options_.arap_length * h_ * h_;
  const double bending_scale = std::pow(options_.bending_length * h_, 4);
  return 0.5 * options_.pull * pull + arap_scale * arap + 0.5 * bending_scale * bending + orientation + contact;
}

double Recovery::linearise() {
  gradient_.setZero();
  double pull = 0;
  for (Index v : moving_) {
    const Vec3 d = x_.col(v) - patch_.rest.col(v);
    pull += pull_.mass[v] * d.squaredNorm();
    gradient_.col(v) += options_.pull * pull_.mass[v] * d;
  }
  const double arap_scale = options_.arap_length * options_.arap_length * h_ * h_;
  const double stiffness = (1 - options_.rotation_damping) * arap_scale * arap_.weight();
  const double bending_scale = std::pow(options_.bending_length * h_, 4);
  const Index triangle_count = static_cast<Index>(triangles_.size());
  const Index hinge_count = static_cast<Index>(hinges_.size());
  operator_.strains.resize(options_.rotation_damping < 1 ? triangles_.size() : 0);
  operator_.terms.resize(hinges_.size());
  energies_.resize(triangles_.size() + hinges_.size());
  scattered_(triangle_count + hinge_count, chunk, gradient_, [&](Index begin, Index end, Positions& gradient) {
    Eigen::Matrix3d forces;
    for (Index i = begin; i < std::min(end, triangle_count); ++i) {
      const Index t = triangles_[i];
      StepOperator::Strained strained;
      energies_[i] = arap_scale * arap_.linearise(x_, t, forces, strained.strain);
      strained.stiffness = stiffness;
      for (int k = 0; k < 3; ++k) {
        const Index v = arap_.triangle(t)[k];
        strained.slot[k] = slot_[v];
        gradient.col(v) += arap_scale * forces.col(k);
      }
      if (!operator_.strains.empty()) operator_.strains[i] = strained;
    }
    for (Index i = std::max(begin, triangle_count); i < end; ++i) {
      const Index e = hinges_[i - triangle_count];
      StepOperator::RankOne& term = operator_.terms[i - triangle_count];
      const double r = bending_.residual(x_, e, &term.g);
      term.stiffness = bending_scale * bending_.weight(e);
      energies_[i] = 0.5 * term.stiffness * r * r;
      for (int k = 0; k < 4; ++k) {
        const Index v = bending_.hinge(e)[k];
        gradient.col(v) += term.stiffness * r * term.g.col(k);
        term.slot[k] = slot_[v];
      }
    }
  });
  double elastic = 0;
  for (const double e : energies_) elastic += e;
  double orientation = 0;
  OrientationPenalty::Term kept;
  StepOperator::RankOne term;
  for (Index t : triangles_) {
    if (!orientation_.evaluate(x_, t, kept)) continue;
    orientation += kept.value;
    term.slot[3] = -1;
    term.g.col(3).setZero();
    for (int k = 0; k < 3; ++k) {
      const Index v = arap_.triangle(t)[k];
      gradient_.col(v) += kept.force * kept.gradient.col(k);
      term.slot[k] = slot_[v];
      term.g.col(k) = kept.gradient.col(k);
    }
    term.stiffness = kept.stiffness;
    operator_.terms.push_back(term);
  }
  pick_near(x_);
  const double contact = barrier_.evaluate(x_, near_, contacts_);
  IpcBarrier::add_gradient(near_, contacts_, 1, gradient_);
  for (const BarrierContact& c : contacts_) {
    const Stencil& s = near_[c.stencil].stencil;
    term.g.setZero();
    term.slot = {-1, -1, -1, -1};
    for (int k = 0; k < s.size(); ++k) {
      term.slot[k] = slot_[s.v[k]];
      term.g.col(k) = c.closest.weights[k] * c.closest.direction;
    }
    term.stiffness = c.stiffness;
    operator_.terms.push_back(term);
  }
  terms_[EnergyTerm::pull] = 0.5 * options_.pull * pull;
  terms_[EnergyTerm::orientation] = orientation;
  terms_[EnergyTerm::barrier] = contact;
  return 0.5 * options_.pull * pull + elastic + orientation + contact;
}

void Recovery::record_iteration() {
  if (!patch_.trajectory) return;
  IterationRecord iteration = terms_;
  const auto hinges = energies_.begin() + static_cast<std::ptrdiff_t>(triangles_.size());
  iteration[EnergyTerm::arap] = std::accumulate(energies_.begin(), hinges, 0.0);
  iteration[EnergyTerm::bending] = std::accumulate(hinges, energies_.end(), 0.0);
  iteration.pairs = guard_.pairs_at_start();
  for (const BarrierContact& contact : contacts_)
    if (near_[contact.stencil].stencil.kind != StencilKind::vertex_edge)  // those watch the shape of single faces
      iteration.min_gap = std::fmin(iteration.min_gap, contact.closest.distance);
  record(patch_, x_, iteration);
}

void Recovery::pick_in_the_way() {
  in_the_way_.clear();
  for (const ContactRule& rule : gathered_) {
    const BarrierStencil& s = rule.stencil;
    const double left = rule.distance - approach(s.stencil, travelled_) - approach(s.stencil, travel_);
    if (left <= s.separation + rules_->options().roundoff) in_the_way_.push_back({s.stencil, s.separation});
  }
}

void Recovery::steps_at(double activation, int steps, const RecoverOptions::Stop& stop) {
  if (moving_.empty()) return;
  gather(activation);
  double current = linearise();
  record_iteration();
  std::vector<double> history = {current};
  for (int count = 0; count < steps && !stopped(); ++count) {
    const Index n = static_cast<Index>(moving_.size());
    rhs_.resize(3, n);
    for (Index i = 0; i < n; ++i) rhs_.col(i) = -gradient_.col(moving_[i]);
    operator_.inverse_blocks(options_.scalar_jacobi, blocks_);
    result_.solver_iterations += pcg_.solve([&](const auto& v, auto& out) { operator_.apply(v, out); }, blocks_, rhs_,
                                            solution_, options_.solver);
    ++result_.iterations;
    const double longest = std::sqrt(solution_.colwise().squaredNorm().maxCoeff());
    if (!(longest > 0) || !(rhs_.cwiseProduct(solution_).sum() > 0)) break;

    const double wanted = std::min(longest, options_.step_cap * h_);
    step_.setZero();
    for (Index i = 0; i < n; ++i) step_.col(moving_[i]) = (wanted / longest) * solution_.col(i);
    if (!list_allows(step_)) {
      const bool reuse = wanted <= options_.margin_reuse * h_;
      for (Index v : moving_)
        allowance_[v] = reuse ? travel_[v] + std::max(travel_[v], options_.margin_min * h_) : travel_[v];
      gather(activation);
      list_allows(step_);
    }
    pick_in_the_way();
    // Whoever would collide goes as far as that allows, everyone else all the way.
    bool accepted = false;
    double alpha = options_.shorten_all ? largest_step(in_the_way_, x_, step_, options_.ccd) : 1;
    double next = current;
    for (int halving = 0; halving < 40 && !accepted; ++halving, alpha *= 0.5) {
      shortened_ = alpha * step_;
      orientation_.filter(x_, triangles_, options_.turn_share, shortened_);
      filter_displacements(in_the_way_, x_, shortened_, OnCollision::shorten, options_.ccd);
      const double slope = gradient_.cwiseProduct(shortened_).sum();
      trial_ = x_ + shortened_;
      next = energy(trial_);
      accepted = slope < 0 && next <= current + options_.armijo * slope;
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
  snap_home(x_, patch_.rest, snap_reach_, *rules_, guard_, moves_);
  safe_ = x_;
}

void Recovery::check() {
  guard_.roll_back(x_, safe_);
  safe_ = x_;
}

double Recovery::measure_gap() {
  release_everything();
  allowance_.assign(moves_.size(), std::max(2 * min_gap_, activation_));
  rules_->gather(x_, 0, allowance_, moves_, gathered_);
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
  OpenGapsOptions open;
  open.target = std::max(options_.open_target * h_, 3 * min_gap_);
  open.max_rounds = options_.open_rounds;
  open.step_cap = 5 * open.target;
  open_gaps(x_, *rules_, guard_, moves_, open);
  safe_ = x_;

  const double least = options_.activation_gaps * min_gap_;
  // Where little moved, little room is needed: a wide barrier would first push everything farther away.
  const double start_motion = (start_ - patch_.rest).colwise().norm().maxCoeff();
  double activation = std::max(std::min(options_.activation * h_, options_.activation_motion * start_motion), least);
  steps_at(activation, std::min(options_.first_steps, options_.max_steps), options_.coarse);
  check();
  snap();
  const double last_activation =
      std::max(options_.activation * std::pow(options_.activation_factor, options_.stages - 1) * h_, least);
  activation = std::max(activation, last_activation);
  for (bool last = options_.stages == 0; !last && !stopped();) {
    release_contact_region();
    if (moving_.empty()) break;
    last = activation <= 1.001 * last_activation;
    steps_at(activation, options_.max_steps - result_.iterations, last ? options_.fine : options_.coarse);
    activation = std::max(activation * options_.activation_factor, last_activation);
  }
  check();
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
  options.scalar_jacobi = true;
  options.shorten_all = true;
  options.time_step = 1;
  return options;
}

RecoverResult recover(Patch& patch, const RecoverOptions& options, const std::function<bool()>& stop) {
  if (patch.free_count == 0) return {};
  return Recovery(patch, options, stop).run();
}

}  // namespace unsnarl
