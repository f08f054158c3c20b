#include "unsnarl/pictures.h"

#include <utility>
#include <vector>

#include "geometry/scale.h"
#include "render/animation.h"
#include "render/gif.h"
#include "render/picture.h"
#include "render/png.h"

namespace unsnarl {
namespace {

/// A surface, and frames of it, at a scale: cameras and shading know moderate numbers only.
class AtScale {
 public:
  AtScale(const SurfaceView& surface, const Scale& scale, std::span<const RecordedFrame> frames = {})
      : surface_(surface), frames_(frames) {
    if (scale.is_one()) return;
    positions_ = scale.in(surface.positions);
    surface_.positions = positions_;
    scaled_frames_.assign(frames.begin(), frames.end());
    for (RecordedFrame& frame : scaled_frames_) frame.displacements = scale.in(frame.displacements);
    frames_ = scaled_frames_;
  }
  AtScale(const AtScale&) = delete;
  AtScale& operator=(const AtScale&) = delete;

  const SurfaceView& surface() const { return surface_; }
  std::span<const RecordedFrame> frames() const { return frames_; }

 private:
  SurfaceView surface_;
  std::span<const RecordedFrame> frames_;
  std::vector<double> positions_;
  std::vector<RecordedFrame> scaled_frames_;
};

}  // namespace

std::string picture_label(std::string_view title, std::size_t pairs, std::size_t allowed) {
  const std::string count = pairs == 0   ? "no self-intersections"
                            : pairs == 1 ? "1 intersecting pair of faces"
                                         : std::to_string(pairs) + " intersecting pairs of faces";
  const std::string besides = (pairs == 0 ? " but " : " and ") + std::to_string(allowed) + " allowed";
  return std::string(title) + "\n" + count + (allowed > 0 ? besides : "");
}

std::string picture_png(const SurfaceView& before, std::span<const std::int32_t> red_before, const SurfaceView& after,
                        std::span<const std::int32_t> red_after, const PictureOptions& options) {
  const Scale scale(before.positions);
  const AtScale scaled_before(before, scale), scaled_after(after, scale);
  return encode_png(render_pair(scaled_before.surface(), red_before, scaled_after.surface(), red_after, options));
}

std::string picture_png(const SurfaceView& surface, std::span<const std::int32_t> red, const PictureOptions& options) {
  return encode_png(render_surface(AtScale(surface, Scale(surface.positions)).surface(), red, options));
}

std::string animation_gif(const SurfaceView& surface, std::span<const RecordedFrame> frames,
                          const AnimationOptions& options) {
  const AtScale scaled(surface, Scale(surface.positions), frames);
  std::vector<Image> images;
  std::vector<double> delays;
  render_animation(scaled.surface(), scaled.frames(), options, [&](Image image, double seconds) {
    images.push_back(std::move(image));
    delays.push_back(seconds);
  });
  return encode_gif(images, delays);
}

void animation_pngs(const SurfaceView& surface, std::span<const RecordedFrame> frames, const AnimationOptions& options,
                    const std::function<void(std::string png)>& take) {
  const AtScale scaled(surface, Scale(surface.positions), frames);
  render_animation(scaled.surface(), scaled.frames(), options,
                   [&](const Image& image, double) { take(encode_png(image)); });
}

}  // namespace unsnarl
