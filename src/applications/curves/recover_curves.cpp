#include "applications/curves/recover_curves.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "applications/curves/segment_tree.h"
#include "energy/ipc_barrier.h"
#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// A vertex and a segment that it is no end of.
struct Contact {
  Index vertex = 0, a = 0, b = 0;
  double activation = 0;  ///< length at which the barrier sets in
  bool tight = false;     ///< too close for the barrier, which sets in later and grows with the gap
  double distance = 0;    ///< of the two, when the contact was found
};

struct Nearest {
  double distance = 0;
  double fraction = 0;  ///< of the segment, in [0, 1]
  Vec2 direction;       ///< unit, from the segment to the vertex
};

Nearest nearest(const Points2& x, const Contact& c) {
  const Vec2 p = x.col(c.vertex), a = x.col(c.a), d = x.col(c.b) - a;
  Nearest result;
  result.fraction = nearest_fraction(p, a, x.col(c.b));
  const Vec2 r = p - a - result.fraction * d;
  result.distance = r.norm();
  result.direction = result.distance > 0 ? Vec2(r / result.distance) : Vec2(0, 0);
  return result;
}

class Recovery {
 public:
  Recovery(const CurveNet& net, CurveState& state, double gap, const CurveRecoverOptions& options)
      : net_(net),
        state_(state),
        gap_(gap),
        options_(options),
        tree_(net),
        along_(net, state.target),
        owner_(net.vertex_count(), -1) {
    number_unknowns();
    for (Index s = 0; s < net.segment_count(); ++s)
      for (const Index v : net.segments[s])
        if (owner_[v] < 0) owner_[v] = s;
    assemble_elastic();
  }

  int run(const std::function<bool()>& stop) {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
    for (int step = 0; step < options_.max_steps; ++step) {
      if (unknowns_ == 0 || stop()) return step;
      tree_.refit(state_.x);
      contacts_ = contacts_within(gap_);
      set_activations(contacts_);
      Eigen::VectorXd gradient = Eigen::VectorXd::Zero(2 * unknowns_);
      linearise(gradient);
      solver.compute(hessian_);
      if (solver.info() != Eigen::Success) return step;
      const Eigen::VectorXd solution = solver.solve(-gradient);
      Points2 move = Points2::Zero(2, net_.vertex_count());
      double wanted = 0;
      for (Index v = 0; v < net_.vertex_count(); ++v)
        if (unknown_[v] >= 0) {
          move.col(v) = solution.segment<2>(2 * unknown_[v]);
          wanted = std::max(wanted, move.col(v).norm());
        }
      const double moved = take(move, wanted);
      const bool any_tight =
          std::any_of(contacts_.begin(), contacts_.end(), [](const Contact& contact) { return contact.tight; });
      if (moved < options_.motion_rel * net_.diagonal) {
        if (++small_ >= options_.small_steps && (!any_tight || moved == 0)) return step + 1;
      } else {
        small_ = 0;
      }
    }
    return options_.max_steps;
  }

 private:
  void number_unknowns() {
    unknown_.assign(net_.vertex_count(), -1);
    for (Index v = 0; v < net_.vertex_count(); ++v)
      if (!net_.fixed[v]) unknown_[v] = unknowns_++;
  }

