#include "recover/unflip_faces.h"

#include <algorithm>

namespace unsnarl {
namespace {

/// The face's free corners and `rings` around them; ascending.
std::vector<Index> region_around(const Patch& patch, const Triangle& face, const IndexLists& neighbours, int rings) {
  std::vector<Index> region(face.begin(), face.end()), front = region, next;
  for (int ring = 0; ring < rings; ++ring) {
    next.clear();
    for (Index v : front) next.insert(next.end(), neighbours[v].begin(), neighbours[v].end());
    region.insert(region.end(), next.begin(), next.end());
    front.swap(next);
    for (auto* list : {&region, &front}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
  }
  std::erase_if(region, [&](Index v) { return v >= patch.free_count; });
  std::sort(region.begin(), region.end());
  return region;
}

/// Sets each vertex's displacement to the mean of its neighbours', in sweeps that come near enough to a fixed point.
void smooth_displacements(Patch& patch, std::span<const Index> region, const IndexLists& neighbours) {
  constexpr int sweeps = 30;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (Index v : region) {
      Vec3 sum = Vec3::Zero();
      for (Index w : neighbours[v]) sum += patch.x.col(w) - patch.rest.col(w);
      const auto count = static_cast<double>(neighbours[v].size());
      if (count > 0) patch.x.col(v) = patch.rest.col(v) + sum / count;
    }
  }
}

}  // namespace

std::vector<Index> flipped_faces(const Patch& patch, const OrientationPenalty& orientation) {
  std::vector<Index> faces;
  for (Index t = 0; t < patch.active_count; ++t)
    if (orientation.is_flipped(patch.x, t)) faces.push_back(t);
  return faces;
}

Index unflip_faces(Patch& patch, const IndexLists& neighbours, const OrientationPenalty& orientation,
                   EmbeddingGuard& guard, int max_rings) {
  const std::vector<Index> before = flipped_faces(patch, orientation);
  std::size_t count = before.size();
  for (Index t : before) {
    for (int rings = 0; rings <= max_rings && orientation.is_flipped(patch.x, t); ++rings) {
      const Positions kept = patch.x;
      smooth_displacements(patch, region_around(patch, patch.triangles[t], neighbours, rings), neighbours);
      const std::size_t now = flipped_faces(patch, orientation).size();
      if (now < count && guard.new_pairs(patch.x).empty()) {
        count = now;
      } else {
        patch.x = kept;
      }
    }
  }
  return static_cast<Index>(before.size() - count);
}

}  // namespace unsnarl
