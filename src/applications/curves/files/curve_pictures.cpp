#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "applications/curves/crossings.h"
#include "geometry/portable_math.h"
#include "render/png.h"

namespace unsnarl {
namespace {

constexpr double page = 800;    ///< Side of one half of the picture (unit: SVG units)
constexpr double margin = 40;   ///< Margin around the curves (unit: SVG units)
constexpr double stroke = 1.6;  ///< Width of the lines (unit: SVG units)
// Colour-blind safe, dark enough on white; the first alone where there is one curve.
constexpr std::array<const char*, 6> colours = {"#1f4e79", "#b5651d", "#2e7d4f", "#7b3f8c", "#8a6d00", "#555555"};

struct Frame {
  Vec2 low, high;
  double scale = 1;
  Vec2 operator()(const Vec2& p, double left) const {
    const Vec2 middle = 0.5 * (low + high);
    return Vec2(left + 0.5 * page, 0.5 * page) + scale * (p - middle);
  }
};

Frame frame_around(std::span<const Curve> before, std::span<const Curve> after) {
  Frame frame;
  frame.low.setConstant(std::numeric_limits<double>::infinity());
  frame.high = -frame.low;
  for (const std::span<const Curve> curves : {before, after})
    for (const Curve& curve : curves)
      for (std::size_t k = 0; k < curve.size(); ++k) {
        const Vec2 p(curve.points[2 * k], curve.points[2 * k + 1]);
        frame.low = frame.low.cwiseMin(p);
        frame.high = frame.high.cwiseMax(p);
      }
  const double size = (frame.high - frame.low).maxCoeff();
  if (size > 0) frame.scale = (page - 2 * margin) / size;
  return frame;
}

std::string half(std::span<const Curve> curves, std::span<const CurveCrossing> crossings, const Frame& frame,
                 double left, const std::string& label) {
  std::string svg =
      fmt::format("<text x=\"{}\" y=\"26\" font-family=\"sans-serif\" font-size=\"18\" fill=\"#333\">{}</text>\n",
                  left + 20, label);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    svg += "<path d=\"";
    for (std::size_t k = 0; k < curves[c].size(); ++k) {
      const Vec2 p = frame({curves[c].points[2 * k], curves[c].points[2 * k + 1]}, left);
      svg += fmt::format("{}{:.3f} {:.3f}", k == 0 ? "M" : " ", p.x(), p.y());
    }
    svg += fmt::format("{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>\n",
                       curves[c].closed ? "Z" : "", colours[c % colours.size()], stroke);
  }
  for (const CurveCrossing& crossing : crossings) {
    const auto end = [&](std::int32_t c, std::int32_t k) -> Vec2 {
      const std::size_t i = static_cast<std::size_t>(k) % curves[c].size();
      return {curves[c].points[2 * i], curves[c].points[2 * i + 1]};
    };
    Points2 x(2, 4);
    x << end(crossing.curve_a, crossing.segment_a), end(crossing.curve_a, crossing.segment_a + 1),
        end(crossing.curve_b, crossing.segment_b), end(crossing.curve_b, crossing.segment_b + 1);
    const double t = crossing_fraction(x, {0, 1}, {2, 3});
    const Vec2 p = frame(x.col(0) + t * (x.col(1) - x.col(0)), left);
    svg += fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"4\" fill=\"#d62728\"/>\n", p.x(), p.y());
  }
  return svg;
}

std::string label(const char* when, std::size_t crossings) {
  if (crossings == 0) return fmt::format("{}: no crossings", when);
  return crossings == 1 ? fmt::format("{}: 1 crossing", when) : fmt::format("{}: {} crossings", when, crossings);
}

/// Dark blue over green to yellow, for t in [0, 1]; lightness grows with t.
std::array<std::uint8_t, 3> heat(double t) {
  /// Colours that the scale runs through, dark blue over green to yellow (unit: 8-bit RGB)
  constexpr std::array<std::array<double, 3>, 5> stops = {
      {{14, 10, 46}, {59, 42, 122}, {32, 120, 140}, {110, 190, 90}, {253, 231, 37}}};
  const double s = std::clamp(t, 0.0, 1.0) * (stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(s), stops.size() - 2);
  std::array<std::uint8_t, 3> result{};
  for (int c = 0; c < 3; ++c)
    result[c] = static_cast<std::uint8_t>(std::lround(stops[k][c] + (s - k) * (stops[k + 1][c] - stops[k][c])));
  return result;
}

}  // namespace

std::string curve_picture_svg(std::span<const Curve> before, std::span<const CurveCrossing> crossings_before,
                              std::span<const Curve> after, std::span<const CurveCrossing> crossings_after) {
  const Frame frame = frame_around(before, after);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
             "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
             2 * page, page) +
         half(before, crossings_before, frame, 0, label("before", crossings_before.size())) +
         half(after, crossings_after, frame, page, label("after", crossings_after.size())) + "</svg>\n";
}

std::string curve_integrand_png(const Curve& curve, double epsilon_rel, int size) {
  if (!(epsilon_rel > 0) || !std::isfinite(epsilon_rel))
    throw std::invalid_argument(fmt::format("epsilon_rel is {}; give a number above 0", epsilon_rel));
  if (size < 64 || size > 4096) throw std::invalid_argument(fmt::format("size is {}; give 64 to 4096", size));
  check_curves({&curve, 1});
  // Points at equal distances along the curve, one a pixel.
  const std::size_t n = curve.size(), segments = curve.closed ? n : n - 1;
  const auto at = [&](std::size_t k) -> Vec2 { return {curve.points[2 * (k % n)], curve.points[2 * (k % n) + 1]}; };
  double length = 0;
  for (std::size_t k = 0; k < segments; ++k) length += (at(k + 1) - at(k)).norm();
  Points2 y(2, size);
  std::size_t k = 0;
  double done = 0;
  for (int i = 0; i < size; ++i) {
    const double wanted = length * (i + 0.5) / size;
    double edge = (at(k + 1) - at(k)).norm();
    while (k + 1 < segments && done + edge < wanted) {
      done += edge;
      ++k;
      edge = (at(k + 1) - at(k)).norm();
    }
    y.col(i) = at(k) + std::clamp((wanted - done) / edge, 0.0, 1.0) * (at(k + 1) - at(k));
  }
  const double epsilon = epsilon_rel * diagonal_of({&curve, 1});
  std::vector<double> values(static_cast<std::size_t>(size) * size);
  double largest = 0;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      double along = std::abs(i - j) * length / size;
      if (curve.closed) along = std::min(along, length - along);
      const double value = along / epsilon * portable::exp(-(y.col(i) - y.col(j)).squaredNorm() / (epsilon * epsilon));
      // The first parameter to the right, the second upwards.
      values[static_cast<std::size_t>(size - 1 - j) * size + i] = value;
      largest = std::max(largest, value);
    }
  Image image(size, size);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const double value = values[static_cast<std::size_t>(row) * size + column];
      const std::array<std::uint8_t, 3> colour = heat(largest > 0 ? value / largest : 0);
      std::copy(colour.begin(), colour.end(), image.at(column, row));
    }
  return encode_png(image);
}

}  // namespace unsnarl
