#include "recover/embedding_guard.h"

#include <algorithm>

#include "contact/blocking_pairs.h"

namespace unsnarl {

EmbeddingGuard::EmbeddingGuard(const Patch& patch)
    : patch_(patch), finder_(patch.triangles, patch.active_count, patch.passing()), tolerated_(finder_.find(patch.x)) {}

std::vector<IntersectingPair> EmbeddingGuard::new_pairs(const Positions& x) {
  return blocking_pairs(finder_.find(x), tolerated_);
}

Index EmbeddingGuard::roll_back(Positions& x, const Positions& safe) {
  // Each round takes back the vertices of newly intersecting faces, until there are none that can be taken back.
  Index count = 0;
  for (;;) {
    const std::vector<IntersectingPair> pairs = new_pairs(x);
    if (pairs.empty()) return count;
    Index put_back = 0;
    const auto restore = [&](Index v) {
      if (x.col(v) == safe.col(v)) return;
      x.col(v) = safe.col(v);
      ++put_back;
    };
    for (const IntersectingPair& pair : pairs) {
      for (Index v : patch_.triangles[pair.a]) restore(v);
      for (Index v : patch_.triangles[pair.b]) restore(v);
    }
    if (put_back == 0) {
      for (Index v = 0; v < patch_.free_count; ++v) restore(v);
      return count + put_back;
    }
    count += put_back;
  }
}

}  // namespace unsnarl