  /// The quadratic part, the same for x and y: rows of second differences of the displacement, and the pull.
  void assemble_elastic() {
    const double spread = options_.spread_rel * net_.diagonal, stiffness = portable::pow(spread, 4);
    std::vector<Eigen::Triplet<double>> terms;
    for (Index v = 0; v < net_.vertex_count(); ++v) terms.emplace_back(v, v, weight_of(v));
    for (const CurveNet::Chain& chain : net_.chains) {
      const Index n = chain.size();
      for (Index k = chain.closed ? 0 : 1; k < (chain.closed ? n : n - 1); ++k) {
        const std::array<Index, 3> v{chain.vertices[(k + n - 1) % n], chain.vertices[k], chain.vertices[(k + 1) % n]};
        const double floor = options_.least_edge_rel * net_.diagonal;
        const double before = std::max((state_.target.col(v[1]) - state_.target.col(v[0])).norm(), floor);
        const double after = std::max((state_.target.col(v[2]) - state_.target.col(v[1])).norm(), floor);
        const double half = 0.5 * (before + after);
        const std::array<double, 3> row{1 / (before * half), -(1 / before + 1 / after) / half, 1 / (after * half)};
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) terms.emplace_back(v[i], v[j], stiffness * half * row[i] * row[j]);
      }
    }
    elastic_.resize(net_.vertex_count(), net_.vertex_count());
    elastic_.setFromTriplets(terms.begin(), terms.end());
    for (Index c = 0; c < net_.vertex_count(); ++c)
      for (Eigen::SparseMatrix<double>::InnerIterator it(elastic_, c); it; ++it)
        for (int d = 0; d < 2; ++d)
          if (unknown_[it.row()] >= unknown_[c] && unknown_[c] >= 0)
            elastic_terms_.emplace_back(2 * unknown_[it.row()] + d, 2 * unknown_[c] + d, it.value());
  }

  /// Contacts closer than a distance; where the ends of their segments want to move no farther than `reach` says, one a
  /// segment, only those that are closer than the gap and that.
  std::vector<Contact> contacts_within(double distance, const std::vector<double>& reach = {}) const {
    std::vector<Contact> result;
    const auto add = [&](Index v, const Edge& segment) {
      const auto [a, b] = segment;
      if (v == a || v == b || (unknown_[v] < 0 && unknown_[a] < 0 && unknown_[b] < 0)) return;
      const Vec2 p = state_.x.col(v), q = state_.x.col(a), r = state_.x.col(b);
      const Vec2 low = q.cwiseMin(r), high = q.cwiseMax(r);
      if (p.x() < low.x() - distance || p.y() < low.y() - distance || p.x() > high.x() + distance ||
          p.y() > high.y() + distance)
        return;
      Contact contact{v, a, b};
      contact.distance = nearest(state_.x, contact).distance;
      if (contact.distance >= distance) return;
      result.push_back(contact);
    };
    const auto add_pair = [&](Index i, Index j) {
      if (are_apart(i, j, reach.empty() ? distance : gap_ + std::max(reach[i], reach[j]))) return;
      for (const auto& [s, t] : {std::pair{i, j}, std::pair{j, i}})
        for (const Index v : net_.segments[s])
          if (owner_[v] == s) add(v, net_.segments[t]);
    };
    if (reach.empty()) {
      tree_.pairs_within(distance, add_pair);
      return result;
    }
    // Most segments want to move little, and meet only what is near; those that want more look around for themselves.
    tree_.pairs_within(2 * gap_, [&](Index i, Index j) {
      if (std::max(reach[i], reach[j]) <= gap_) add_pair(i, j);
    });
    for (Index s = 0; s < net_.segment_count(); ++s) {
      if (reach[s] <= gap_) continue;
      const Vec2 a = state_.x.col(net_.segments[s][0]), b = state_.x.col(net_.segments[s][1]);
      const Vec2 around = Vec2::Constant(gap_ + reach[s]);
      tree_.near(a.cwiseMin(b) - around, a.cwiseMax(b) + around, [&](Index t) {
        if (reach[t] < reach[s] || (reach[t] == reach[s] && t > s)) add_pair(std::min(s, t), std::max(s, t));
      });
    }
    return result;
  }

  /// Are the boxes of two segments farther apart than this in x or in y?
  bool are_apart(Index i, Index j, double distance) const {
    const Edge &segment = net_.segments[i], &other = net_.segments[j];
    const auto is_apart = [&](int axis) {
      const auto [low, high] = std::minmax({state_.x(axis, segment[0]), state_.x(axis, segment[1])});
      const auto [other_low, other_high] = std::minmax({state_.x(axis, other[0]), state_.x(axis, other[1])});
      return low > other_high + distance || other_low > high + distance;
    };
    return is_apart(0) || is_apart(1);
  }

  void set_activations(std::vector<Contact>& contacts) const {
    for (Contact& contact : contacts) {
      contact.activation = activation(contact);
      const double bearable =
          std::max(contact.distance / options_.tight_part, options_.least_activation_rel * net_.diagonal);
      contact.tight = bearable < contact.activation;
      if (contact.tight) contact.activation = bearable;
    }
  }

  /// Length at which the barrier of a contact sets in: the gap, or less for points that are near each other along a
  /// curve.
  double activation(const Contact& contact) const {
    const double to_a = along_.between(contact.vertex, contact.a), to_b = along_.between(contact.vertex, contact.b);
    const double room = std::min({net_.room[contact.vertex], net_.room[contact.a], net_.room[contact.b]});
    const double gap = std::clamp(room, options_.least_room * gap_, gap_);
    if (std::isinf(std::max(to_a, to_b)) || std::min(to_a, to_b) > options_.beside_gaps * gap_) return gap;
    const double wanted = std::max(nearest(state_.target, contact).distance, options_.least_beside_part * gap_);
    return std::min(gap, 0.5 * wanted);
  }

  double weight_of(Index vertex) const {
    return std::max(net_.weight[vertex], options_.least_weight_rel * net_.diagonal);
  }
  double force(Index vertex) const { return options_.barrier * net_.diagonal * weight_of(vertex); }

  double value(const Points2& x, const std::vector<Contact>& contacts) const {
    const Points2 u = x - state_.target;
    double sum = 0.5 * (u.transpose().cwiseProduct(elastic_ * u.transpose())).sum();
    for (const Contact& contact : contacts) {
      const double distance = nearest(x, contact).distance;
      if (distance < contact.activation)
        sum += force(contact.vertex) * contact.activation * barrier(distance / contact.activation);
    }
    return sum;
  }

  void linearise(Eigen::VectorXd& gradient) {
    const Points2 u = state_.x - state_.target;
    const Eigen::MatrixX2d pull = elastic_ * u.transpose();
    for (Index v = 0; v < net_.vertex_count(); ++v)
      if (unknown_[v] >= 0) gradient.segment<2>(2 * unknown_[v]) += pull.row(v).transpose();
    terms_ = elastic_terms_;
    for (const Contact& contact : contacts_) {
      const Nearest n = nearest(state_.x, contact);
      const double y = n.distance / contact.activation;
      if (y >= 1) continue;
      const double strength = force(contact.vertex);
      const double slope = strength * barrier_derivative(y);
      const double curvature = strength * barrier_second_derivative(y) / contact.activation;
      const std::array<Index, 3> v{contact.vertex, contact.a, contact.b};
      const std::array<double, 3> share{1, n.fraction - 1, -n.fraction};
      const Eigen::Matrix2d block = curvature * n.direction * n.direction.transpose();
      for (int i = 0; i < 3; ++i) {
        if (unknown_[v[i]] < 0) continue;
        gradient.segment<2>(2 * unknown_[v[i]]) += slope * share[i] * n.direction;
        for (int j = 0; j < 3; ++j) {
          if (unknown_[v[j]] < 0 || unknown_[v[i]] < unknown_[v[j]]) continue;
          for (int r = 0; r < 2; ++r)
            for (int c = 0; c <= (i == j ? r : 1); ++c)
              terms_.emplace_back(2 * unknown_[v[i]] + r, 2 * unknown_[v[j]] + c, share[i] * share[j] * block(r, c));
        }
      }
    }
    hessian_.resize(2 * unknowns_, 2 * unknowns_);
    hessian_.setFromTriplets(terms_.begin(), terms_.end());
  }

  /// Moves every vertex as far as is safe, then shortens all motions until the value falls. Returns the largest motion.
  double take(const Points2& wanted_move, double wanted) {
    const double largest = std::min(wanted, options_.largest_step * net_.diagonal);
    const double radius = gap_ + largest / options_.safe_part;
    std::vector<double> reach(net_.segment_count(), 0);
    for (Index s = 0; s < net_.segment_count(); ++s)
      for (const Index v : net_.segments[s])
        reach[s] = std::max(reach[s], std::min(wanted_move.col(v).norm(), largest) / options_.safe_part);
    std::vector<Contact> near = contacts_within(radius, reach);
    std::vector<double> bound(net_.vertex_count(), largest);
    for (const Contact& contact : near) {
      const double safe = options_.safe_part * contact.distance;
      for (const Index v : {contact.vertex, contact.a, contact.b}) bound[v] = std::min(bound[v], safe);
    }
    Points2 move = wanted_move;
    for (Index v = 0; v < net_.vertex_count(); ++v)
      if (const double length = move.col(v).norm(); length > bound[v]) move.col(v) *= bound[v] / length;
    // Most contacts only bound the step: the barrier does not set in for them wherever this step ends.
    std::erase_if(near, [&](const Contact& contact) {
      const double of_segment = std::max(move.col(contact.a).norm(), move.col(contact.b).norm());
      return contact.distance > gap_ + move.col(contact.vertex).norm() + of_segment;
    });
    set_activations(near);
    const double before = value(state_.x, near);
    for (double part = 1; part > options_.least_part; part *= 0.5) {
      const Points2 x = state_.x + part * move;
      if (!(value(x, near) < before)) continue;
      state_.x = x;
      return part * move.colwise().norm().maxCoeff();
    }
    return 0;
  }

  const CurveNet& net_;
  CurveState& state_;
  double gap_;
  const CurveRecoverOptions& options_;
  SegmentTree tree_;
  ArcLengths along_;
  std::vector<Index> unknown_;
  Index unknowns_ = 0;
  std::vector<Index> owner_;                       // one segment of each vertex, so that a contact is found once
  Eigen::SparseMatrix<double> elastic_, hessian_;  // of the Hessian the lower half
  std::vector<Eigen::Triplet<double>> elastic_terms_, terms_;
  std::vector<Contact> contacts_;
  int small_ = 0;  // number of small steps in a row
};

}  // namespace

int recover_curves(const CurveNet& net, CurveState& state, double gap, const CurveRecoverOptions& options,
                   const std::function<bool()>& stop) {
  return Recovery(net, state, gap, options).run(stop);
}

}  // namespace unsnarl
