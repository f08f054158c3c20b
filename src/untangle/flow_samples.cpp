#include "untangle/flow_samples.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "geometry/sort_unique.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"
#include "untangle/local_solver.h"

namespace unsnarl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// (distance, vertex), nearest first; ties by id, so that the order is a function of the input.
using Front = std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>>;

}  // namespace

FlowSamples::FlowSamples(std::span<const Triangle> triangles, const Positions& rest, Index free_count, double spacing)
    : spacing_(spacing), cluster_of_(rest.cols(), -1), weights_(rest.cols(), 0.0) {
  const Index n = static_cast<Index>(rest.cols());
  const EdgeTable table = build_edges(triangles);
  const IndexLists neighbours = vertex_neighbours(table.edges, n);
  std::vector<double> vertex_area(n, 0.0);
  double total = 0;
  for (const Triangle& t : triangles) {
    const double area = triangle_area(rest, t);
    total += area;
    for (const Index v : t) vertex_area[v] += area / 3;
  }
  // A cluster of zero-area faces still needs a mean.
  const double least_area = total > 0 ? 1e-12 * total / std::max<Index>(1, n) : 1.0;
  for (double& area : vertex_area) area = std::max(area, least_area);
  const auto length = [&](Index u, Index v) { return (rest.col(u) - rest.col(v)).norm(); };
  const auto same_side = [&](Index u, Index v) { return (u < free_count) == (v < free_count); };

  // Seeds: in a scrambled order, every vertex that no earlier seed covers.
  std::vector<Index> order;
  for (Index v = 0; v < n; ++v) {
    if (neighbours[v].size() > 0) order.push_back(v);
  }
  std::vector<double> key(n);
  for (Index v = 0; v < n; ++v) key[v] = jitter_of(v, 3);
  std::sort(order.begin(), order.end(), [&](Index u, Index v) { return std::tie(key[u], u) < std::tie(key[v], v); });
  std::vector<double> distance(n, infinity);
  std::vector<char> covered(n, 0);
  std::vector<Index> seeds, touched;
  for (const Index seed : order) {
    if (covered[seed]) continue;
    seeds.push_back(seed);
    Front front;
    distance[seed] = 0;
    touched.assign(1, seed);
    front.emplace(0.0, seed);
    while (!front.empty()) {
      const auto [d, v] = front.top();
      front.pop();
      if (d > distance[v]) continue;
      covered[v] = 1;
      for (const Index w : neighbours[v]) {
        const double through = d + length(v, w);
        if (!same_side(v, w) || through >= std::min(distance[w], spacing)) continue;
        if (distance[w] == infinity) touched.push_back(w);
        distance[w] = through;
        front.emplace(through, w);
      }
    }
    for (const Index v : touched) distance[v] = infinity;
  }
  std::sort(seeds.begin(), seeds.end());

  // Every vertex goes to its nearest seed.
  Front front;
  for (Index c = 0; c < static_cast<Index>(seeds.size()); ++c) {
    distance[seeds[c]] = 0;
    cluster_of_[seeds[c]] = c;
    front.emplace(0.0, seeds[c]);
  }
  while (!front.empty()) {
    const auto [d, v] = front.top();
    front.pop();
    if (d > distance[v]) continue;
    for (const Index w : neighbours[v]) {
      const double through = d + length(v, w);
      if (!same_side(v, w) || through >= distance[w]) continue;
      distance[w] = through;
      cluster_of_[w] = cluster_of_[v];
      front.emplace(through, w);
    }
  }
  areas_.assign(seeds.size(), 0.0);
  is_free_.resize(seeds.size());
  for (std::size_t c = 0; c < seeds.size(); ++c) is_free_[c] = seeds[c] < free_count;
  for (Index v = 0; v < n; ++v) {
    if (cluster_of_[v] >= 0) areas_[cluster_of_[v]] += vertex_area[v];
  }
  for (Index v = 0; v < n; ++v) {
    if (cluster_of_[v] >= 0) weights_[v] = vertex_area[v] / areas_[cluster_of_[v]];
  }

  // Clusters joined by an edge are neighbours.
  std::vector<std::pair<Index, Index>> links;
  for (const Edge& e : table.edges) {
    const Index c = cluster_of_[e[0]], d = cluster_of_[e[1]];
    if (c == d) continue;
    links.emplace_back(c, d);
    links.emplace_back(d, c);
  }
  sort_unique(links);
  offsets_.assign(seeds.size() + 1, 0);
  for (const auto& [c, d] : links) {
    ++offsets_[c + 1];
    neighbours_.push_back(d);
  }
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
}

void FlowSamples::points(const Positions& x, Positions& points) const {
  points = Positions::Zero(3, size());
  for (Index v = 0; v < static_cast<Index>(cluster_of_.size()); ++v) {
    if (cluster_of_[v] >= 0) points.col(cluster_of_[v]) += weights_[v] * x.col(v);
  }
}

void FlowSamples::spread(const Positions& gradient, Positions& vertex_gradient) const {
  for (Index v = 0; v < static_cast<Index>(cluster_of_.size()); ++v) {
    if (cluster_of_[v] >= 0) vertex_gradient.col(v) += weights_[v] * gradient.col(cluster_of_[v]);
  }
}

bool FlowSamples::adjacent(Index i, Index j) const {
  const auto begin = neighbours_.begin() + offsets_[i], end = neighbours_.begin() + offsets_[i + 1];
  return std::binary_search(begin, end, j);
}

}  // namespace unsnarl
