#pragma once

#include <functional>
#include <span>

#include "render/image.h"
#include "unsnarl/recording.h"
#include "unsnarl/surface.h"

namespace unsnarl {

struct AnimationOptions {
  int width = 840;   ///< pixels, [128, 4096]
  int height = 480;  ///< pixels, [128, 4096]
};

/// Draws the frames of a recording one after the other and hands each picture to `take`, with the seconds that it is to
/// be shown (ten in all, the first and the last longer than the others): the surface under a camera that does not move,
/// intersecting faces in red; above it what is going on; below it, over all frames, the number of intersecting pairs
/// and how far the surface is from the input. Where conflicts are small in the whole view, they are shown magnified
/// beside it. Frames in which next to nothing has moved are left out.
///
/// surface: the input of the repair. Throws std::invalid_argument for a size out of range, or frames that are not of
/// this surface. Deterministic.
void render_animation(const SurfaceView& surface, std::span<const RecordedFrame> frames,
                      const AnimationOptions& options, const std::function<void(Image, double seconds)>& take);

}  // namespace unsnarl
