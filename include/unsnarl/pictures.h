#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "unsnarl/recording.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/surface.h"

namespace unsnarl {

struct PictureOptions {
  int width = 1600;  ///< pixels of the whole picture, [64, 16384]
  int height = 800;  ///< pixels, [64, 16384]
  /// Text above each half; '\n' starts a second, smaller line. Printable ASCII; what does not fit is cut off.
  std::string before_label = "before";
  std::string after_label = "after";
  /// Adds magnified views of the densest groups of red faces (of `before`) in corners of each half, where they are
  /// small in the main view: one, or up to three where groups lie far apart and corners are free.
  bool inset = true;
  /// The files that the surface is of: of several, each gets a colour of its own; empty: it is one.
  std::span<const SceneFile> files = {};
  /// Those of `before`, where they have other numbers of faces; empty: `files`.
  std::span<const SceneFile> files_before = {};
  /// Files from this number on are grey and translucent.
  std::size_t translucent_from = std::numeric_limits<std::size_t>::max();
};

/// A label of two lines: `title`, and how many pairs of faces intersect; `allowed`: besides those.
std::string picture_label(std::string_view title, std::size_t pairs, std::size_t allowed = 0);

/// Before and after side by side, as the bytes of a PNG file. The camera looks down on both at a three-quarter angle: y
/// up, unless a file says otherwise (SceneFile::up) or they reach much further along z, then z; the longer horizontal
/// axis to the right. Red faces show through what hides them as a tint.
///
/// before, after: valid polygon meshes; polygons are drawn as fans, faces with corners that are not finite left out.
/// red_before, red_after: face ids of `before` and `after`, in any order.
/// Throws std::invalid_argument for a size or a face id out of range. Deterministic.
std::string picture_png(const SurfaceView& before, std::span<const std::int32_t> red_before, const SurfaceView& after,
                        std::span<const std::int32_t> red_after, const PictureOptions& options = {});

/// One surface alone; `before_label` is its label.
std::string picture_png(const SurfaceView& surface, std::span<const std::int32_t> red,
                        const PictureOptions& options = {});

struct AnimationOptions {
  int width = 840;                        ///< pixels, [128, 4096]
  int height = 480;                       ///< pixels, [128, 4096]
  std::span<const SceneFile> files = {};  ///< as in PictureOptions
};

/// The frames of a recording as the bytes of an animated GIF that repeats: the surface under a camera that does not
/// move, intersecting faces in red; above it a caption; below it, over all frames, the number of intersecting pairs and
/// the distance from the input. Where conflicts are small in the whole view, they are shown magnified beside it. Frames
/// in which next to nothing has moved are left out.
///
/// surface: the input of the repair; frames: RepairResult::frames, at least one.
/// Throws std::invalid_argument for a size out of range, no frames, or frames that are not of this surface.
/// Deterministic.
std::string animation_gif(const SurfaceView& surface, std::span<const RecordedFrame> frames,
                          const AnimationOptions& options = {});

/// The pictures of the same animation, each handed to `take` as the bytes of a PNG file; none where there are no
/// frames.
void animation_pngs(const SurfaceView& surface, std::span<const RecordedFrame> frames, const AnimationOptions& options,
                    const std::function<void(std::string png)>& take);

}  // namespace unsnarl
