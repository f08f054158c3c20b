#include "render/picture.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/camera.h"
#include "render/closeup.h"
#include "render/drawable.h"
#include "render/layout.h"
#include "render/shading.h"

namespace unsnarl {
namespace {

/// Largest side of a magnified part, in heights of the picture: it is magnified 1.5 times at least.
constexpr double largest_window = 0.24;

struct Panel {
  Drawable drawable;
  std::string label;
};

void check_size(const PictureOptions& options) {
  for (int size : {options.width, options.height})
    if (size < 64 || size > 16384)
      throw std::invalid_argument("a picture of " + std::to_string(options.width) + " x " +
                                  std::to_string(options.height) +
                                  " pixels cannot be made; both must be from 64 to 16384");
}

/// Non-white pixels of an image within a rectangle.
std::size_t covered(const Image& image, Rectangle r) {
  std::size_t count = 0;
  for (int y = r.y; y < r.y + r.height; ++y)
    for (int x = r.x; x < r.x + r.width; ++x) count += image.at(x, y)[1] < 250 ? 1 : 0;
  return count;
}

/// The corner of the panels in which an inset hides least, over all panels; bottom right where none is better.
Rectangle inset_place(const std::vector<Image>& views, const Window& window, int width, int height) {
  const int side = static_cast<int>(0.36 * std::min(width, height)), gap = std::max(2, height / 100);
  Rectangle best;
  double least = -1;
  for (const auto& [x, y] : {std::pair(width - side - gap, height - side - gap), std::pair(gap, height - side - gap),
                             std::pair(width - side - gap, gap), std::pair(gap, gap)}) {
    const Rectangle r{x, y, side, side};
    double hidden = 0;
    for (const Image& view : views) hidden += static_cast<double>(covered(view, r));
    const bool over_window = std::abs(window.x - (x + 0.5 * side)) < 0.5 * (side + window.side) &&
                             std::abs(window.y - (y + 0.5 * side)) < 0.5 * (side + window.side);
    if (over_window) hidden += 1e9;
    if (least < 0 || hidden < least) {
      least = hidden;
      best = r;
    }
  }
  return best;
}

Image render_panels(std::vector<Panel> panels, const PictureOptions& options) {
  const int count = static_cast<int>(panels.size());
  const double letters = std::clamp(options.height / 40.0, 7.0, 40.0);
  const bool two_lines =
      std::any_of(panels.begin(), panels.end(), [](const Panel& p) { return p.label.find('\n') != std::string::npos; });
  const int bar = static_cast<int>((two_lines ? 4 : 2.6) * letters);
  const int width = options.width / count, height = options.height - bar;

  std::vector<double> positions;  // both states in one frame
  for (const Panel& panel : panels)
    for (const Vec3& p : panel.drawable.positions) positions.insert(positions.end(), {p[0], p[1], p[2]});
  const Camera camera = three_quarter_view(positions, double(width) / height, 0.04);

  Image image(options.width, options.height);
  std::vector<Image> views;
  for (const Panel& panel : panels) views.push_back(shade(panel.drawable, camera, width, height));

  const auto window =
      options.inset ? worth_magnifying(panels.front().drawable, camera, width, height, largest_window) : std::nullopt;
  if (window) {
    const Rectangle place = inset_place(views, *window, width, height);
    const Camera narrow = narrowed(camera, *window, width, height);
    const int line = std::max(1, options.height / 600);
    const auto half = static_cast<int>(window->side / 2);
    for (std::size_t k = 0; k < views.size(); ++k) {
      outline(views[k], {static_cast<int>(window->x) - half, static_cast<int>(window->y) - half, 2 * half, 2 * half},
              line, ink);
      paste(views[k], shade(panels[k].drawable, narrow, place.width, place.height), place.x, place.y);
      outline(views[k], place, line, ink);
    }
  }
  for (int k = 0; k < count; ++k) {
    paste(image, views[k], k * width, bar);
    if (k > 0) fill(image, {k * width, 0, 1, options.height}, rule_grey);
    draw_label(image, panels[k].label, k * width + static_cast<int>(letters), (k + 1) * width, letters);
  }
  return image;
}

}  // namespace

Image render_pair(const SurfaceView& before, std::span<const Index> red_before, const SurfaceView& after,
                  std::span<const Index> red_after, const PictureOptions& options) {
  check_size(options);
  std::vector<Panel> panels;
  panels.push_back({make_drawable(before, red_before, options.files), options.before_label});
  panels.push_back({make_drawable(after, red_after, options.files), options.after_label});
  return render_panels(std::move(panels), options);
}

Image render_surface(const SurfaceView& surface, std::span<const Index> red, const PictureOptions& options) {
  check_size(options);
  std::vector<Panel> panels;
  panels.push_back({make_drawable(surface, red, options.files), options.before_label});
  return render_panels(std::move(panels), options);
}

}  // namespace unsnarl
