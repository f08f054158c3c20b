#pragma once

#include <string>

#include "render/font.h"
#include "render/image.h"

namespace unsnarl {

inline constexpr Colour ink = {0.13, 0.15, 0.19}, pale_ink = {0.42, 0.45, 0.50}, rule_grey = {0.84, 0.85, 0.87};

/// In pixels; what lies outside of an image is not drawn.
struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

void fill(Image& image, Rectangle r, const Colour& colour);
/// Lines of this width just inside.
void outline(Image& image, Rectangle r, int line, const Colour& colour);
/// Copies `part` with its upper left corner at (x, y) >= 0.
void paste(Image& image, const Image& part, int x, int y);
/// A line of text with capitals of this size, and after a '\n' a second, smaller and paler one; cut off at x_end.
void draw_label(Image& image, const std::string& label, int x, int x_end, double size);

}  // namespace unsnarl
