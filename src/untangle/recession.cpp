#include "untangle/recession.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "mesh/areas.h"

namespace unsnarl {
namespace {

/// Gradients of the three corners' hat functions, one column each; zero where the triangle has no area.
Eigen::Matrix3d hat_gradients(const Positions& x, const Triangle& t) {
  const Vec3 normal = area_vector(x, t);
  const double squared = normal.squaredNorm();
  Eigen::Matrix3d gradients = Eigen::Matrix3d::Zero();
  if (!(squared > 0)) return gradients;
  for (int k = 0; k < 3; ++k) {
    gradients.col(k) = normal.cross(x.col(t[(k + 2) % 3]) - x.col(t[(k + 1) % 3])) / squared;
  }
  return gradients;
}

double cotangent(const Positions& x, const Triangle& t, int corner) {
  const Vec3 a = x.col(t[(corner + 1) % 3]) - x.col(t[corner]), b = x.col(t[(corner + 2) % 3]) - x.col(t[corner]);
  const double sine = a.cross(b).norm();
  return sine > 0 ? a.dot(b) / sine : 0;
}

}  // namespace

Recession::Recession(std::span<const Triangle> triangles, const Positions& rest, Index free_count,
                     std::span<const Index> avoided, const RecessionOptions& options)
    : triangles_(triangles),
      rest_(rest),
      options_(options),
      edges_(build_edges(triangles)),
      edge_length_(mean_edge_length(rest, triangles)) {
  const Index n = static_cast<Index>(rest.cols());
  std::vector<char> is_boundary(edges_.edges.size(), 0), reached(n, 0);
  std::vector<Index> front;
  for (std::size_t e = 0; e < edges_.edges.size(); ++e) {
    const auto [u, v] = edges_.edges[e];
    if (edges_.triangles_of_edge[static_cast<Index>(e)].size() != 1 || u >= free_count || v >= free_count) continue;
    is_boundary[e] = 1;
    for (const Index w : {u, v}) {
      if (!reached[w]) front.push_back(w);
      reached[w] = 1;
    }
  }
  if (front.empty() || !(edge_length_ > 0)) return;
  const IndexLists neighbours = vertex_neighbours(edges_.edges, n);
  while (!front.empty()) {
    const Index v = front.back();
    front.pop_back();
    for (const Index w : neighbours[v]) {
      if (reached[w]) continue;
      reached[w] = 1;
      front.push_back(w);
    }
  }
  on_spine_ = find_spine(reached, is_boundary, avoided);
  solve_field(reached, is_boundary);
  if (!possible_) return;

  const IndexLists triangles_of = triangles_of_vertices(triangles, n);
  for (Index v = 0; v < free_count; ++v) {
    if (!reached[v]) continue;
    // Into the triangle that the field points into.
    Traveller start{v, -1, Vec3::Zero()};
    double best = -1;
    for (const Index t : triangles_of[v]) {
      const Triangle& corners = triangles[t];
      double inward = 1;
      int at = 0;
      for (int k = 0; k < 3; ++k) {
        if (corners[k] == v) at = k;
      }
      const Vec3 rates = hat_gradients(rest, corners).transpose() * field_[t][at];
      for (int k = 0; k < 3; ++k) {
        if (k != at) inward = std::min(inward, rates[k] / (rates.cwiseAbs().maxCoeff() + 1e-300));
      }
      if (start.triangle >= 0 && inward <= best) continue;
      best = inward;
      start.triangle = t;
      start.weights = Vec3::Zero();
      start.weights[at] = 1;
    }
    if (start.triangle >= 0) travellers_.push_back(start);
  }
  follow_lines();
}

// Takes away triangles at a free edge, and edges at a free vertex, those nearest the boundary first.
std::vector<char> Recession::find_spine(const std::vector<char>& reached, const std::vector<char>& is_boundary,
                                        std::span<const Index> avoided) const {
  const Index n = static_cast<Index>(rest_.cols());
  const Index edge_count = static_cast<Index>(edges_.edges.size());
  std::vector<std::vector<Index>> edges_of(n);
  for (Index e = 0; e < edge_count; ++e) {
    for (const Index v : edges_.edges[e]) edges_of[v].push_back(e);
  }
  using Entry = std::pair<double, Index>;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;
  std::vector<double> distance(n, std::numeric_limits<double>::infinity());
  Queue front;
  for (Index e = 0; e < edge_count; ++e) {
    if (!is_boundary[e]) continue;
    for (const Index v : edges_.edges[e]) {
      distance[v] = 0;
      front.emplace(0.0, v);
    }
  }
  for (const Index v : avoided) {
    distance[v] = 0;
    front.emplace(0.0, v);
  }
  while (!front.empty()) {
    const auto [d, v] = front.top();
    front.pop();
    if (d > distance[v]) continue;
    for (const Index e : edges_of[v]) {
      const Index w = edges_.edges[e][0] == v ? edges_.edges[e][1] : edges_.edges[e][0];
      const double through = d + (rest_.col(v) - rest_.col(w)).norm();
      if (through >= distance[w]) continue;
      distance[w] = through;
      front.emplace(through, w);
    }
  }

  std::vector<char> has_triangle(triangles_.size(), 1), has_edge(edge_count, 1);
  std::vector<Index> triangles_left(edge_count), edges_left(n);
  for (Index e = 0; e < edge_count; ++e) {
    triangles_left[e] = static_cast<Index>(edges_.triangles_of_edge[e].size());
    for (const Index v : edges_.edges[e]) ++edges_left[v];
  }
  // An edge may go with its last triangle, a vertex with its last edge (ids behind those of the edges).
  Queue queue;
  const auto offer_edge = [&](Index e) {
    if (has_edge[e] && triangles_left[e] == 1) {
      queue.emplace(0.5 * (distance[edges_.edges[e][0]] + distance[edges_.edges[e][1]]), e);
    }
  };
  const auto offer_vertex = [&](Index v) {
    if (edges_left[v] == 1) queue.emplace(distance[v], edge_count + v);
  };
  const auto remove_edge = [&](Index e) {
    has_edge[e] = 0;
    for (const Index v : edges_.edges[e]) {
      --edges_left[v];
      offer_vertex(v);
    }
  };
  for (Index e = 0; e < edge_count; ++e) {
    if (is_boundary[e]) offer_edge(e);
  }
  std::vector<char> removed(n, 0);
  while (!queue.empty()) {
    const Index id = queue.top().second;
    queue.pop();
    if (id < edge_count) {
      if (!has_edge[id] || triangles_left[id] != 1) continue;
      for (const Index t : edges_.triangles_of_edge[id]) {
        if (!has_triangle[t]) continue;
        has_triangle[t] = 0;
        for (const Index e : edges_.edges_of_triangle[t]) {
          if (e < 0) continue;
          --triangles_left[e];
          if (e != id) offer_edge(e);
        }
      }
      remove_edge(id);
    } else {
      const Index v = id - edge_count;
      if (edges_left[v] != 1) continue;
      for (const Index e : edges_of[v]) {
        if (!has_edge[e] || triangles_left[e] != 0) continue;
        removed[v] = 1;
        remove_edge(e);
      }
    }
  }
  std::vector<char> on_spine(n, 0);
  for (Index v = 0; v < n; ++v) on_spine[v] = reached[v] && !removed[v] && !edges_of[v].empty();
  return on_spine;
}

void Recession::solve_field(const std::vector<char>& reached, const std::vector<char>& is_boundary) {
  const Index n = static_cast<Index>(rest_.cols());
  std::vector<Index> row(n, -1);
  Index rows = 0;
  for (Index v = 0; v < n; ++v) {
    if (reached[v] && !on_spine_[v]) row[v] = rows++;
  }
  if (rows == 0) return;
  std::vector<double> edge_weight(edges_.edges.size(), 0.0);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Index e = edges_.edges_of_triangle[t][(k + 1) % 3];
      if (e >= 0) edge_weight[e] += 0.5 * cotangent(rest_, triangles_[t], k);
    }
  }
  Eigen::VectorXd source = Eigen::VectorXd::Zero(rows);
  std::vector<double> diagonal(rows, 0.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t e = 0; e < edges_.edges.size(); ++e) {
    const auto [u, v] = edges_.edges[e];
    const double w = std::clamp(edge_weight[e], 1 / options_.largest_cotangent, options_.largest_cotangent);
    for (const auto& [i, j] : {std::pair{u, v}, std::pair{v, u}}) {
      if (row[i] < 0) continue;
      diagonal[row[i]] += w;
      if (on_spine_[j]) source[row[i]] += w;
    }
    if (row[u] >= 0 && row[v] >= 0) entries.emplace_back(std::max(row[u], row[v]), std::min(row[u], row[v]), -w);
    if (!is_boundary[e]) continue;
    // 0 a mean edge outside the boundary: on it, triangles with all corners on the boundary would stand still.
    const double share = 0.5 * (rest_.col(u) - rest_.col(v)).norm() / edge_length_;
    for (const Index i : {u, v}) {
      if (row[i] >= 0) diagonal[row[i]] += share;
    }
  }
  for (Index r = 0; r < rows; ++r) entries.emplace_back(r, r, diagonal[r]);
  Eigen::SparseMatrix<double> matrix(rows, rows);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) return;
  const Eigen::VectorXd psi = factor.solve(source);
  if (!psi.allFinite()) return;

  std::vector<Vec3> gradients(triangles_.size(), Vec3::Zero());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Eigen::Matrix3d hats = hat_gradients(rest_, triangles_[t]);
    for (int k = 0; k < 3; ++k) {
      const Index v = triangles_[t][k];
      gradients[t] += (on_spine_[v] ? 1.0 : row[v] >= 0 ? psi[row[v]] : 0.0) * hats.col(k);
    }
  }
  smooth_field(gradients);
  possible_ = true;
}

