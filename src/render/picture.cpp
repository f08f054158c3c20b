#include "render/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "render/camera.h"
#include "render/drawable.h"
#include "render/font.h"
#include "render/shading.h"

namespace unsnarl {
namespace {

constexpr Colour ink = {0.13, 0.15, 0.19}, pale_ink = {0.42, 0.45, 0.50}, rule = {0.84, 0.85, 0.87};

struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

/// A square of the image plane, in pixels of the main view.
struct Window {
  double x = 0, y = 0, side = 0;  ///< centre and side
};

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

/// The part of the view worth magnifying: all red faces where they lie close together, else around the most of them.
/// None where nothing is red, or where the main view shows it well enough.
std::optional<Window> worth_magnifying(const Drawable& drawable, const Camera& camera, int width, int height) {
  std::vector<std::array<double, 2>> centres;
  std::vector<double> edges;
  for (std::size_t t = 0; t < drawable.triangles.size(); ++t) {
    if (drawable.red[t] == 0) continue;
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = camera.project(drawable.positions[drawable.triangles[t][k]], width, height);
    centres.push_back({(p[0][0] + p[1][0] + p[2][0]) / 3, (p[0][1] + p[1][1] + p[2][1]) / 3});
    edges.push_back(
        std::max({(p[1] - p[0]).head<2>().norm(), (p[2] - p[1]).head<2>().norm(), (p[0] - p[2]).head<2>().norm()}));
  }
  if (centres.empty()) return {};
  std::nth_element(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2), edges.end());
  const double edge = edges[edges.size() / 2];
  const double least = std::max(0.02 * height, 6 * edge);

  std::array<double, 2> low = centres[0], high = centres[0];
  for (const auto& c : centres)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], c[k]);
      high[k] = std::max(high[k], c[k]);
    }
  Window window{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2,
                std::max(high[0] - low[0], high[1] - low[1]) + 4 * edge};
  window.side = std::max(window.side, least);
  const double largest = 0.24 * height;  // a magnification of 1.5 at least
  if (window.side <= largest) return window;

  if (least > largest) return {};
  const double cell = 0.5 * largest;
  std::map<std::pair<int, int>, int> counts;
  const auto cell_of = [&](const std::array<double, 2>& c) {
    return std::pair(static_cast<int>(std::floor(c[0] / cell)), static_cast<int>(std::floor(c[1] / cell)));
  };
  for (const auto& c : centres) ++counts[cell_of(c)];
  const auto fullest = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
                         return a.second < b.second;
                       })->first;
  window = {0, 0, largest};
  double members = 0;
  for (const auto& c : centres) {
    if (cell_of(c) != fullest) continue;
    ++members;
    window.x += (c[0] - window.x) / members;
    window.y += (c[1] - window.y) / members;
  }
  return window;
}

Camera narrowed(const Camera& camera, const Window& window, int width, int height) {
  Camera narrow = camera;
  const double tangent = 2 * camera.half_height / height;
  narrow.centre_x = camera.centre_x + tangent * (window.x - 0.5 * width);
  narrow.centre_y = camera.centre_y + tangent * (0.5 * height - window.y);
  narrow.half_height = 0.5 * tangent * window.side;
  return narrow;
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

void draw_label(Image& image, const std::string& label, int x, int x_end, double size) {
  const auto end = label.find('\n');
  const std::string_view first = std::string_view(label).substr(0, end);
  draw_text(image, first, x, size, size, ink, x_end);
  if (end != std::string::npos)
    draw_text(image, std::string_view(label).substr(end + 1), x, 2.6 * size, 0.72 * size, pale_ink, x_end);
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

  const auto window = options.inset ? worth_magnifying(panels.front().drawable, camera, width, height) : std::nullopt;
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
    if (k > 0) fill(image, {k * width, 0, 1, options.height}, rule);
    draw_label(image, panels[k].label, k * width + static_cast<int>(letters), (k + 1) * width, letters);
  }
  return image;
}

}  // namespace

Image render_pair(const SurfaceView& before, std::span<const Index> red_before, const SurfaceView& after,
                  std::span<const Index> red_after, const PictureOptions& options) {
  check_size(options);
  std::vector<Panel> panels;
  panels.push_back({make_drawable(before, red_before), options.before_label});
  panels.push_back({make_drawable(after, red_after), options.after_label});
  return render_panels(std::move(panels), options);
}

Image render_surface(const SurfaceView& surface, std::span<const Index> red, const PictureOptions& options) {
  check_size(options);
  std::vector<Panel> panels;
  panels.push_back({make_drawable(surface, red), options.before_label});
  return render_panels(std::move(panels), options);
}

}  // namespace unsnarl
