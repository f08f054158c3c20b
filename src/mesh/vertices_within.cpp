#include "mesh/vertices_within.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace unsnarl {

IndexLists vertices_within(const Positions& x, const EdgeTable& edges, double length) {
  const auto n = static_cast<Index>(x.cols());
  const IndexLists neighbours = vertex_neighbours(edges.edges, n);
  IndexLists result;
  std::vector<double> distance(static_cast<std::size_t>(n), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (Index start = 0; start < n; ++start) {
    const std::size_t begin = result.items.size();
    std::vector<Index> reached = {start};
    distance[start] = 0;
    front.emplace(0.0, start);
    while (!front.empty()) {
      const auto [d, v] = front.top();
      front.pop();
      if (d > distance[v]) continue;
      if (v != start) result.items.push_back(v);
      for (const Index w : neighbours[v]) {
        const double through = d + (x.col(v) - x.col(w)).norm();
        if (!(through <= length) || through >= distance[w]) continue;
        distance[w] = through;
        reached.push_back(w);
        front.emplace(through, w);
      }
    }
    for (const Index v : reached) distance[v] = std::numeric_limits<double>::infinity();
    std::sort(result.items.begin() + static_cast<std::ptrdiff_t>(begin), result.items.end());
    result.offsets.push_back(static_cast<Index>(result.items.size()));
  }
  return result;
}

}  // namespace unsnarl
