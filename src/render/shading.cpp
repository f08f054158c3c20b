#include "render/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "geometry/portable_math.h"
#include "render/ambient_occlusion.h"
#include "render/rasteriser.h"

namespace unsnarl {
namespace {

using Linear = Eigen::Array3f;  // linear light, [0, 1]

/// Front and back of a file, again from the first where there are more. None is near red.
struct FileColours {
  Linear front, back;
};
const std::array<FileColours, 6> file_colours = {{
    {{0.50F, 0.58F, 0.70F}, {0.74F, 0.62F, 0.44F}},
    {{0.80F, 0.62F, 0.22F}, {0.62F, 0.54F, 0.38F}},
    {{0.30F, 0.60F, 0.38F}, {0.48F, 0.58F, 0.44F}},
    {{0.52F, 0.40F, 0.72F}, {0.55F, 0.49F, 0.62F}},
    {{0.22F, 0.58F, 0.66F}, {0.42F, 0.56F, 0.60F}},
    {{0.55F, 0.42F, 0.30F}, {0.55F, 0.48F, 0.42F}},
}};

const FileColours grey = {{0.42F, 0.44F, 0.48F}, {0.42F, 0.44F, 0.48F}};

const FileColours& colours_of(Index file) {
  return file == Drawable::grey ? grey : file_colours[file % file_colours.size()];
}

/// Red faces that are narrower on the screen are drawn this wide, so that a row of them on a fine mesh shows as a line
/// [E182] (unit: pixels)
constexpr double least_red_width = 2;

struct Material {
  Linear red = {0.85F, 0.035F, 0.03F};
  Linear line = {0.03F, 0.04F, 0.07F};
};

/// Everything about one view that the passes share.
struct View {
  const Drawable& drawable;
  const Camera& camera;
  int samples, width, height;  // the latter in pixels
  std::vector<ScreenPoint> points;
  VisibilityBuffer nearest, nearest_red;
  VisibilityBuffer marks;    // the edges of narrow red faces, as wide as they are drawn
  float mark_slack_rel = 0;  // how much nearer than a mark may be what it hangs over, relative to one over the depth
};

std::array<ScreenPoint, 3> corners_of(const View& view, Index triangle) {
  const Triangle& t = view.drawable.triangles[triangle];
  return {view.points[t[0]], view.points[t[1]], view.points[t[2]]};
}

/// Weights of the corners on the surface (not on the screen) at a sample.
Eigen::Array3f surface_weights(const std::array<ScreenPoint, 3>& c, float x, float y) {
  const auto on_screen = screen_weights(c, x, y);
  const Eigen::Array3f w(on_screen[0] * c[0].inverse_depth, on_screen[1] * c[1].inverse_depth,
                         on_screen[2] * c[2].inverse_depth);
  const float sum = w.sum();
  return sum > 0 ? Eigen::Array3f(w / sum) : Eigen::Array3f(1, 0, 0);
}

/// Distance in samples from a screen point to the nearest edge that is drawn.
float distance_to_edges(const std::array<ScreenPoint, 3>& c, std::uint8_t drawn, float x, float y) {
  float nearest = 1e9F;
  for (int k = 0; k < 3; ++k) {
    if ((drawn >> k & 1) == 0) continue;
    const ScreenPoint &a = c[k], &b = c[(k + 1) % 3];
    const float dx = b.x - a.x, dy = b.y - a.y, length = std::sqrt(dx * dx + dy * dy);
    if (length > 0) nearest = std::min(nearest, std::abs(dx * (y - a.y) - dy * (x - a.x)) / length);
  }
  return nearest;
}

/// Light on a surface point, in the camera's frame.
Linear lit(const Linear& colour, const Eigen::Vector3f& normal, const Eigen::Vector3f& to_eye, float sky) {
  static const Eigen::Vector3f key = Eigen::Vector3f(-0.55F, 0.75F, 0.6F).normalized();
  static const Eigen::Vector3f fill = Eigen::Vector3f(0.8F, 0.1F, 0.5F).normalized();
  const float from_key = std::max(0.0F, (normal.dot(key) + 0.15F) / 1.15F);
  const float from_fill = std::max(0.0F, normal.dot(fill));
  const float from_above = 0.5F + 0.5F * normal[1];
  const float gloss = portable::pow(std::max(0.0F, normal.dot((key + to_eye).normalized())), 40.0F);
  const Linear light = Linear(1.0F, 0.97F, 0.92F) * (0.85F * from_key) +
                       Linear(0.75F, 0.85F, 1.0F) * (0.22F * from_fill) +
                       Linear(0.9F, 0.95F, 1.0F) * (0.20F + 0.18F * from_above);
  return colour * light * (0.25F + 0.75F * sky) + 0.10F * gloss * sky;
}

std::uint8_t to_srgb(float linear) {
  const float x = std::clamp(linear, 0.0F, 1.0F);
  const float s = x <= 0.0031308F ? 12.92F * x : 1.055F * portable::pow(x, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

/// Bends of one over the depth, which is affine on a plane: outlines, and edges of sheets in front of others.
float outline(const View& view, int x, int y) {
  const VisibilityBuffer& buffer = view.nearest;
  const auto at = [&](int i, int j) {
    return i < 0 || j < 0 || i >= buffer.width || j >= buffer.height ? 0.0F : buffer.inverse_depth[buffer.at(i, j)];
  };
  const float here = at(x, y);
  const float bend =
      std::max(std::abs(at(x - 1, y) + at(x + 1, y) - 2 * here), std::abs(at(x, y - 1) + at(x, y + 1) - 2 * here));
  return std::clamp((bend / here - 0.004F) / 0.012F, 0.0F, 1.0F);
}

std::vector<float> sky_of_pixels(const View& view) {
  const std::size_t pixels = std::size_t(view.width) * view.height;
  std::vector<Eigen::Vector3f> points(pixels, Eigen::Vector3f::Zero()), normals(pixels, Eigen::Vector3f::Zero());
  const Camera& camera = view.camera;
  const float tangent = static_cast<float>(2 * camera.half_height / view.height);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const std::size_t sample = view.nearest.at(x * view.samples, y * view.samples);
      const Index triangle = view.nearest.triangle[sample];
      if (triangle < 0) continue;
      const float depth = 1 / view.nearest.inverse_depth[sample];
      const std::size_t i = std::size_t(y) * view.width + x;
      points[i] = {depth * (static_cast<float>(camera.centre_x) + tangent * (x + 0.5F - 0.5F * view.width)),
                   depth * (static_cast<float>(camera.centre_y) + tangent * (0.5F * view.height - y - 0.5F)), -depth};
      const Triangle& t = view.drawable.triangles[triangle];
      const auto& p = view.drawable.positions;
      const Vec3 n = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
      Eigen::Vector3f normal(static_cast<float>(n.dot(camera.right)), static_cast<float>(n.dot(camera.up)),
                             static_cast<float>(n.dot(camera.toward)));
      if (normal.dot(points[i]) > 0) normal = -normal;
      normals[i] = normal;
    }
  AmbientOcclusionOptions options;
  options.radius_pixels = 0.07 * view.height;
  return ambient_occlusion(points, normals, view.width, view.height, tangent, options);
}

float screen_distance(const ScreenPoint& a, const ScreenPoint& b) {
  const float dx = b.x - a.x, dy = b.y - a.y;
  return std::sqrt(dx * dx + dy * dy);
}

/// Adds the edges of a triangle on the screen, as wide as `width` samples and longer by half of that at both ends.
void add_edges(const std::array<ScreenPoint, 3>& c, float width, std::vector<ScreenPoint>& points,
               std::vector<Triangle>& triangles) {
  for (int k = 0; k < 3; ++k) {
    const ScreenPoint &a = c[k], &b = c[(k + 1) % 3];
    const float length = screen_distance(a, b), half = 0.5F * width;
    const float dx = length > 0 ? half * (b.x - a.x) / length : half, dy = length > 0 ? half * (b.y - a.y) / length : 0;
    const auto first = static_cast<Index>(points.size());
    points.push_back({a.x - dx - dy, a.y - dy + dx, a.inverse_depth});
    points.push_back({a.x - dx + dy, a.y - dy - dx, a.inverse_depth});
    points.push_back({b.x + dx + dy, b.y + dy - dx, b.inverse_depth});
    points.push_back({b.x + dx - dy, b.y + dy + dx, b.inverse_depth});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
}

void mark_narrow_red_faces(View& view, std::span<const Index> red) {
  const auto width = static_cast<float>(least_red_width * view.samples);
  std::vector<ScreenPoint> points;
  std::vector<Triangle> triangles;
  for (const Index t : red) {
    const std::array<ScreenPoint, 3> c = corners_of(view, t);
    if (std::any_of(c.begin(), c.end(), [](const ScreenPoint& p) { return !(p.inverse_depth > 0); })) continue;
    float longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, screen_distance(c[k], c[(k + 1) % 3]));
    const float twice_area = std::abs((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x));
    if (twice_area < width * longest || longest == 0) add_edges(c, width, points, triangles);
  }
  std::vector<Index> all(triangles.size());
  std::iota(all.begin(), all.end(), 0);
  rasterise(points, triangles, all, view.marks);
  view.mark_slack_rel = static_cast<float>(2 * least_red_width * 2 * view.camera.half_height / view.height);
}

View make_view(const Drawable& drawable, const Camera& camera, int width, int height, int samples) {
  View view{drawable,
            camera,
            samples,
            width,
            height,
            {},
            {width * samples, height * samples},
            {width * samples, height * samples},
            {width * samples, height * samples}};
  view.points.reserve(drawable.positions.size());
  for (const Vec3& p : drawable.positions) {
    const Vec3 q = camera.project(p, width * samples, height * samples);
    view.points.push_back(
        {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2] > 0 ? 1 / q[2] : 0)});
  }
  // One over the depth relative to a typical one: 32-bit floats then hold for scenes of any size and place.
  float largest = 0;
  for (const ScreenPoint& p : view.points)
    largest = std::isfinite(p.inverse_depth) ? std::max(largest, p.inverse_depth) : largest;
  if (largest > 0)
    for (ScreenPoint& p : view.points) p.inverse_depth /= largest;
  std::vector<Index> red, all(drawable.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  for (Index t : all)
    if (drawable.red[t] != 0) red.push_back(t);
  // Red first: where two faces coincide, the red one stays.
  rasterise(view.points, drawable.triangles, red, view.nearest_red);
  view.nearest = view.nearest_red;
  rasterise(view.points, drawable.triangles, all, view.nearest);
  mark_narrow_red_faces(view, red);
  return view;
}

}  // namespace

Image shade(const Drawable& drawable, const Camera& camera, int width, int height, const ShadingOptions& options) {
  const int samples = std::clamp(options.samples, 1, 4);
  const View view = make_view(drawable, camera, width, height, samples);
  const std::vector<float> sky = sky_of_pixels(view);
  const Material material;

  // Median edge on the screen, at the mean depth of the scene.
  double depth = 0;
  std::size_t counted = 0;
  for (const Vec3& p : drawable.positions)
    if (p.allFinite()) depth += (camera.toward.dot(camera.eye - p) - depth) / static_cast<double>(++counted);
  const double edge_pixels = depth > 0 ? drawable.median_edge / depth * height / (2 * camera.half_height) : 0;
  const auto line_strength =
      static_cast<float>(0.42 * std::clamp((edge_pixels - options.wireframe_from) / options.wireframe_from, 0.0, 1.0));

  Image image(width, height);
  const float tangent = static_cast<float>(2 * camera.half_height / (height * samples));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Linear sum = Linear::Zero();
      for (int j = y * samples; j < (y + 1) * samples; ++j)
        for (int i = x * samples; i < (x + 1) * samples; ++i) {
          const std::size_t at = view.nearest.at(i, j);
          const Index triangle = view.nearest.triangle[at];
          if (triangle < 0) {
            sum += 1;
            continue;
          }
          const auto corners = corners_of(view, triangle);
          const Eigen::Array3f weights = surface_weights(corners, i + 0.5F, j + 0.5F);
          const auto& n = drawable.normals[triangle];
          const Eigen::Vector3f smooth = weights[0] * n[0] + weights[1] * n[1] + weights[2] * n[2];
          Eigen::Vector3f normal(smooth.dot(camera.right.cast<float>()), smooth.dot(camera.up.cast<float>()),
                                 smooth.dot(camera.toward.cast<float>()));
          normal.normalize();
          const Eigen::Vector3f to_eye =
              -Eigen::Vector3f(static_cast<float>(camera.centre_x) + tangent * (i + 0.5F - 0.5F * width * samples),
                               static_cast<float>(camera.centre_y) + tangent * (0.5F * height * samples - j - 0.5F), -1)
                   .normalized();
          // Which side is seen is decided by the face itself: smooth normals may lean away at outlines.
          const auto area = double(corners[1].x - corners[0].x) * (corners[2].y - corners[0].y) -
                            double(corners[1].y - corners[0].y) * (corners[2].x - corners[0].x);
          const bool front = area < 0;  // y runs down
          if (!front) normal = -normal;
          const bool is_marked = view.marks.triangle[at] >= 0;
          const bool is_red =
              drawable.red[triangle] != 0 ||
              (is_marked && view.marks.inverse_depth[at] >= (1 - view.mark_slack_rel) * view.nearest.inverse_depth[at]);
          const float visible_sky = sky[std::size_t(y) * width + x];
          const FileColours& own = colours_of(drawable.file[triangle]);
          Linear colour = lit(is_red ? material.red : front ? own.front : own.back, normal, to_eye, visible_sky);
          if (line_strength > 0) {
            const float away = distance_to_edges(corners, drawable.drawn_edges[triangle], i + 0.5F, j + 0.5F) / samples;
            const float cover = line_strength * std::clamp(0.9F - away, 0.0F, 1.0F);
            colour += cover * (material.line - colour);
          }
          colour *= 1 - 0.55F * outline(view, i, j);
          if (!is_red && (is_marked || view.nearest_red.triangle[at] >= 0))
            colour += static_cast<float>(options.xray) * (Linear(0.92F, 0.10F, 0.08F) - colour);
          sum += colour.min(1);
        }
      sum /= static_cast<float>(samples * samples);
      std::uint8_t* pixel = image.at(x, y);
      for (int c = 0; c < 3; ++c) pixel[c] = to_srgb(sum[c]);
    }
  return image;
}

}  // namespace unsnarl
