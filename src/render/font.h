#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "render/image.h"

namespace unsnarl {

using Colour = std::array<double, 3>;  ///< sRGB, [0, 1]

/// Width of `text` when drawn, in pixels; `size` is the height of a capital letter.
double text_width(std::string_view text, double size);

/// Draws printable ASCII (anything else as a space) with the top of its capitals at y. What lies outside of the image
/// or right of x_end is cut off.
void draw_text(Image& image, std::string_view text, double x, double y, double size, const Colour& colour,
               double x_end);

}  // namespace unsnarl
