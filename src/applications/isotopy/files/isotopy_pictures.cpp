#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "applications/isotopy/rings.h"

namespace unsnarl {
namespace {

constexpr double margin = 0.05;      ///< Margin around the curves (unit: the longer side)
constexpr double stroke = 0.004;     ///< Width of the lines (unit: the longer side)
constexpr double seconds_a_way = 4;  ///< Time of an animation from start to end (unit: s)

struct Bounds {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
};

constexpr int short_digits = 6;  ///< Significant digits of coordinates in pictures (unit: digits)
constexpr int all_digits = 17;   ///< Significant digits that give every double back (fixed by float64)

std::string opening(const Isotopy& isotopy, int digits = short_digits) {
  Bounds b;
  for (const IsotopyRing& ring : isotopy.rings)
    for (const std::vector<double>& p : ring.curves)
      for (std::size_t k = 0; k < p.size(); k += 2) {
        b.low = b.low.cwiseMin(Vec2(p[k], p[k + 1]));
        b.high = b.high.cwiseMax(Vec2(p[k], p[k + 1]));
      }
  const Vec2 size = b.high - b.low;
  const double longer = size.maxCoeff(), room = margin * longer;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"600\" viewBox=\"{:.{}g} {:.{}g} {:.6g} {:.6g}\">\n"
      "<g fill=\"#7f9fc4\" fill-opacity=\"0.5\" stroke=\"#1f2f4f\" stroke-linejoin=\"round\" "
      "stroke-width=\"{:.6g}\">\n",
      b.low.x() - room, digits, b.low.y() - room, digits, size.x() + 2 * room, size.y() + 2 * room, stroke * longer);
}

std::string points_text(const std::vector<double>& p, int digits = short_digits) {
  std::string text;
  for (std::size_t k = 0; k < p.size(); k += 2)
    fmt::format_to(std::back_inserter(text), "{}{:.{}g},{:.{}g}", k == 0 ? "" : " ", p[k], digits, p[k + 1], digits);
  return text;
}

std::string frame_of(const Isotopy& isotopy, std::span<const Curve> curves, int digits) {
  std::string text = opening(isotopy, digits);
  for (const Curve& curve : curves)
    text += fmt::format("<polygon points=\"{}\"/>\n", points_text(curve.points, digits));
  return text + "</g>\n</svg>\n";
}

/// As it is read back.
bool has_simple_curves(const std::string& frame, std::size_t count) {
  try {
    const std::vector<Curve> curves = CurveDocument::parse(frame, CurveFormat::svg).curves();
    return curves.size() == count && find_crossings(curves).empty();
  } catch (const FileError&) {
    return false;  // nothing is left of a curve
  }
}

/// The ring that begins the strip of a time, and how far the time is along it, in [0, 1].
std::pair<std::size_t, double> strip_at(const Isotopy& isotopy, double time) {
  if (isotopy.rings.empty()) throw std::invalid_argument("an isotopy without rings has no curves");
  if (!(time >= 0 && time <= 1)) throw std::invalid_argument(fmt::format("time is {}; give 0 to 1", time));
  std::size_t k = 0;
  while (k + 2 < isotopy.rings.size() && isotopy.rings[k + 1].time <= time) ++k;
  const double from = isotopy.rings[k].time, to = isotopy.rings[k + 1].time;
  return {k, std::clamp((time - from) / (to - from), 0.0, 1.0)};
}

/// The curves in the strip above ring k, at a fraction of its time: a point on each rung.
std::vector<Curve> cut_of(const Isotopy& isotopy, std::size_t k, double t) {
  const IsotopyRing &from = isotopy.rings[k], &to = isotopy.rings[k + 1];
  std::vector<Curve> curves;
  for (std::size_t c = 0; c < from.curves.size(); ++c) {
    Curve& curve = curves.emplace_back();
    curve.closed = true;
    for (const IsotopyRung& rung : isotopy.rungs[k][c])
      for (int axis = 0; axis < 2; ++axis)
        curve.points.push_back((1 - t) * from.curves[c][2 * rung.lower + axis] +
                               t * to.curves[c][2 * rung.upper + axis]);
  }
  return curves;
}

/// Drawings evenly in time, all of as many points, so that browsers move from one to the next: those of an annulus. Its
/// first and its last ring have other points than the rings beside them, and look the same.
std::vector<std::vector<Curve>> drawings_of_annulus(const Isotopy& isotopy, int frames) {
  const std::size_t last = isotopy.rings.size() - 3;
  std::vector<std::vector<Curve>> drawings;
  for (int f = 0; f < frames; ++f) {
    const auto [k, t] = strip_at(isotopy, static_cast<double>(f) / (frames - 1));
    drawings.push_back(k < 1 ? cut_of(isotopy, 1, 0) : k > last ? cut_of(isotopy, last, 1) : cut_of(isotopy, k, t));
  }
  return drawings;
}

}  // namespace

std::vector<Curve> isotopy_slice(const Isotopy& isotopy, double time) {
  const auto [k, t] = strip_at(isotopy, time);
  if (t > 0 && t < 1) return cut_of(isotopy, k, t);
  std::vector<Curve> curves;
  for (const std::vector<double>& points : isotopy.rings[t == 0 ? k : k + 1].curves) {
    Curve& curve = curves.emplace_back();
    curve.closed = true;
    curve.points = points;
  }
  return curves;
}

std::string isotopy_frame_svg(const Isotopy& isotopy, double time) {
  const std::vector<Curve> curves = isotopy_slice(isotopy, time);
  const std::string text = frame_of(isotopy, curves, short_digits);
  return has_simple_curves(text, curves.size()) ? text : frame_of(isotopy, curves, all_digits);
}

std::string isotopy_animation_svg(const Isotopy& isotopy, int frames) {
  if (frames < 2 || frames > 1000) throw std::invalid_argument(fmt::format("frames is {}; give 2 to 1000", frames));
  // Removing corners changes the number of points from drawing to drawing, and browsers cannot interpolate these.
  const bool is_smooth = isotopy.method != IsotopyMethod::shortening && isotopy.rings.size() >= 4;
  std::vector<std::vector<Curve>> drawings;
  if (is_smooth)
    drawings = drawings_of_annulus(isotopy, frames);
  else
    for (int f = 0; f < frames; ++f) drawings.push_back(isotopy_slice(isotopy, static_cast<double>(f) / (frames - 1)));
  for (int f = frames - 1; f >= 0; --f) drawings.push_back(drawings[f]);
  std::string text = opening(isotopy);
  for (std::size_t c = 0; c < isotopy.points.size(); ++c) {
    std::string values;
    for (const std::vector<Curve>& drawing : drawings)
      values.append(values.empty() ? "" : ";").append(points_text(drawing[c].points));
    text += fmt::format(
        "<polygon points=\"{}\"><animate attributeName=\"points\" calcMode=\"{}\" dur=\"{:.6g}s\" "
        "repeatCount=\"indefinite\" values=\"{}\"/></polygon>\n",
        points_text(drawings.front()[c].points), is_smooth ? "linear" : "discrete", 2 * seconds_a_way, values);
  }
  return text + "</g>\n</svg>\n";
}

}  // namespace unsnarl
