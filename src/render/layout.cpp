#include "render/layout.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace unsnarl {

void fill(Image& image, Rectangle r, const Colour& colour) {
  for (int y = std::max(0, r.y); y < std::min(image.height, r.y + r.height); ++y)
    for (int x = std::max(0, r.x); x < std::min(image.width, r.x + r.width); ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
}

void outline(Image& image, Rectangle r, int line, const Colour& colour) {
  fill(image, {r.x, r.y, r.width, line}, colour);
  fill(image, {r.x, r.y + r.height - line, r.width, line}, colour);
  fill(image, {r.x, r.y, line, r.height}, colour);
  fill(image, {r.x + r.width - line, r.y, line, r.height}, colour);
}

void paste(Image& image, const Image& part, int x, int y) {
  for (int j = 0; j < part.height && y + j < image.height; ++j)
    for (int i = 0; i < part.width && x + i < image.width; ++i) std::copy_n(part.at(i, j), 3, image.at(x + i, y + j));
}

void draw_label(Image& image, const std::string& label, int x, int x_end, double size) {
  const auto end = label.find('\n');
  const std::string_view first = std::string_view(label).substr(0, end);
  draw_text(image, first, x, size, size, ink, x_end);
  if (end != std::string::npos)
    draw_text(image, std::string_view(label).substr(end + 1), x, 2.6 * size, 0.72 * size, pale_ink, x_end);
}

}  // namespace unsnarl
