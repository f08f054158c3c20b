#include "applications/routes/route_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "energy/ipc_barrier.h"

namespace unsnarl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Index pairs_a_task = 512;  ///< A task of a parallel loop has this many pairs (unit: pairs)
/// Segments that cross are parallel where the sine between them is below this (no unit)
constexpr double parallel_sine = 1e-9;
/// A corner counts as folded over where its cosine is below this: only its stiffness opens it (no unit)
constexpr double folded = -0.9;
/// Segments of a route see each other from this arc on (unit: half a turn of the smallest circle)
constexpr double half_turns = 0.98;

/// 2 r tan(angle / 2) / the shorter edge at b, with its gradients. Zero gradients where it is straight or folded.
struct Turn {
  double value = 0;
  std::array<Vec3, 3> gradient = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
};
Turn turn_at(const Vec3& a, const Vec3& b, const Vec3& c, double r) {
  Turn turn;
  const Vec3 e = b - a, f = c - b;
  const double le = e.norm(), lf = f.norm();
  if (!(le > 0 && lf > 0)) {
    turn.value = infinity;
    return turn;
  }
  const Vec3 u = e / le, v = f / lf;
  const double cosine = u.dot(v), shorter = std::min(le, lf);
  // From the difference of the directions: 1 - cosine would cancel on nearly straight routes.
  const double tangent = (v - u).norm() / (v + u).norm();
  turn.value = 2 * r * tangent / shorter;
  if (!(tangent > 0)) return turn;
  if (cosine < folded) {
    turn.value = 2 * r * std::sqrt((1 - folded) / (1 + folded)) / shorter;
    return turn;
  }
  const double by_cosine = -1 / (tangent * (1 + cosine) * (1 + cosine));
  Vec3 by_e = by_cosine * (v - cosine * u) / le / shorter, by_f = by_cosine * (u - cosine * v) / lf / shorter;
  (le < lf ? by_e : by_f) -= tangent / (shorter * shorter) * (le < lf ? u : v);
  by_e *= 2 * r;
  by_f *= 2 * r;
  turn.gradient = {-by_e, by_e - by_f, by_f};
  return turn;
}

}  // namespace

RouteEnergy::RouteEnergy(const RouteChains& chains, const ObstacleTriangles& obstacles,
                         std::span<const MovingObstacle> moving)
    : chains_(chains), triangles_(obstacles), moving_(moving) {
  for (Index v = 0; v < static_cast<Index>(chains.pinned.size()); ++v) {
    const Index first = chains.stand[v];
    free_.push_back(chains.pinned[v] ? -1 : first == v ? free_count_++ : free_[first]);
  }
}

RouteEnergy::Push RouteEnergy::push_of(double excess, bool is_strict) const {
  // excess: 0 where pushing begins, 1 at the bound.
  if (!(excess > 0)) return {};
  if (!is_strict) return {0.5 * excess * excess, excess, 1};
  const double left = 1 - excess;
  return {barrier(left), -barrier_derivative(left), barrier_second_derivative(left)};
}

double RouteEnergy::reach(Index segment) const {
  const Index chain = chains_.segment_chain[segment];
  return settings.swelling * (1 + settings.cushion) * chains_.chains[chain].radius;
}

double RouteEnergy::needed(const Pair& pair) const {
  return settings.swelling *
         (chains_.chains[chains_.segment_chain[pair.a]].radius + chains_.chains[chains_.segment_chain[pair.b]].radius);
}

double RouteEnergy::weight_of(const Pair& pair) const {
  const double h = chains_.chains[chains_.segment_chain[pair.a]].edge,
               k = chains_.chains[chains_.segment_chain[pair.b]].edge;
  return chains_.timed ? settings.contact * 0.5 * (h + k) : settings.contact * h * k / needed(pair);
}