// Averages the triangles' gradients at each vertex, fan by fan: chains of triangles joined by edges at the vertex.
void Recession::smooth_field(const std::vector<Vec3>& gradients) {
  field_.assign(triangles_.size(), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  const IndexLists triangles_of = triangles_of_vertices(triangles_, static_cast<Index>(rest_.cols()));
  std::vector<char> used(triangles_.size(), 0);
  std::vector<Index> fan, other_way;
  for (Index v = 0; v < triangles_of.size(); ++v) {
    for (const Index first : triangles_of[v]) {
      if (used[first]) continue;
      // One way until the boundary or the start, then the other way.
      bool closed = false;
      const auto extend = [&](std::vector<Index>& list, int edge) {
        for (Index t = first; t >= 0;) {
          const Index next = across(t, edge);
          if (next == first) closed = true;
          if (next < 0 || used[next]) break;
          used[next] = 1;
          list.push_back(next);
          // On through the other edge at v.
          const Index shared = edges_.edges_of_triangle[t][edge];
          for (int k = 0; k < 3; ++k) {
            const Index e = edges_.edges_of_triangle[next][k];
            if (e != shared && e >= 0 && (edges_.edges[e][0] == v || edges_.edges[e][1] == v)) edge = k;
          }
          t = next;
        }
      };
      int at = 0;
      while (triangles_[first][at] != v) ++at;
      used[first] = 1;
      other_way.clear();
      extend(other_way, (at + 2) % 3);
      fan.assign(other_way.rbegin(), other_way.rend());
      fan.push_back(first);
      if (!closed) {
        extend(fan, at);
        closed = false;
      }
      smooth_fan(v, fan, closed, gradients);
    }
    for (const Index t : triangles_of[v]) used[t] = 0;
  }
}

// In the fan laid out flat, all angles scaled to make a full turn where it is closed, so that pinches and sharp
// creases are as good as flat ground.
void Recession::smooth_fan(Index v, std::span<const Index> fan, bool closed, const std::vector<Vec3>& gradients) {
  struct Frame {
    Index triangle;
    int corner;
    Vec3 middle, side;  // the bisector of the corner; perpendicular to it, towards the next triangle
    double angle = 0;   // of the bisector in the fan
  };
  std::vector<Frame> frames;
  std::vector<double> corner_angles;
  double total = 0;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const Triangle& t = triangles_[fan[i]];
    int k = 0;
    while (t[k] != v) ++k;
    // The corner that is shared with the next triangle, or not shared with the one before.
    Index leaving = t[(k + 1) % 3], entering = t[(k + 2) % 3];
    const auto has = [&](std::size_t j, Index w) {
      const Triangle& s = triangles_[fan[j]];
      return s[0] == w || s[1] == w || s[2] == w;
    };
    if (i + 1 < fan.size() ? !has(i + 1, leaving) : i > 0 && has(i - 1, leaving)) std::swap(leaving, entering);
    // With two triangles both corners may be shared; then any consistent choice does.
    const Vec3 a = (rest_.col(entering) - rest_.col(v)).normalized(),
               b = (rest_.col(leaving) - rest_.col(v)).normalized();
    const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
    Frame frame{fan[i], k, (a + b).normalized(), (b - a).normalized(), total + 0.5 * angle};
    total += angle;
    frames.push_back(frame);
  }
  if (!(total > 0)) return;
  const double scale = closed ? 2 * std::numbers::pi / total : 1;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double area = 0;
  for (Frame& frame : frames) {
    frame.angle *= scale;
    const double share = triangle_area(rest_, triangles_[frame.triangle]);
    const Vec3& gradient = gradients[frame.triangle];
    mean += share *
            (Eigen::Rotation2Dd(frame.angle) * Eigen::Vector2d(gradient.dot(frame.middle), gradient.dot(frame.side)));
    area += share;
  }
  if (!(area > 0)) return;
  mean /= area;
  mean = on_spine_[v] || !(mean.norm() > 0) ? Eigen::Vector2d::Zero().eval() : mean.normalized().eval();
  for (const Frame& frame : frames) {
    const Eigen::Vector2d here = Eigen::Rotation2Dd(-frame.angle) * mean;
    field_[frame.triangle][frame.corner] = here[0] * frame.middle + here[1] * frame.side;
  }
}

