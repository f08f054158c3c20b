#include "render/animation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/box.h"
#include "render/camera.h"
#include "render/closeup.h"
#include "render/drawable.h"
#include "render/layout.h"
#include "render/shading.h"
#include "unsnarl/pictures.h"

namespace unsnarl {
namespace {

constexpr Colour red = {0.80, 0.16, 0.14}, pale_red = {0.93, 0.83, 0.82};
constexpr Colour blue = {0.20, 0.38, 0.66}, pale_blue = {0.78, 0.83, 0.90};

/// Largest side of a magnified part, which is magnified three times at least (unit: heights of the view)
constexpr double largest_animated_window = 0.28;
/// Red faces that do not all fit are magnified where six of their edges are shorter than this (unit: heights of the
/// view)
constexpr double small_window = 0.1;
/// Frames that are shown, at most; of more, every second one is left out (unit: frames)
constexpr std::size_t most_shown = 50;
/// A frame in which no vertex moved farther since the last one shown is left out (unit: bounding-box diagonal)
constexpr double least_motion_rel = 5e-4;

void check(const SurfaceView& surface, std::span<const RecordedFrame> frames, const AnimationOptions& options) {
  for (int size : {options.width, options.height})
    if (size < 128 || size > 4096)
      throw std::invalid_argument("an animation of " + std::to_string(options.width) + " x " +
                                  std::to_string(options.height) +
                                  " pixels cannot be made; both must be from 128 to 4096");
  for (const RecordedFrame& frame : frames) {
    bool fits = frame.displacements.size() == 3 * frame.vertices.size();
    for (Index v : frame.vertices) fits &= v >= 0 && static_cast<std::size_t>(v) < surface.vertex_count();
    if (!fits) throw std::invalid_argument("these frames are not a recording of this surface");
  }
}

/// Moves on to the next frame.
void advance(const SurfaceView& surface, const RecordedFrame& frame, std::vector<double>& positions) {
  for (std::size_t i = 0; i < frame.vertices.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = 3 * static_cast<std::size_t>(frame.vertices[i]) + k;
      positions[at] = surface.positions[at] + frame.displacements[3 * i + k];
    }
}

/// Everything that any frame shows.
std::vector<double> all_positions(const SurfaceView& surface, std::span<const RecordedFrame> frames) {
  std::vector<double> all(surface.positions.begin(), surface.positions.end());
  for (const RecordedFrame& frame : frames)
    for (std::size_t i = 0; i < frame.displacements.size(); ++i)
      all.push_back(surface.positions[3 * static_cast<std::size_t>(frame.vertices[i / 3]) + i % 3] +
                    frame.displacements[i]);
  return all;
}

/// The contents of the strip below the surface.
struct Course {
  std::vector<double> pairs, displacement;  ///< of each frame, divided by their largest values
};

/// Frames to show: the ends, and those in which something has happened since the last one shown.
std::vector<std::size_t> frames_worth_showing(const SurfaceView& surface, std::span<const RecordedFrame> frames,
                                              Course& course) {
  Box box;
  for (std::size_t v = 0; v < surface.vertex_count(); ++v)
    box.extend(Vec3(surface.positions[3 * v], surface.positions[3 * v + 1], surface.positions[3 * v + 2]));
  const double least = frames.empty() || surface.vertex_count() == 0 ? 0 : least_motion_rel * box.diagonal();
  std::vector<Vec3> now(surface.vertex_count(), Vec3::Zero()), shown = now;
  std::vector<Index> touched;
  double squares = 0;
  std::vector<std::size_t> result;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const RecordedFrame& frame = frames[f];
    for (std::size_t i = 0; i < frame.vertices.size(); ++i) {
      Vec3& displacement = now[frame.vertices[i]];
      squares -= displacement.squaredNorm();
      displacement = {frame.displacements[3 * i], frame.displacements[3 * i + 1], frame.displacements[3 * i + 2]};
      squares += displacement.squaredNorm();
      touched.push_back(frame.vertices[i]);
    }
    course.pairs.push_back(static_cast<double>(frame.pairs));
    course.displacement.push_back(std::sqrt(std::max(0.0, squares)));
    double moved = 0;
    for (Index v : touched) moved = std::max(moved, (now[v] - shown[v]).norm());
    const bool is_end = f == 0 || f + 1 == frames.size();
    if (!is_end && moved <= least && frame.pairs == frames[result.back()].pairs) continue;
    result.push_back(f);
    for (Index v : touched) shown[v] = now[v];
    touched.clear();
  }
  while (result.size() > most_shown) {
    std::vector<std::size_t> half;
    for (std::size_t k = 0; k < result.size(); ++k)
      if (k % 2 == 0 || k + 1 == result.size()) half.push_back(result[k]);
    result = std::move(half);
  }
  for (std::vector<double>* values : {&course.pairs, &course.displacement}) {
    const double largest = values->empty() ? 0 : *std::max_element(values->begin(), values->end());
    for (double& value : *values) value = largest > 0 ? value / largest : 0;
  }
  return result;
}

/// Untangling and recovery take the same time, however many frames they have.
std::vector<double> seconds_of(std::span<const RecordedFrame> frames, std::span<const std::size_t> shown) {
  const auto recovering = [&](std::size_t f) { return frames[f].phase == "recover"; };
  const auto recovery = static_cast<double>(std::count_if(shown.begin(), shown.end(), recovering));
  std::vector<double> seconds;
  for (std::size_t f : shown) {
    const double count = recovering(f) ? recovery : static_cast<double>(shown.size()) - recovery;
    seconds.push_back(std::clamp(3.5 / std::max(1.0, count), 0.04, 0.4));
  }
  seconds.front() = 1;
  seconds.back() = 2.5;
  return seconds;
}

std::string caption(const RecordedFrame& frame) {
  if (frame.phase == "input" || frame.phase == "result") return picture_label(frame.phase, frame.pairs, frame.allowed);
  const std::string strategy = frame.strategy.empty() ? "" : " of " + frame.strategy;
  return picture_label(frame.phase == "recover" ? "back towards the input" : "untangling", frame.pairs, frame.allowed) +
         ", iteration " + std::to_string(frame.iteration) + strategy;
}

/// Pairs as columns, displacement as a line, over all frames; what is still to come is pale.
void draw_course(Image& image, const Course& course, std::size_t now, Rectangle r) {
  const std::size_t count = course.pairs.size();
  const int base = r.y + r.height - 3;
  const auto left = [&](std::size_t f) {
    return r.x + static_cast<int>(std::lround(double(r.width) * static_cast<double>(f) / static_cast<double>(count)));
  };
  const auto height = [&](double share) { return static_cast<int>(std::ceil(share * (r.height - 5))); };
  for (std::size_t f = 0; f < count; ++f) {
    const int x = left(f), width = left(f + 1) - x, tall = height(course.pairs[f]);
    fill(image, {x, base - tall, width, tall}, f <= now ? red : pale_red);
    fill(image, {x, base + 1, width, 2}, f <= now ? pale_ink : rule_grey);
  }
  for (std::size_t f = 0; f < count; ++f) {
    const int x = left(f), width = left(f + 1) - x;
    const int level = base - height(course.displacement[f]);
    const int before = f > 0 ? base - height(course.displacement[f - 1]) : level;
    const Colour& colour = f <= now ? blue : pale_blue;
    fill(image, {x, std::min(before, level), 2, std::abs(level - before) + 2}, colour);
    fill(image, {x, level, width, 2}, colour);
  }
}

/// The legend of the course's colours, right-aligned at x_end.
void draw_legend(Image& image, double y, double size, int x_end) {
  double x = x_end;
  for (const auto& [text, colour] : {std::pair{"distance from the input", blue}, {"intersecting pairs", red}}) {
    x -= text_width(text, size);
    draw_text(image, text, x, y, size, colour, x_end);
    x -= 2 * size;
  }
}

/// The part to show beside the whole: all conflicts where they lie close together, else most of them if they are hard
/// to see.
std::optional<Window> close_up(const Drawable& drawable, const Camera& camera, int width, int height) {
  const auto window = worth_magnifying(drawable, camera, width, height, largest_animated_window);
  const bool is_all = window && window->side < 0.999 * largest_animated_window * height;
  return is_all || worth_magnifying(drawable, camera, width, height, small_window) ? window : std::nullopt;
}

}  // namespace

