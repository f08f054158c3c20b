#include "pipeline/restore_to_rest.h"

#include <cstdint>

#include "contact/blocking_pairs.h"

namespace unsnarl {

bool restore_what_is_too_far(Scene& scene, const std::vector<std::vector<Index>>& sets, double limit,
                             std::span<const IntersectingPair> known, IntersectionFinder& finder) {
  std::vector<Index> set_of(scene.vertex_count(), -1);
  std::vector<std::uint8_t> is_at_rest(sets.size(), 0);
  const auto restore_to_rest = [&](Index set) {
    is_at_rest[set] = 1;
    for (Index v : sets[set]) scene.x.col(v) = scene.rest.col(v);
  };
  for (Index set = 0; set < static_cast<Index>(sets.size()); ++set)
    for (Index v : sets[set]) set_of[v] = set;
  bool any = false;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (set_of[v] >= 0 && (scene.x.col(v) - scene.rest.col(v)).norm() > limit) {
      restore_to_rest(set_of[v]);
      any = true;
    }
  for (bool again = any; again;) {
    again = false;
    for (const IntersectingPair& pair : blocking_pairs(finder.find(scene.x), known))
      for (Index t : {pair.a, pair.b})
        for (Index v : scene.triangles[t])
          if (set_of[v] >= 0 && !is_at_rest[set_of[v]]) {
            restore_to_rest(set_of[v]);
            again = true;
          }
  }
  return any;
}

}  // namespace unsnarl
