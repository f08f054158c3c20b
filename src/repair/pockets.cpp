#include "repair/pockets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace unsnarl {
namespace {

/// Vertices around a pocket for an edge of its depth that counts: two for a finger, which can leave sideways by half
/// its girth; discs have six.
constexpr int girth_per_edge = 2;
/// What is deeper, as a share of the root of the number of faces, is a limb or the outside rather than a pocket.
constexpr double largest_share = 0.2;

/// The parts that the intersecting faces cut the surface into, as far as they have been reached.
class Parts {
 public:
  Parts(const Scene& scene, std::span<const Index> core) : scene_(scene), front_(core.begin(), core.end()) {
    for (const Index v : core) part_of_[v] = none;
  }

  /// Goes one edge farther from the core; false where nothing was left.
  bool grow() {
    ++depth_;
    std::vector<Index> next;
    for (const Index v : front_)
      for (const Index w : scene_.neighbours[v]) {
        if (!part_of_.try_emplace(w, static_cast<Index>(parent_.size())).second) continue;
        parent_.push_back(static_cast<Index>(parent_.size()));
        first_vertex_.push_back(w);
        depth_of_.push_back(depth_);
        girth_of_.push_back(depth_ == 1);
        next.push_back(w);
      }
    for (const Index v : next)
      for (const Index w : scene_.neighbours[v])
        if (const auto it = part_of_.find(w); it != part_of_.end() && it->second != none)
          unite(part_of_[v], it->second);
    front_ = std::move(next);
    return !front_.empty();
  }

  /// Depth of the deepest part that has been reached to its bottom; of each connected surface the deepest is the
  /// outside and does not count.
  int deepest_pocket(std::span<const Index> component_of_vertex) {
    std::vector<std::array<int, 3>> parts;  // component, depth and girth
    for (Index part = 0; part < static_cast<Index>(parent_.size()); ++part)
      if (parent_[part] == part)
        parts.push_back({component_of_vertex[first_vertex_[part]], depth_of_[part], girth_of_[part]});
    std::sort(parts.begin(), parts.end());
    int deepest = 0;
    for (std::size_t k = 0; k + 1 < parts.size(); ++k)
      if (parts[k][1] < depth_ && parts[k][0] == parts[k + 1][0])
        deepest = std::max(deepest, std::min(parts[k][1], parts[k][2] / girth_per_edge));
    return deepest;
  }

 private:
  static constexpr Index none = -1;

  Index find(Index part) {
    while (parent_[part] != part) part = parent_[part] = parent_[parent_[part]];
    return part;
  }
  void unite(Index a, Index b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    depth_of_[a] = std::max(depth_of_[a], depth_of_[b]);
    girth_of_[a] += girth_of_[b];
  }

  const Scene& scene_;
  std::vector<Index> front_;
  int depth_ = 0;
  std::unordered_map<Index, Index> part_of_;  // of vertices; never gone through in its order
  std::vector<Index> parent_;
  std::vector<Index> first_vertex_;
  std::vector<int> depth_of_;
  std::vector<int> girth_of_;  // vertices next to the core
};

}  // namespace

int pocket_depth(const Scene& scene, std::span<const Index> component_of_vertex, const ConflictRegion& region) {
  const int at_most = static_cast<int>(largest_share * std::sqrt(static_cast<double>(scene.triangle_count())));
  Parts parts(scene, region.core);
  for (int depth = 0; depth < at_most && parts.grow(); ++depth) {
  }
  return parts.deepest_pocket(component_of_vertex);
}

}  // namespace unsnarl
