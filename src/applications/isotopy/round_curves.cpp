#include "applications/isotopy/round_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "applications/curves/segment_tree.h"
#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

constexpr double longer = 1.2;  ///< The step of time grows by this factor after each step (no unit)
/// The step of time is halved this many times at most where a vertex would go too far (unit: halvings)
constexpr int most_halvings = 40;
/// The flow uses this share of what a vertex may move; the rest is for points to slide (no unit)
constexpr double flow_part = 0.6;
constexpr double looked_for = 4;             ///< Distances are looked for up to this (unit: mean edges)
constexpr std::size_t states_between = 400;  ///< States after which they are thinned out (unit: states)
/// Curves that wait shrink down to this (unit: bounding-box diagonal)
constexpr double least_size_rel = 1e-2;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// x_(k-1), x_k, x_(k+1) of a closed chain: solves d_k x_k - t (x_(k-1) + x_(k+1)) = r_k by elimination, with the
/// corner entries by the formula of Sherman and Morrison.
void solve_cyclic(const std::vector<double>& diagonal, double t, Points2& right) {
  const Index n = static_cast<Index>(diagonal.size());
  const double gamma = -diagonal[0];
  std::vector<double> d = diagonal, u(n, 0);
  d[0] -= gamma;
  d[n - 1] -= t * t / gamma;
  u[0] = gamma;
  u[n - 1] = -t;
  for (Index k = 1; k < n; ++k) {  // rows: -t, d, -t
    const double f = -t / d[k - 1];
    d[k] -= f * -t;
    right.col(k) -= f * right.col(k - 1);
    u[k] -= f * u[k - 1];
  }
  right.col(n - 1) /= d[n - 1];
  u[n - 1] /= d[n - 1];
  for (Index k = n - 2; k >= 0; --k) {
    right.col(k) = (right.col(k) + t * right.col(k + 1)) / d[k];
    u[k] = (u[k] + t * u[k + 1]) / d[k];
  }
  const double v_last = -t / gamma;
  const Vec2 v_right = right.col(0) + v_last * right.col(n - 1);
  const double scale = 1 / (1 + u[0] + v_last * u[n - 1]);
  for (Index k = 0; k < n; ++k) right.col(k) -= scale * u[k] * v_right;
}

class Flow {
 public:
  Flow(const CurveNet& net, Points2 x, const RoundOptions& options)
      : net_(net), options_(options), tree_(net), x_(std::move(x)) {
    double length = 0;
    for (const Edge& s : net.segments) length += (x_.col(s[1]) - x_.col(s[0])).norm();
    reach_ = looked_for * length / net.segment_count();
    time_step_ = portable::pow(length / net.segment_count(), 2);
    is_round_.assign(net.chains.size(), false);
  }

  bool is_done() {
    bool all = true;
    for (std::size_t c = 0; c < net_.chains.size(); ++c) {
      is_round_[c] = is_round_[c] || roundness_of(net_, net_.chains[c], x_) >= options_.roundness;
      all &= is_round_[c];
    }
    return all;
  }

