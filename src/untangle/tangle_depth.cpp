#include "untangle/tangle_depth.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geometry/sort_unique.h"
#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// Vertices of the loop around an enclosed region for each edge of its depth that counts: a finger can leave sideways
/// by half its loop, which has two; a disc has six [E127] (unit: vertices / edge)
constexpr int loop_length_per_edge = 2;

/// The pieces that the intersecting faces cut the surface into, as far as they have been reached.
class Pieces {
 public:
  Pieces(const Scene& scene, std::span<const Index> core) : scene_(scene), front_(core.begin(), core.end()) {
    for (const Index v : core) part_of_[v] = none;
  }

  /// Goes one edge farther from the core.
  void grow() {
    ++depth_;
    std::vector<Index> next;
    for (const Index v : front_)
      for (const Index w : scene_.neighbours[v]) {
        if (!part_of_.try_emplace(w, static_cast<Index>(parts_.size())).second) continue;
        parts_.add();
        first_vertex_.push_back(w);
        depth_of_.push_back(depth_);
        loop_length_of_.push_back(depth_ == 1);
        next.push_back(w);
      }
    for (const Index v : next)
      for (const Index w : scene_.neighbours[v])
        if (const auto it = part_of_.find(w); it != part_of_.end() && it->second != none)
          unite(part_of_[v], it->second);
    front_ = std::move(next);
  }

  /// Is there a connected surface of which more than one part has not been reached to its bottom?
  bool may_enclose_more(std::span<const Index> component_of_vertex) {
    if (depth_ == 0) return true;
    std::vector<std::array<Index, 2>> growing;  // component and part
    for (const Index v : front_) growing.push_back({component_of_vertex[v], parts_.find(part_of_[v])});
    sort_unique(growing);
    return std::adjacent_find(growing.begin(), growing.end(),
                              [](const auto& a, const auto& b) { return a[0] == b[0]; }) != growing.end();
  }

  /// Depth of the deepest part that has been reached to its bottom; of each connected surface the deepest is the
  /// outside and does not count.
  int deepest_enclosed_region(std::span<const Index> component_of_vertex) {
    std::vector<std::array<int, 3>> found;  // component, depth and loop length
    for (Index part = 0; part < static_cast<Index>(parts_.size()); ++part)
      if (parts_.find(part) == part)
        found.push_back({component_of_vertex[first_vertex_[part]], depth_of_[part], loop_length_of_[part]});
    std::sort(found.begin(), found.end());
    int deepest = 0;
    for (std::size_t k = 0; k + 1 < found.size(); ++k)
      if (found[k][1] < depth_ && found[k][0] == found[k + 1][0])
        deepest = std::max(deepest, std::min(found[k][1], found[k][2] / loop_length_per_edge));
    return deepest;
  }

 private:
  static constexpr Index none = -1;  // in no part: of the core

  void unite(Index a, Index b) {
    a = parts_.find(a);
    b = parts_.find(b);
    if (!parts_.unite(a, b)) return;
    const Index part = std::min(a, b), other = std::max(a, b);
    depth_of_[part] = std::max(depth_of_[part], depth_of_[other]);
    loop_length_of_[part] += loop_length_of_[other];
  }

  const Scene& scene_;
  std::vector<Index> front_;
  int depth_ = 0;
  std::unordered_map<Index, Index> part_of_;  // of vertices; never gone through in its order
  UnionFind parts_{0};
  // By part; valid at the root of its set.
  std::vector<Index> first_vertex_;
  std::vector<int> depth_of_;
  std::vector<int> loop_length_of_;  // vertices next to the core
};

}  // namespace

ConnectedParts::ConnectedParts(const Scene& scene) {
  UnionFind sets = vertices_joined_by(scene.triangles, scene.vertex_count());
  of_vertex = sets.dense_ids();
  for (const Index part : of_vertex) count = std::max(count, part + 1);
}

int tangle_depth(const Scene& scene, const ConnectedParts& parts, std::span<const Index> core) {
  Pieces pieces(scene, core);
  while (pieces.may_enclose_more(parts.of_vertex)) pieces.grow();
  return pieces.deepest_enclosed_region(parts.of_vertex);
}

}  // namespace unsnarl
