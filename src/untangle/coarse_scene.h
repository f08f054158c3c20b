#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/patch.h"
#include "scene/scene.h"

namespace unsnarl {

/// A patch with about a quarter of its active triangles, as a scene of its own at rest, in which what was fixed in the
/// patch is fixed. What moves there carries the vertices of the patch along.
class CoarseScene {
 public:
  /// None where the patch cannot be simplified that far without leaving its surface by much.
  static std::optional<CoarseScene> of(const Patch& patch);

  const Scene& scene() const { return scene_; }

  /// Moves the free vertices of the patch, from where they are, as the scene around them has moved to x.
  void carry(const Positions& x, Patch& patch) const;

 private:
  /// Where a vertex of the patch lies on the coarse surface.
  struct Place {
    Triangle corners;  // of the scene
    Vec3 weights;
  };
  Scene scene_;
  std::vector<Place> places_;  // of the free vertices
};

}  // namespace unsnarl
