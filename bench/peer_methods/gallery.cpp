#include "gallery.h"

#include <algorithm>
#include <cstdint>

#include "render/camera.h"
#include "render/drawable.h"
#include "render/layout.h"
#include "render/shading.h"
#include "unsnarl/intersections.h"
#include "unsnarl/report.h"

namespace unsnarl::peers {
namespace {

std::vector<Index> faces_that_intersect(const Surface& surface) {
  std::vector<Index> faces;
  for (const IntersectingPair& pair : find_intersections(surface)) faces.insert(faces.end(), {pair.a, pair.b});
  return faces;
}

}  // namespace

Image gallery(const std::vector<Exhibit>& exhibits, int columns, int width) {
  const int count = static_cast<int>(exhibits.size());
  columns = std::clamp(columns, 1, std::max(1, count));
  const double letters = width / 34.0;
  const int bar = static_cast<int>(4 * letters), height = width + bar;
  // One camera for all that have about the size of the first; what has flown apart gets one of its own.
  std::vector<double> alike;
  std::vector<std::uint8_t> is_alike;
  for (const Exhibit& exhibit : exhibits) {
    const std::vector<double>& x = exhibit.surface.positions;
    is_alike.push_back(diagonal_of(exhibit.surface) < 2 * diagonal_of(exhibits.front().surface));
    if (is_alike.back()) alike.insert(alike.end(), x.begin(), x.end());
  }
  const Camera common = three_quarter_view(alike, 1, 0.04);
  Image image(columns * width, (count + columns - 1) / columns * height);
  for (int k = 0; k < count; ++k) {
    const Exhibit& exhibit = exhibits[k];
    const int x = k % columns * width, y = k / columns * height;
    const Camera camera = is_alike[k] ? common : three_quarter_view(exhibit.surface.positions, 1, 0.04);
    paste(image, shade(make_drawable(exhibit.surface, faces_that_intersect(exhibit.surface)), camera, width, width), x,
          y + bar);
    Image label(width, bar);
    draw_label(label, exhibit.label, static_cast<int>(letters), width, letters);
    paste(image, label, x, y);
    outline(image, {x, y, width, height}, 1, rule_grey);
  }
  return image;
}

}  // namespace unsnarl::peers
