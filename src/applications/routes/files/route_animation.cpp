#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "applications/routes/segments.h"
#include "render/camera.h"

namespace unsnarl {
namespace {

constexpr double width = 800;             ///< Width of the picture (unit: pixels)
constexpr double height = 600;            ///< Height of the picture (unit: pixels)
constexpr double seconds = 8;             ///< Time of the animation (unit: s)
constexpr std::size_t most_faces = 5000;  ///< Faces of obstacles that are drawn, at most (unit: faces)

/// Colours that differ from each other, by the golden ratio.
std::string colour(std::size_t k) {
  return fmt::format("hsl({:.0f},60%,45%)", 360 * std::fmod(static_cast<double>(k) * std::numbers::phi, 1));
}

/// The place at a part of the length.
Vec3 at(const Route& route, const std::vector<double>& arc, double part) {
  const double s = part * arc.back();
  const auto after = std::upper_bound(arc.begin() + 1, arc.end() - 1, s) - arc.begin();
  const Vec3 a = vec(route.points[after - 1]), b = vec(route.points[after]);
  const double length = arc[after] - arc[after - 1];
  return a + (length > 0 ? std::clamp((s - arc[after - 1]) / length, 0.0, 1.0) : 0.0) * (b - a);
}

/// The place of an obstacle at a time.
Vec3 offset_at(const RouteObstacle& obstacle, double time) {
  const std::vector<RouteMove>& motion = obstacle.motion;
  if (motion.empty()) return Vec3::Zero();
  const auto after = std::find_if(motion.begin(), motion.end(), [&](const RouteMove& m) { return m.time > time; });
  if (after == motion.begin()) return vec(motion.front().offset);
  if (after == motion.end()) return vec(motion.back().offset);
  const RouteMove& before = *std::prev(after);
  const double share = (time - before.time) / (after->time - before.time);
  return vec(before.offset) + share * (vec(after->offset) - vec(before.offset));
}

void add_obstacles(const RoutePlan& plan, const Camera& camera, int frames, std::string& text) {
  std::size_t faces = 0;
  for (const RouteObstacle& obstacle : plan.obstacles) faces += obstacle.surface.view().face_count();
  if (faces == 0 || faces > most_faces) return;
  text += "<g fill=\"#556\" fill-opacity=\"0.08\">\n";
  for (const RouteObstacle& obstacle : plan.obstacles) {
    const SurfaceView surface = obstacle.surface;
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
      const auto points = [&](double time) {
        std::string corners;
        for (const std::int32_t v : surface.face(f)) {
          const Vec3 at = Eigen::Map<const Vec3>(surface.positions.data() + 3 * v) + offset_at(obstacle, time);
          const Vec3 p = camera.project(at, width, height);
          fmt::format_to(std::back_inserter(corners), "{:.1f},{:.1f} ", p.x(), p.y());
        }
        return corners;
      };
      text += fmt::format("<polygon points=\"{}\"", points(0));
      if (obstacle.motion.empty()) {
        text += "/>\n";
        continue;
      }
      text +=
          fmt::format("><animate attributeName=\"points\" dur=\"{}s\" repeatCount=\"indefinite\" values=\"", seconds);
      for (int frame = 0; frame < frames; ++frame)
        text += fmt::format("{}{}", frame == 0 ? "" : ";", points(plan.duration * frame / (frames - 1)));
      text += "\"/></polygon>\n";
    }
  }
  text += "</g>\n";
}

}  // namespace

std::string routes_animation_svg(const RoutePlan& plan, std::span<const Route> routes, int frames) {
  if (frames < 2 || frames > 1000) throw std::invalid_argument(fmt::format("frames is {}; give 2 to 1000", frames));
  const Surface seen = with_obstacles(plan, route_tubes(plan, routes, 4));
  const Camera camera = three_quarter_view(seen.positions, width / height, 0.05);
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" viewBox=\"0 0 {0} {1}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height);
  add_obstacles(plan, camera, frames, text);
  // A ball's radius in pixels, at a place.
  const auto radius = [&](const Vec3& p, double r) {
    return (camera.project(p + r * camera.up, width, height) - camera.project(p, width, height)).head<2>().norm();
  };
  text += "<g fill=\"none\" stroke-linejoin=\"round\" stroke-width=\"1.5\" stroke-opacity=\"0.6\">\n";
  for (std::size_t i = 0; i < routes.size(); ++i) {
    text += fmt::format("<polyline stroke=\"{}\" points=\"", colour(i));
    for (const RoutePoint& p : routes[i].points) {
      const Vec3 q = camera.project(vec(p), width, height);
      fmt::format_to(std::back_inserter(text), "{:.1f},{:.1f} ", q.x(), q.y());
    }
    text += "\"/>\n";
  }
  text += "</g>\n<g fill-opacity=\"0.85\">\n";
  for (std::size_t i = 0; i < routes.size(); ++i) {
    std::vector<double> arc{0};  // or time, which runs evenly from point to point
    for (std::size_t k = 0; k + 1 < routes[i].points.size(); ++k)
      arc.push_back(arc.back() + (plan.timed ? 1 : (vec(routes[i].points[k + 1]) - vec(routes[i].points[k])).norm()));
    std::string x, y, r;
    for (int f = 0; f < frames; ++f) {
      const Vec3 p = at(routes[i], arc, static_cast<double>(f) / (frames - 1));
      const Vec3 q = camera.project(p, width, height);
      const char* const comma = f == 0 ? "" : ";";
      fmt::format_to(std::back_inserter(x), "{}{:.1f}", comma, q.x());
      fmt::format_to(std::back_inserter(y), "{}{:.1f}", comma, q.y());
      fmt::format_to(std::back_inserter(r), "{}{:.1f}", comma, radius(p, plan.agents[i].radius));
    }
    text += fmt::format("<circle fill=\"{}\">", colour(i));
    for (const auto& [name, values] : {std::pair("cx", &x), std::pair("cy", &y), std::pair("r", &r)})
      text += fmt::format("<animate attributeName=\"{}\" dur=\"{}s\" repeatCount=\"indefinite\" values=\"{}\"/>", name,
                          seconds, *values);
    text += "</circle>\n";
  }
  return text + "</g>\n</svg>\n";
}

}  // namespace unsnarl