void render_animation(const SurfaceView& surface, std::span<const RecordedFrame> frames,
                      const AnimationOptions& options, const std::function<void(Image, double seconds)>& take) {
  check(surface, frames, options);
  if (frames.empty()) return;
  const double letters = std::clamp(options.height / 36.0, 7.0, 40.0);
  const int bar = static_cast<int>(4 * letters), strip = static_cast<int>(3.2 * letters);
  const int pad = static_cast<int>(letters), height = options.height - bar - strip;

  const std::vector<double> everything = all_positions(surface, frames);
  const std::optional<Vec3> up = up_of(options.files);
  const auto view_of_width = [&](int width) {
    return three_quarter_view(everything, double(width) / height, 0.03, up);
  };
  int width = options.width;
  Camera camera = view_of_width(width);
  const Drawable start = make_drawable(surface, frames.front().intersecting, options.files);
  const int beside = std::min(height, options.width / 2);  // a square where there is room
  std::optional<Window> window;
  if (close_up(start, camera, width, height)) {
    const Camera camera_beside = view_of_width(width - beside);
    window = close_up(start, camera_beside, width - beside, height);
    if (window) {
      width -= beside;
      camera = camera_beside;
    }
  }

  Course course;
  const std::vector<std::size_t> shown = frames_worth_showing(surface, frames, course);
  const std::vector<double> seconds = seconds_of(frames, shown);
  std::vector<double> positions(surface.positions.begin(), surface.positions.end());
  std::size_t next = 0;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const std::size_t f = shown[k];
    while (next <= f) advance(surface, frames[next++], positions);
    const Drawable drawable =
        make_drawable({positions, surface.corners, surface.offsets}, frames[f].intersecting, options.files);
    Image image(options.width, options.height);
    Image whole = shade(drawable, camera, width, height);
    if (window) {
      const auto half = static_cast<int>(window->side / 2);
      outline(whole, {static_cast<int>(window->x) - half, static_cast<int>(window->y) - half, 2 * half, 2 * half}, 1,
              ink);
      const int side = beside - pad;
      Image close = shade(drawable, narrowed(camera, *window, width, height), side, side);
      outline(close, {0, 0, side, side}, 1, ink);
      paste(image, close, width, bar + (height - side) / 2);
    }
    paste(image, whole, 0, bar);
    draw_label(image, caption(frames[f]), pad, options.width, letters);
    draw_legend(image, 2.6 * letters, 0.72 * letters, options.width - pad);
    draw_course(image, course, f, {pad, options.height - strip, options.width - 2 * pad, strip - pad / 2});
    take(std::move(image), seconds[k]);
  }
}

}  // namespace unsnarl
