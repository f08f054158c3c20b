#pragma once

#include <functional>
#include <span>

#include "render/image.h"
#include "unsnarl/pictures.h"
#include "unsnarl/recording.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Draws the frames of animation_gif() one after the other and hands each picture to `take`, with the seconds that it
/// is to be shown (ten in all, the first and the last longer than the others). The same arguments and errors; without
/// frames it does nothing.
void render_animation(const SurfaceView& surface, std::span<const RecordedFrame> frames,
                      const AnimationOptions& options, const std::function<void(Image, double seconds)>& take);

}  // namespace unsnarl
