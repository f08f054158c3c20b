#pragma once

#include <span>
#include <string>

#include "geometry/types.h"
#include "render/image.h"
#include "unsnarl/surface.h"

namespace unsnarl {

struct PictureOptions {
  int width = 1600;  ///< pixels of the whole picture, [64, 16384]
  int height = 800;  ///< pixels, [64, 16384]
  /// Text above each half; '\n' starts a second, smaller line. Printable ASCII; what does not fit is cut off.
  std::string before_label = "before";
  std::string after_label = "after";
  /// Adds a magnified view of the densest group of red faces (of `before`) in a corner of each half, where they are
  /// small in the main view.
  bool inset = true;
};

/// Before and after side by side under one camera, which looks down on the surfaces at a three-quarter angle: y up (z
/// where they reach much further along z), the longer horizontal axis to the right. Red faces show through what hides
/// them as a tint.
///
/// before, after: valid polygon meshes; polygons are drawn as fans, faces with corners that are not finite left out.
/// red_before, red_after: face ids of `before` and `after`, in any order.
/// Throws std::invalid_argument for a size or a face id out of range. Deterministic.
Image render_pair(const SurfaceView& before, std::span<const Index> red_before, const SurfaceView& after,
                  std::span<const Index> red_after, const PictureOptions& options = {});

/// One surface alone; `before_label` is its label.
Image render_surface(const SurfaceView& surface, std::span<const Index> red, const PictureOptions& options = {});

}  // namespace unsnarl
