#include "unsnarl/pictures.h"

#include <utility>
#include <vector>

#include "render/animation.h"
#include "render/gif.h"
#include "render/picture.h"
#include "render/png.h"

namespace unsnarl {

std::string picture_label(std::string_view title, std::size_t pairs) {
  const std::string count = pairs == 0   ? "no self-intersections"
                            : pairs == 1 ? "1 intersecting pair of faces"
                                         : std::to_string(pairs) + " intersecting pairs of faces";
  return std::string(title) + "\n" + count;
}

std::string picture_png(const SurfaceView& before, std::span<const std::int32_t> red_before, const SurfaceView& after,
                        std::span<const std::int32_t> red_after, const PictureOptions& options) {
  return encode_png(render_pair(before, red_before, after, red_after, options));
}

std::string picture_png(const SurfaceView& surface, std::span<const std::int32_t> red, const PictureOptions& options) {
  return encode_png(render_surface(surface, red, options));
}

std::string animation_gif(const SurfaceView& surface, std::span<const RecordedFrame> frames,
                          const AnimationOptions& options) {
  std::vector<Image> images;
  std::vector<double> delays;
  render_animation(surface, frames, options, [&](Image image, double seconds) {
    images.push_back(std::move(image));
    delays.push_back(seconds);
  });
  return encode_gif(images, delays);
}

void animation_pngs(const SurfaceView& surface, std::span<const RecordedFrame> frames, const AnimationOptions& options,
                    const std::function<void(std::string png)>& take) {
  render_animation(surface, frames, options, [&](const Image& image, double) { take(encode_png(image)); });
}

}  // namespace unsnarl
