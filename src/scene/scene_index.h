#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "scene/scene.h"

namespace unsnarl {

/// Finds the triangles of a scene that intersect, and those near a place, while its vertices move. It and its tree are
/// made once for all the work on a scene, since that takes as long as an exact check.
class SceneIndex {
 public:
  explicit SceneIndex(const Scene& scene);
  /// With a finder of the scene's triangles that is there already. Both must outlive this.
  SceneIndex(const Scene& scene, IntersectionFinder& finder);
  SceneIndex(const SceneIndex&) = delete;
  SceneIndex& operator=(const SceneIndex&) = delete;

  /// All intersecting pairs, sorted; whatever has moved since the last time.
  std::vector<IntersectingPair> find_pairs() { return finder_.find(scene_.x); }
  /// Takes note of whatever has moved.
  void update() { finder_.move(scene_.x); }
  /// Takes note that the triangles of these vertices have moved; the cost follows their number.
  void mark_moved(std::span<const Index> vertices);
  /// Appends the triangles that reach into the box where they are now, and some that only come near; each once,
  /// unsorted.
  void query(const Box& box, std::vector<Index>& found) const { finder_.query(box, found); }

 private:
  const Scene& scene_;
  std::optional<IntersectionFinder> own_;
  IntersectionFinder& finder_;
};

}  // namespace unsnarl