Vec3 Recession::velocity(const Traveller& traveller) const {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) sum += traveller.weights[k] * field_[traveller.triangle][k];
  return sum;
}

Index Recession::across(Index triangle, int edge) const {
  const Index e = edges_.edges_of_triangle[triangle][edge];
  if (e < 0) return -1;
  for (const Index t : edges_.triangles_of_edge[e]) {
    if (t != triangle) return t;
  }
  return -1;
}

void Recession::travel(Traveller& traveller, double duration) const {
  constexpr int most_triangles = 64;  // of fans around a vertex; a step is shorter than an edge
  int kept = -1;                      // the corner whose weight stays 0: the way leads along the edge opposite it
  Index previous = -1;
  for (int hop = 0; hop < most_triangles && duration > 0; ++hop) {
    const Triangle& t = triangles_[traveller.triangle];
    Vec3 going = velocity(traveller);
    if (kept >= 0) {
      const Vec3 edge = (rest_.col(t[(kept + 2) % 3]) - rest_.col(t[(kept + 1) % 3])).normalized();
      going = going.dot(edge) * edge;
    }
    Vec3 rates = hat_gradients(rest_, t).transpose() * going;
    if (kept >= 0) rates[kept] = 0;
    // The first weight to reach 0 is that of the corner opposite the edge crossed.
    double time = duration;
    int corner = -1;
    for (int k = 0; k < 3; ++k) {
      if (rates[k] < 0 && -traveller.weights[k] / rates[k] < time) {
        time = -traveller.weights[k] / rates[k];
        corner = k;
      }
    }
    traveller.weights += time * rates;
    duration -= time;
    if (corner < 0) break;
    traveller.weights[corner] = 0;
    traveller.weights = traveller.weights.cwiseMax(0.0);
    traveller.weights /= traveller.weights.sum();
    const Index next = across(traveller.triangle, (corner + 1) % 3);
    if (kept < 0 && (next < 0 || (next == previous && time == 0))) {
      // The boundary, or both sides lead here: along the edge.
      kept = corner;
      continue;
    }
    if (next < 0) break;
    kept = -1;
    Vec3 weights = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) {
        if (l != corner && t[l] == triangles_[next][k]) weights[k] = traveller.weights[l];
      }
    }
    previous = traveller.triangle;
    traveller.triangle = next;
    traveller.weights = weights;
  }
}

