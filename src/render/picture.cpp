#include "render/picture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/camera.h"
#include "render/closeup.h"
#include "render/drawable.h"
#include "render/font.h"
#include "render/layout.h"
#include "render/shading.h"

namespace unsnarl {
namespace {

/// Largest side of a magnified part, which is magnified 1.5 times at least (unit: heights of the picture)
constexpr double largest_window = 0.24;
/// Magnified parts, at most: one corner is left to the surface (unit: parts)
constexpr std::size_t most_windows = 3;
/// An inset hides at most this much of the surface, unless it is the first and magnifies much (unit: share of the
/// inset)
constexpr double most_hidden = 0.03;
/// The first inset may hide any part where it magnifies this many times: what is red is then too small to be seen well
/// (no unit)
constexpr double much_magnified = 2;

/// The part of its own colour that a surface behind something translucent keeps (no unit)
constexpr double shining_through = 0.65;

struct Panel {
  Drawable drawable;
  std::optional<Drawable> opaque;  ///< the same without what is translucent; none where nothing is
  std::string label;
};

Panel make_panel(const SurfaceView& surface, std::span<const Index> red, std::span<const SceneFile> files,
                 std::size_t translucent_from, const std::string& label) {
  Panel panel{make_drawable(surface, red, files), std::nullopt, label};
  bool is_translucent = false;
  for (Index& file : panel.drawable.file)
    if (static_cast<std::size_t>(file) >= translucent_from) {
      file = Drawable::grey;
      is_translucent = true;
    }
  if (!is_translucent) return panel;
  Drawable& opaque = panel.opaque.emplace(panel.drawable);
  std::vector<Triangle>& triangles = opaque.triangles;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (panel.drawable.file[t] == Drawable::grey) continue;
    triangles[kept] = triangles[t];
    opaque.normals[kept] = panel.drawable.normals[t];
    opaque.drawn_edges[kept] = panel.drawable.drawn_edges[t];
    opaque.red[kept] = panel.drawable.red[t];
    opaque.file[kept++] = panel.drawable.file[t];
  }
  triangles.resize(kept);
  return panel;
}

/// Everything as if it were opaque, mixed with the same view of what is opaque alone.
Image shade(const Panel& panel, const Camera& camera, int width, int height) {
  Image image = shade(panel.drawable, camera, width, height);
  if (!panel.opaque) return image;
  const Image behind = shade(*panel.opaque, camera, width, height);
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    image.pixels[k] = static_cast<std::uint8_t>(
        std::lround(shining_through * behind.pixels[k] + (1 - shining_through) * image.pixels[k]));
  return image;
}

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

struct Inset {
  Window window;
  Rectangle place;
};

/// The corner of the panels, not taken, in which an inset hides least, over all panels; bottom right where none is
/// better. `least_hidden`: pixels there that are not white, over all panels, and 1e9 for each window below.
Rectangle inset_place(const std::vector<Image>& views, std::span<const Window> windows, std::span<const Inset> taken,
                      int width, int height, double& least_hidden) {
  const int side = static_cast<int>(0.36 * std::min(width, height)), gap = std::max(2, height / 100);
  Rectangle best;
  double least = -1;
  for (const auto& [x, y] : {std::pair(width - side - gap, height - side - gap), std::pair(gap, height - side - gap),
                             std::pair(width - side - gap, gap), std::pair(gap, gap)}) {
    const Rectangle r{x, y, side, side};
    if (std::any_of(taken.begin(), taken.end(), [&](const Inset& t) { return t.place.x == r.x && t.place.y == r.y; }))
      continue;
    double hidden = 0;
    for (const Image& view : views) hidden += static_cast<double>(covered(view, r));
    for (const Window& window : windows)
      if (std::abs(window.x - (x + 0.5 * side)) < 0.5 * (side + window.side) &&
          std::abs(window.y - (y + 0.5 * side)) < 0.5 * (side + window.side))
        hidden += 1e9;
    if (least < 0 || hidden < least) {
      least = hidden;
      best = r;
    }
  }
  least_hidden = least;
  return best;
}

/// The places of the insets that hide little, and of the first one where it is needed.
std::vector<Inset> insets_of(const Drawable& drawable, const Camera& camera, const std::vector<Image>& views, int width,
                             int height) {
  const std::vector<Window> windows =
      all_worth_magnifying(drawable, camera, width, height, largest_window, most_windows);
  std::vector<Inset> insets;
  for (std::size_t k = 0; k < windows.size(); ++k) {
    double hidden = 0;
    const Rectangle place = inset_place(views, windows, insets, width, height, hidden);
    const double pixels = static_cast<double>(views.size()) * place.width * place.height;
    const bool is_needed = k == 0 && place.width >= much_magnified * windows[k].side;
    if (is_needed || hidden <= most_hidden * pixels) insets.push_back({windows[k], place});
  }
  return insets;
}

void draw_inset(Image& view, const Panel& panel, const Camera& camera, const Inset& inset, int width, int height,
                int line) {
  const auto& [window, place] = inset;
  const auto half = static_cast<int>(window.side / 2);
  outline(view, {static_cast<int>(window.x) - half, static_cast<int>(window.y) - half, 2 * half, 2 * half}, line, ink);
  paste(view, shade(panel, narrowed(camera, window, width, height), place.width, place.height), place.x, place.y);
  outline(view, place, line, ink);
}

/// The same number in the upper left corner of a window and of its inset, on a white ground.
void number_insets(Image& view, std::span<const Inset> insets, double size, int line) {
  const auto ground = static_cast<int>(1.8 * size);
  for (std::size_t k = 0; k < insets.size(); ++k) {
    const auto& [window, place] = insets[k];
    const auto half = static_cast<int>(window.side / 2);
    for (const auto& [x, y] : {std::pair(place.x, place.y),
                               std::pair(static_cast<int>(window.x) - half, static_cast<int>(window.y) - half)}) {
      fill(view, {x + line, y + line, ground, ground}, {1, 1, 1});
      const std::string number = std::to_string(k + 1);
      draw_text(view, number, x + line + 0.5 * (ground - text_width(number, size)), y + line + 0.4 * size, size, ink,
                x + line + ground);
    }
  }
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
  const Camera camera = three_quarter_view(positions, double(width) / height, 0.04, up_of(options.files));

  Image image(options.width, options.height);
  std::vector<Image> views;
  for (const Panel& panel : panels) views.push_back(shade(panel, camera, width, height));

  if (options.inset) {
    const std::vector<Inset> insets = insets_of(panels.front().drawable, camera, views, width, height);
    const int line = std::max(1, options.height / 600);
    for (std::size_t k = 0; k < views.size(); ++k)
      for (const Inset& inset : insets) draw_inset(views[k], panels[k], camera, inset, width, height, line);
    if (insets.size() > 1)
      for (Image& view : views) number_insets(view, insets, 0.6 * letters, line);
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
  panels.push_back(make_panel(before, red_before, options.files_before.empty() ? options.files : options.files_before,
                              options.translucent_from, options.before_label));
  panels.push_back(make_panel(after, red_after, options.files, options.translucent_from, options.after_label));
  return render_panels(std::move(panels), options);
}

Image render_surface(const SurfaceView& surface, std::span<const Index> red, const PictureOptions& options) {
  check_size(options);
  std::vector<Panel> panels;
  panels.push_back(make_panel(surface, red, options.files, options.translucent_from, options.before_label));
  return render_panels(std::move(panels), options);
}

}  // namespace unsnarl