  const Points2& step() {
    tree_.refit(x_);
    measure_distances();
    // The step of time is halved until no vertex goes too far. Holding back single vertices instead could end the flow
    // in a thin doubled line.
    Points2 to;
    for (int k = 0; k < most_halvings; ++k, time_step_ *= 0.5) {
      to = x_;
      for (std::size_t c = 0; c < net_.chains.size(); ++c)
        if (!is_round_[c]) shorten(net_.chains[c], to);
      if (((to - x_).colwise().norm().transpose().array() <= flow_part * options_.move_of_distance * distance_.array())
              .all())
        break;
    }
    for (std::size_t c = 0; c < net_.chains.size(); ++c)
      if (!is_round_[c])
        spread(net_.chains[c], to);
      else if (options_.holds_others[c] == 0)
        shrink(net_.chains[c], to);
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      const Vec2 move = to.col(v) - x_.col(v);
      const double allowed = options_.move_of_distance * distance_[v], wanted = move.norm();
      x_.col(v) += wanted > allowed ? Vec2(allowed / wanted * move) : move;
    }
    time_step_ *= longer;
    return x_;
  }

 private:
  void measure_distances() {
    distance_.setConstant(net_.vertex_count(), reach_);
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      const Vec2 p = x_.col(v), room = Vec2::Constant(reach_);
      tree_.near(p - room, p + room, [&](Index s) {
        const auto [a, b] = net_.segments[s];
        if (a == v || b == v) return;
        const Vec2 foot = x_.col(a) + nearest_fraction(p, x_.col(a), x_.col(b)) * (x_.col(b) - x_.col(a));
        const double d = (p - foot).norm();
        for (const Index w : {v, a, b}) distance_[w] = std::min(distance_[w], d);
      });
    }
  }

  void shorten(const CurveNet::Chain& chain, Points2& to) const {
    const Index n = chain.size();
    std::vector<double> diagonal(n);
    Points2 right(2, n);
    for (Index k = 0; k < n; ++k) {
      const Vec2 before = x_.col(chain.vertices[(k + n - 1) % n]), at = x_.col(chain.vertices[k]),
                 after = x_.col(chain.at(k + 1));
      const double speed = 0.5 * ((at - before).squaredNorm() + (after - at).squaredNorm());
      diagonal[k] = speed + 2 * time_step_;
      right.col(k) = speed * at;
    }
    solve_cyclic(diagonal, time_step_, right);
    for (Index k = 0; k < n; ++k) to.col(chain.vertices[k]) = right.col(k);
  }

  /// Lets points slide along the polygon toward equal distances, within what the flow leaves of the bounds. The flow's
  /// own spreading is too slow at tips, where it gathers points.
  void spread(const CurveNet::Chain& chain, Points2& to) const {
    const Index n = chain.size();
    std::vector<double> arc(n + 1, 0);
    for (Index k = 0; k < n; ++k) arc[k + 1] = arc[k] + (x_.col(chain.at(k + 1)) - x_.col(chain.vertices[k])).norm();
    double offset = 0;
    for (Index k = 0; k < n; ++k) offset += (arc[k] - arc[n] * k / n) / n;
    for (Index k = 0; k < n; ++k) {
      const Index v = chain.vertices[k];
      const double slide = offset + arc[n] * k / n - arc[k];
      const Vec2 along = x_.col(slide > 0 ? chain.at(k + 1) : chain.vertices[(k + n - 1) % n]) - x_.col(v);
      const double length = along.norm(), most = (1 - flow_part) * options_.move_of_distance * distance_[v];
      if (length > 0) to.col(v) += std::min({std::abs(slide), most, 0.5 * length}) / length * along;
    }
  }

  void shrink(const CurveNet::Chain& chain, Points2& to) const {
    if (net_.chains.size() == 1) return;
    Vec2 middle(0, 0);
    for (const Index v : chain.vertices) middle += x_.col(v) / chain.size();
    if ((x_.col(chain.vertices[0]) - middle).norm() < least_size_rel * net_.diagonal) return;
    for (const Index v : chain.vertices) to.col(v) = middle + options_.shrinking * (x_.col(v) - middle);
  }

  const CurveNet& net_;
  const RoundOptions& options_;
  SegmentTree tree_;
  Points2 x_;
  Eigen::VectorXd distance_;    // one a vertex
  std::vector<bool> is_round_;  // one a chain
  double reach_, time_step_;
};

}  // namespace

double roundness_of(const CurveNet& net, const CurveNet::Chain& chain, const Points2& x) {
  (void)net;
  double area = 0, length = 0;
  bool left = true, right = true;
  for (Index k = 0; k < chain.size(); ++k) {
    const Vec2 a = x.col(chain.vertices[k]), b = x.col(chain.at(k + 1)),
               c = x.col(chain.vertices[(k + 2) % chain.size()]);
    area += 0.5 * cross(a - x.col(chain.vertices[0]), b - x.col(chain.vertices[0]));
    length += (b - a).norm();
    left &= cross(b - a, c - b) > 0;
    right &= cross(b - a, c - b) < 0;
  }
  return left || right ? 4 * std::numbers::pi * std::abs(area) / (length * length) : 0;
}

std::vector<Points2> round_curves(const CurveNet& net, Points2 x, const RoundOptions& options,
                                  const std::function<bool()>& stop,
                                  const std::function<void(std::vector<Points2>&)>& compact) {
  std::vector<Points2> states{x};
  std::size_t room = states_between;
  Flow flow(net, std::move(x), options);
  for (int step = 0; !flow.is_done(); ++step) {
    if (step == options.most_steps || stop()) return {};
    states.push_back(flow.step());
    if (states.size() >= room) {
      compact(states);
      room = states.size() + states_between;
    }
  }
  return states;
}

}  // namespace unsnarl
