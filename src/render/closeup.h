#pragma once

#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/drawable.h"

namespace unsnarl {

/// A square of the image plane, in pixels of the main view.
struct Window {
  double x = 0, y = 0, side = 0;  ///< centre and side
};

/// The part of the view worth magnifying: all red faces where they lie close together, else around the most of them.
/// None where nothing is red, or where the main view shows it well enough. largest: side it may have, of the height.
std::optional<Window> worth_magnifying(const Drawable& drawable, const Camera& camera, int width, int height,
                                       double largest);

/// The same for up to `most` parts, as small as the red faces in them allow, that of most of these first. Others than
/// the first do not overlap those before and have a twentieth of all red faces at least.
std::vector<Window> all_worth_magnifying(const Drawable& drawable, const Camera& camera, int width, int height,
                                         double largest, std::size_t most);

/// The camera that shows the window of a view of this size alone.
Camera narrowed(const Camera& camera, const Window& window, int width, int height);

}  // namespace unsnarl
