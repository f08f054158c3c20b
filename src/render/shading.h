#pragma once

#include "render/camera.h"
#include "render/drawable.h"
#include "render/image.h"

namespace unsnarl {

struct ShadingOptions {
  int samples = 2;  ///< Samples for a pixel in each direction, in [1, 4] (unit: samples)
  /// Edges are drawn where the median one is at least this long (unit: pixels)
  double wireframe_from = 7;
  double xray = 0.5;  ///< Share of red that is drawn over what hides a red face (no unit)
};

/// The surface seen by the camera, on white: light from the upper left and from the right, front sides bluish and back
/// sides sand-coloured (further files in colours of their own), red faces vivid and shining through what hides them;
/// those that are narrower than two pixels are drawn so wide.
Image shade(const Drawable& drawable, const Camera& camera, int width, int height, const ShadingOptions& options = {});

}  // namespace unsnarl
