#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "scene/scene.h"

namespace unsnarl {

/// Finds the triangles of a scene that intersect, and those near a place, while its vertices move. It is made once for
/// all work on a scene, since building its tree takes as long as an exact check.
class SceneIndex {
 public:
  explicit SceneIndex(const Scene& scene);
  /// Uses an existing finder of the scene's triangles. Both must outlive this.
  SceneIndex(const Scene& scene, IntersectionFinder& finder);
  SceneIndex(const SceneIndex&) = delete;
  SceneIndex& operator=(const SceneIndex&) = delete;

  /// All intersecting pairs at the present positions, sorted.
  std::vector<IntersectingPair> find_pairs() { return finder_.find(scene_.x); }
  /// Updates the index to the present positions.
  void update() { finder_.move(scene_.x); }
  /// Updates the index where only these vertices may have moved; the cost grows with their number.
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