void Recession::follow_lines() {
  const double step = options_.step * edge_length_;
  for (Traveller& traveller : travellers_) {
    const auto place = [&] {
      const Triangle& t = triangles_[traveller.triangle];
      return Vec3(traveller.weights[0] * rest_.col(t[0]) + traveller.weights[1] * rest_.col(t[1]) +
                  traveller.weights[2] * rest_.col(t[2]));
    };
    Line line{traveller.vertex, {place()}, {0.0}};
    for (int k = 0; k < options_.most_steps; ++k) {
      travel(traveller, step);
      const Vec3 next = place();
      const double length = (next - line.points.back()).norm();
      if (length < options_.arrived * step) break;
      line.points.push_back(next);
      line.lengths.push_back(line.lengths.back() + length);
    }
    lines_.push_back(std::move(line));
  }
}

void Recession::positions(double share, Positions& x) const {
  for (const Line& line : lines_) {
    const double length = share * line.lengths.back();
    std::size_t k = std::upper_bound(line.lengths.begin(), line.lengths.end(), length) - line.lengths.begin();
    if (k == 0 || line.points.size() < 2) continue;
    k = std::min(k, line.points.size() - 1);
    const double along = (length - line.lengths[k - 1]) / (line.lengths[k] - line.lengths[k - 1]);
    x.col(line.vertex) = (1 - along) * line.points[k - 1] + along * line.points[k];
  }
}

}  // namespace unsnarl
