#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "applications/knots/knot_path.h"
#include "applications/seifert/closed_tube.h"
#include "geometry/box.h"
#include "render/camera.h"
#include "render/drawable.h"
#include "render/gif.h"
#include "render/layout.h"
#include "render/png.h"
#include "render/shading.h"
#include "unsnarl/knot_isotopy.h"
#include "unsnarl/surface.h"

namespace unsnarl {
namespace {

/// Radius of the tube that is drawn (unit: bounding-box diagonal of all rings)
constexpr double tube_radius = 0.012;
/// Radius of the tube, at most, so that tubes rarely run into each other (unit: distance between strands)
constexpr double tube_of_distance = 0.45;
constexpr int tube_sides = 10;        ///< Sides of a tube that is drawn (unit: sides)
constexpr double gif_frame_s = 0.06;  ///< A frame is shown this long (unit: s)
constexpr double gif_end_s = 1;       ///< The first and the last frame are shown this long (unit: s)

/// The points of the knot on its way, as many at all times: those of the rings, straight between them.
Positions points_at(const KnotIsotopy& isotopy, double time) {
  std::size_t k = 1;
  while (k + 3 < isotopy.rings.size() && isotopy.rings[k + 1].time <= time) ++k;
  const KnotRing &from = isotopy.rings[k], &to = isotopy.rings[k + 1];
  const double t = std::clamp((time - from.time) / (to.time - from.time), 0.0, 1.0);
  return (1 - t) * points_of(from.points) + t * points_of(to.points);
}

/// The smallest distance of points that are farther from each other along the knot than `radius` * 6.
double strand_distance(const Positions& x, double radius) {
  const auto n = static_cast<Index>(x.cols());
  std::vector<double> arc{0};
  for (Index k = 0; k < n; ++k) arc.push_back(arc.back() + (x.col((k + 1) % n) - x.col(k)).norm());
  double least = arc.back();
  for (Index i = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j) {
      const double along = std::min(arc[j] - arc[i], arc.back() - (arc[j] - arc[i]));
      if (along > 6 * radius) least = std::min(least, (x.col(i) - x.col(j)).norm());
    }
  return least;
}

Surface tube_around(const Positions& x, double radius) {
  const double r = std::min(radius, tube_of_distance * strand_distance(x, radius));
  Surface tube;
  add_closed_tube(x, r, tube_sides, tube);
  return tube;
}

struct Film {
  double radius = 0;
  std::vector<double> corners;  ///< positions that the camera is to show
};

Film film_of(const KnotIsotopy& isotopy) {
  if (isotopy.rings.size() < 4) throw std::invalid_argument("an isotopy without rings cannot be shown");
  Film film;
  Box box;
  for (const KnotRing& ring : isotopy.rings) {
    const Positions x = points_of(ring.points);
    for (Index k = 0; k < x.cols(); ++k) box.extend(Vec3(x.col(k)));
    film.corners.insert(film.corners.end(), ring.points.begin(), ring.points.end());
  }
  film.radius = tube_radius * box.diagonal();
  for (const Vec3& p : {Vec3(box.lo.array() - film.radius), Vec3(box.hi.array() + film.radius)})
    film.corners.insert(film.corners.end(), p.begin(), p.end());
  return film;
}

Image frame_of(const KnotIsotopy& isotopy, double time, double radius, const Camera& camera, int width, int height) {
  ShadingOptions shading;
  shading.wireframe_from = 1e9;
  return shade(make_drawable(tube_around(points_at(isotopy, time), radius), {}), camera, width, height, shading);
}

}  // namespace

std::string knot_isotopy_gif(const KnotIsotopy& isotopy, int frames) {
  if (frames < 2 || frames > 1000) throw std::invalid_argument(fmt::format("frames is {}; give 2 to 1000", frames));
  constexpr int width = 480;   ///< Width of a picture (unit: pixels)
  constexpr int height = 400;  ///< Height of a picture (unit: pixels)
  const Film film = film_of(isotopy);
  const Camera camera = three_quarter_view(film.corners, double(width) / height, 0.04);
  std::vector<Image> images;
  std::vector<double> seconds;
  for (int f = 0; f < frames; ++f) {
    images.push_back(frame_of(isotopy, static_cast<double>(f) / (frames - 1), film.radius, camera, width, height));
    seconds.push_back(f == 0 || f + 1 == frames ? gif_end_s : gif_frame_s);
  }
  return encode_gif(images, seconds);
}

std::string knot_isotopy_png(const KnotIsotopy& isotopy, int count) {
  if (count < 2 || count > 12) throw std::invalid_argument(fmt::format("count is {}; give 2 to 12", count));
  constexpr int width = 400;   ///< Width of a picture (unit: pixels)
  constexpr int height = 400;  ///< Height of a picture (unit: pixels)
  constexpr int bar = 40;      ///< Height of the line of text (unit: pixels)
  const Film film = film_of(isotopy);
  Image image(width * count, height + bar);
  for (int k = 0; k < count; ++k) {
    const double time = static_cast<double>(k) / (count - 1);
    // Each as large as possible: what is tightly wound up is much smaller than the circle that it becomes.
    const Positions x = points_at(isotopy, time);
    Box box;
    for (Index v = 0; v < x.cols(); ++v) box.extend(Vec3(x.col(v)));
    const Surface tube = tube_around(x, tube_radius * box.diagonal());
    ShadingOptions shading;
    shading.wireframe_from = 1e9;
    const Camera camera = three_quarter_view(tube.positions, double(width) / height, 0.06);
    paste(image, shade(make_drawable(tube, {}), camera, width, height, shading), k * width, bar);
    draw_label(image, fmt::format("time {:.2g}", time), k * width + 14, (k + 1) * width, 14);
  }
  return encode_png(image);
}

}  // namespace unsnarl
