#include "pipeline/restore_to_rest.h"

#include <cstdint>

#include "untangle/local_solver.h"

namespace unsnarl {

bool restore_what_is_too_far(Scene& scene, const std::vector<std::vector<Index>>& sets, double limit,
                             std::span<const IntersectingPair> known, IntersectionFinder& finder) {
  std::vector<Index> set_of(scene.vertex_count(), -1);
  std::vector<std::uint8_t> is_home(sets.size(), 0);
  const auto restore_to_rest = [&](Index set) {
    is_home[set] = 1;
    for (Index v : sets[set]) scene.x.col(v) = scene.rest.col(v);
  };
  for (Index set = 0; set < static_cast<Index>(sets.size()); ++set)
    for (Index v : sets[set]) set_of[v] = set;
  bool sent = false;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (set_of[v] >= 0 && (scene.x.col(v) - scene.rest.col(v)).norm() > limit) {
      restore_to_rest(set_of[v]);
      sent = true;
    }
  for (bool again = sent; again;) {
    again = false;
    for (const IntersectingPair& pair : blocking_pairs(finder.find(scene.x), known))
      for (Index t : {pair.a, pair.b})
        for (Index v : scene.triangles[t])
          if (set_of[v] >= 0 && !is_home[set_of[v]]) {
            restore_to_rest(set_of[v]);
            again = true;
          }
  }
  return sent;
}

}  // namespace unsnarl
