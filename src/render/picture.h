#pragma once

#include <span>

#include "geometry/types.h"
#include "render/image.h"
#include "unsnarl/pictures.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// The pictures of picture_png() as pixels: the same arguments, the same errors.
Image render_pair(const SurfaceView& before, std::span<const Index> red_before, const SurfaceView& after,
                  std::span<const Index> red_after, const PictureOptions& options = {});
Image render_surface(const SurfaceView& surface, std::span<const Index> red, const PictureOptions& options = {});

}  // namespace unsnarl