Closest RouteEnergy::closest_pair(const Points& x, const Pair& pair) const {
  const Index a = chains_.segment_vertex[pair.a], b = chains_.segment_vertex[pair.b];
  Closest closest =
      (chains_.timed ? closest_in_time : closest_edge_edge)(x.col(a), x.col(a + 1), x.col(b), x.col(b + 1));
  if (closest.direction == Vec3::Zero()) {
    // Segments that cross are pushed apart across both, or in their plane.
    const Vec3 e = x.col(a + 1) - x.col(a), f = x.col(b + 1) - x.col(b);
    if (chains_.chains[chains_.segment_chain[pair.a]].planar && chains_.chains[chains_.segment_chain[pair.b]].planar) {
      const Vec3 change = e - f;
      closest.direction = change.norm() > 0 ? Vec3(-change.y(), change.x(), 0).normalized() : Vec3(Vec3::UnitX());
      return closest;
    }
    const Vec3 across = e.cross(f);
    closest.direction = across.norm() > parallel_sine * e.norm() * f.norm() ? across.normalized() : e.unitOrthogonal();
  }
  return closest;
}

void RouteEnergy::find_neighbours(const Points& x) {
  bool is_near = near_at_.cols() == x.cols();
  for (std::size_t c = 0; c < chains_.chains.size() && is_near; ++c) {
    const RouteChains::Chain& chain = chains_.chains[c];
    const double most = slack(static_cast<Index>(c));
    is_near = (x.middleCols(chain.first, chain.count) - near_at_.middleCols(chain.first, chain.count))
                  .colwise()
                  .squaredNorm()
                  .maxCoeff() <= most * most;
  }
  if (is_near) return;
  near_at_ = x;
  pairs_.clear();
  obstacle_pairs_.clear();
  std::vector<Box> boxes(chains_.segments());
  std::vector<double> arc(chains_.segments());
  for (Index s = 0; s < chains_.segments(); ++s) {
    const Index v = chains_.segment_vertex[s], chain = chains_.segment_chain[s];
    boxes[s].extend(Vec3(x.col(v)));
    boxes[s].extend(Vec3(x.col(v + 1)));
    boxes[s] = boxes[s].inflated(reach(s) + slack(chain));
    arc[s] = s > 0 && chains_.segment_chain[s - 1] == chain ? arc[s - 1] + (x.col(v) - x.col(v - 1)).norm() : 0;
  }
  if (settings.contact > 0 && chains_.timed) {
    const Index a_chain = chains_.segments() / static_cast<Index>(chains_.chains.size());
    for (Index a = 0; a < chains_.segments(); ++a)
      for (Index b = a + a_chain; b < chains_.segments(); b += a_chain) {
        if (!boxes[a].overlaps(boxes[b])) continue;
        const double most = reach(a) + slack(chains_.segment_chain[a]) + reach(b) + slack(chains_.segment_chain[b]);
        if (closest_pair(x, {a, b}).distance < most) pairs_.push_back({a, b});
      }
  } else if (settings.contact > 0) {
    Bvh bvh;
    bvh.build(boxes);
    bvh.self_pairs([&](Index a, Index b) {
      const Pair pair{std::min(a, b), std::max(a, b)};
      const Index i = chains_.segment_chain[pair.a], j = chains_.segment_chain[pair.b];
      const Index v = chains_.segment_vertex[pair.a];
      if (i == j && arc[pair.b] - arc[pair.a] - (x.col(v + 1) - x.col(v)).norm() <
                        half_turns * std::numbers::pi * chains_.chains[i].radius)
        return;
      const double most = reach(a) + slack(i) + reach(b) + slack(j);
      if (closest_pair(x, pair).distance < most) pairs_.push_back(pair);
    });
    std::sort(pairs_.begin(), pairs_.end(),
              [](const Pair& p, const Pair& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  }
  for (Index s = 0; s < chains_.segments(); ++s) {
    const double rest_of_reach = (1 - settings.swelling) * reach(s) / settings.swelling;
    triangles_.near(boxes[s].inflated(rest_of_reach), [&](Index t) {
      obstacle_pairs_.push_back({s, &triangles_.corners(t)});
    });
    const Index v = chains_.segment_vertex[s], chain = chains_.segment_chain[s];
    for (const MovingObstacle& obstacle : moving_) {
      if (!boxes[s].inflated(rest_of_reach).overlaps(obstacle.reach())) continue;
      for (const MovingObstacle::Piece& piece : obstacle.pieces(v - chains_.chains[chain].first)) {
        Box box;
        for (const Vec3& end : seen_in(piece, x.col(v), x.col(v + 1))) box.extend(end);
        obstacle.triangles().near(box.inflated(reach(s) + slack(chain) + rest_of_reach), [&](Index t) {
          obstacle_pairs_.push_back({s, &obstacle.triangles().corners(t), &piece});
        });
      }
    }
  }
}

ClosestToTriangle RouteEnergy::closest_obstacle(const Points& x, const ObstaclePair& pair) const {
  const Index v = chains_.segment_vertex[pair.segment];
  if (pair.piece == nullptr) return closest_segment_triangle(x.col(v), x.col(v + 1), *pair.triangle);
  const auto [p, q] = seen_in(*pair.piece, x.col(v), x.col(v + 1));
  ClosestToTriangle closest = closest_segment_triangle(p, q, *pair.triangle);
  const double at_q = closest.weights[0] * pair.piece->from + closest.weights[1] * pair.piece->to;
  closest.weights = {closest.weights[0] + closest.weights[1] - at_q, at_q};
  return closest;
}

bool RouteEnergy::is_constant(Index v, const ClosestToTriangle& closest) const {
  return (closest.weights[0] == 0 || chains_.pinned[v]) && (closest.weights[1] == 0 || chains_.pinned[v + 1]) &&
         closest.weights[0] + closest.weights[1] != 0;
}

bool RouteEnergy::is_constant(const Pair& pair, const Closest& closest) const {
  const Index a = chains_.segment_vertex[pair.a], b = chains_.segment_vertex[pair.b];
  const std::array<Index, 4> vertices = {a, a + 1, b, b + 1};
  for (int i = 0; i < 4; ++i)
    if (closest.weights[i] != 0 && !chains_.pinned[vertices[i]]) return false;
  return true;
}

double RouteEnergy::elastic(const Points& x, Positions& gradient) const {
  double sum = 0;
  for (const RouteChains::Chain& chain : chains_.chains) {
    const double h = chain.edge, stiff = settings.stiffness * chain.radius * chain.radius / (h * h * h);
    for (Index v = chain.first; v < chain.last(); ++v) {
      const Vec3 e = x.col(v + 1) - x.col(v);
      sum += 0.5 * e.squaredNorm() / h;
      gradient.col(v) -= e / h;
      gradient.col(v + 1) += e / h;
    }
    for (Index v = chain.first + 1; v < chain.last(); ++v) {
      if (chains_.stands(v)) continue;
      const Vec3 bend = x.col(v - 1) - 2 * x.col(v) + x.col(v + 1);
      sum += 0.5 * stiff * bend.squaredNorm();
      gradient.col(v - 1) += stiff * bend;
      gradient.col(v) -= 2 * stiff * bend;
      gradient.col(v + 1) += stiff * bend;
    }
  }
  return sum;
}

double RouteEnergy::turns(const Points& x, Positions& gradient) const {
  double sum = 0;
  const double width = 1 - settings.turn_from;
  for (const RouteChains::Chain& chain : chains_.chains)
    for (Index v = chain.first + 1; v < chain.last(); ++v) {
      if (chains_.stands(v)) continue;
      const Turn turn = turn_at(x.col(v - 1), x.col(v), x.col(v + 1), chain.radius);
      const Push push = push_of((turn.value - settings.turn_from) / width, settings.strict_turns);
      if (push.value == 0) continue;
      if (!(push.value < infinity)) return infinity;
      sum += settings.turn * chain.edge * push.value;
      for (int k = 0; k < 3; ++k)
        gradient.col(v - 1 + k) += settings.turn * chain.edge * push.slope / width * turn.gradient[k];
    }
  return sum;
}

double RouteEnergy::paces(const Points& x, Positions& gradient) const {
  double sum = 0;
  const double width = 1 - settings.pace_from;
  for (const RouteChains::Chain& chain : chains_.chains) {
    if (!(chain.longest < infinity)) continue;
    for (Index v = chain.first; v < chain.last(); ++v) {
      const Vec3 e = x.col(v + 1) - x.col(v);
      const double length = e.norm();
      const Push push = push_of((length / chain.longest - settings.pace_from) / width, true);
      if (push.value == 0) continue;
      if (!(push.value < infinity)) return infinity;
      sum += settings.pace * chain.edge * push.value;
      const Vec3 force = settings.pace * chain.edge * push.slope / (width * chain.longest * length) * e;
      gradient.col(v) -= force;
      gradient.col(v + 1) += force;
    }
  }
  return sum;
}

double RouteEnergy::contacts(const Points& x, Positions& gradient) {
  std::array<double, ScatteredSum::most_parts> sums{};
  sum_(static_cast<Index>(pairs_.size()), pairs_a_task, gradient,
       [&](Index begin, Index end, Positions& columns, Index part) {
         for (Index k = begin; k < end; ++k) {
           const Pair& pair = pairs_[k];
           const double need = needed(pair), width = settings.cushion * need;
           const Closest closest = closest_pair(x, pair);
           if (is_constant(pair, closest)) continue;
           const Push push = push_of((need + width - closest.distance) / width, settings.strict);
           if (push.value == 0) continue;
           const double weight = weight_of(pair);
           sums[part] += weight * push.value;
           const Vec3 force = -weight * push.slope / width * closest.direction;
           const Index a = chains_.segment_vertex[pair.a], b = chains_.segment_vertex[pair.b];
           const std::array<Index, 4> vertices = {a, a + 1, b, b + 1};
           for (int i = 0; i < 4; ++i) columns.col(vertices[i]) += closest.weights[i] * force;
         }
       });
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

double RouteEnergy::obstacles(const Points& x, Positions& gradient) {
  std::array<double, ScatteredSum::most_parts> sums{};
  sum_(static_cast<Index>(obstacle_pairs_.size()), pairs_a_task, gradient,
       [&](Index begin, Index end, Positions& columns, Index part) {
         for (Index k = begin; k < end; ++k) {
           const ObstaclePair& pair = obstacle_pairs_[k];
           const RouteChains::Chain& chain = chains_.chains[chains_.segment_chain[pair.segment]];
           const double width = settings.cushion * chain.radius;
           const Index v = chains_.segment_vertex[pair.segment];
           const ClosestToTriangle closest = closest_obstacle(x, pair);
           const Push push = push_of((chain.radius + width - closest.distance) / width, true);
           if (push.value == 0 || is_constant(v, closest)) continue;
           const double weight = settings.obstacle * chain.edge;
           sums[part] += weight * push.value;
           const Vec3 force = -weight * push.slope / width * closest.direction;
           if (!force.allFinite()) continue;  // the sum is infinite
           columns.col(v) += closest.weights[0] * force;
           columns.col(v + 1) += closest.weights[1] * force;
         }
       });
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

double RouteEnergy::operator()(const Eigen::VectorXd& flat, Eigen::VectorXd& flat_gradient) {
  const Points x(flat.data(), 3, flat.size() / 3);
  if (!flat.allFinite()) return infinity;
  find_neighbours(x);
  Positions gradient = Positions::Zero(3, x.cols());
  double sum = elastic(x, gradient) + turns(x, gradient);
  if (sum < infinity) sum += paces(x, gradient);
  if (sum < infinity) sum += contacts(x, gradient);
  if (sum < infinity) sum += obstacles(x, gradient);
  if (!(sum < infinity)) return infinity;
  for (Index v = 0; v < x.cols(); ++v)
    if (chains_.pinned[v]) gradient.col(v).setZero();
  for (const RouteChains::Chain& chain : chains_.chains) {
    if (chain.planar) gradient.middleCols(chain.first, chain.count).row(2).setZero();
    for (Index first = chain.first, last = first; first <= chain.last(); first = last) {
      while (last <= chain.last() && chains_.stand[last] == first) ++last;
      if (last - first < 2) continue;
      const Vec3 mean = gradient.middleCols(first, last - first).rowwise().sum() / (last - first);
      for (Index v = first; v < last; ++v) gradient.col(v) = mean;
    }
  }
  flat_gradient = Eigen::Map<const Eigen::VectorXd>(gradient.data(), gradient.size());
  return sum;
}

RouteMargins RouteEnergy::margins(const Eigen::VectorXd& flat) {
  const Points x(flat.data(), 3, flat.size() / 3);
  find_neighbours(x);
  RouteMargins margins;
  for (const Pair& pair : pairs_) {
    const Closest closest = closest_pair(x, pair);
    if (!is_constant(pair, closest)) margins.contact = std::min(margins.contact, closest.distance / needed(pair));
  }
  for (const RouteChains::Chain& chain : chains_.chains)
    for (Index v = chain.first + 1; v < chain.last(); ++v)
      if (!chains_.stands(v))
        margins.turn = std::max(margins.turn, turn_at(x.col(v - 1), x.col(v), x.col(v + 1), chain.radius).value);
  return margins;
}

void RouteEnergy::factorise(const Eigen::VectorXd& flat) {
  const Points x(flat.data(), 3, flat.size() / 3);
  find_neighbours(x);
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Index v, Index w, double value) {
    if (free_[v] >= 0 && free_[w] >= 0) entries.emplace_back(free_[v], free_[w], value);
  };
  const double width = 1 - settings.turn_from;
  for (const RouteChains::Chain& chain : chains_.chains) {
    const double h = chain.edge;
    for (Index v = chain.first; v < chain.last(); ++v) {
      add(v, v, 1 / h);
      add(v + 1, v + 1, 1 / h);
      add(v, v + 1, -1 / h);
      add(v + 1, v, -1 / h);
      if (!(chain.longest < infinity)) continue;
      const double pace_width = (1 - settings.pace_from) * chain.longest;
      const Push push =
          push_of(((x.col(v + 1) - x.col(v)).norm() - settings.pace_from * chain.longest) / pace_width, true);
      if (!(push.curvature > 0 && push.curvature < infinity)) continue;
      const double stiff = settings.pace * h * push.curvature / (pace_width * pace_width);
      add(v, v, stiff);
      add(v + 1, v + 1, stiff);
      add(v, v + 1, -stiff);
      add(v + 1, v, -stiff);
    }
    /// Weights of a second difference (fixed by algebra)
    constexpr std::array<double, 3> second = {1, -2, 1};
    for (Index v = chain.first + 1; v < chain.last(); ++v) {
      if (chains_.stands(v)) continue;
      const Turn turn = turn_at(x.col(v - 1), x.col(v), x.col(v + 1), chain.radius);
      const Push push = push_of((turn.value - settings.turn_from) / width, settings.strict_turns);
      const double by_bend = chain.radius / (h * h * width);
      const double stiff = settings.stiffness * chain.radius * chain.radius / (h * h * h) +
                           (push.curvature < infinity ? settings.turn * h * push.curvature * by_bend * by_bend : 0);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) add(v - 1 + i, v - 1 + j, stiff * second[i] * second[j]);
    }
  }
  for (const Pair& pair : pairs_) {
    const double need = needed(pair), gap = settings.cushion * need;
    const Closest closest = closest_pair(x, pair);
    const Push push = push_of((need + gap - closest.distance) / gap, settings.strict);
    if (!(push.curvature > 0 && push.curvature < infinity)) continue;
    const double stiff = weight_of(pair) * push.curvature / (gap * gap);
    const Index a = chains_.segment_vertex[pair.a], b = chains_.segment_vertex[pair.b];
    const std::array<Index, 4> vertices = {a, a + 1, b, b + 1};
    // Both sides may move together. Without contacts in the matrix, many more steps are needed.
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) add(vertices[i], vertices[j], stiff * closest.weights[i] * closest.weights[j]);
  }
  for (const ObstaclePair& pair : obstacle_pairs_) {
    const RouteChains::Chain& chain = chains_.chains[chains_.segment_chain[pair.segment]];
    const double gap = settings.cushion * chain.radius;
    const Index v = chains_.segment_vertex[pair.segment];
    const ClosestToTriangle closest = closest_obstacle(x, pair);
    const Push push = push_of((chain.radius + gap - closest.distance) / gap, true);
    if (!(push.curvature > 0 && push.curvature < infinity)) continue;
    const double stiff = settings.obstacle * chain.edge * push.curvature / (gap * gap);
    add(v, v, stiff * closest.weights[0] * closest.weights[0]);
    add(v + 1, v + 1, stiff * closest.weights[1] * closest.weights[1]);
  }
  Eigen::SparseMatrix<double> matrix(free_count_, free_count_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(matrix);
}

void RouteEnergy::precondition(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
  out.setZero(v.size());
  if (free_count_ == 0) return;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(free_count_, 3);
  const Index n = static_cast<Index>(v.size() / 3);
  for (Index i = 0; i < n; ++i)
    if (free_[i] >= 0) columns.row(free_[i]) += v.segment<3>(3 * i).transpose();
  const Eigen::MatrixXd solved = factor_.solve(columns);
  for (Index i = 0; i < n; ++i)
    if (free_[i] >= 0) out.segment<3>(3 * i) = solved.row(free_[i]).transpose();
}

}  // namespace unsnarl
