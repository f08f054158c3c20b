#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz/promise.h"
#include "fuzz/targets.h"
#include "unsnarl/curves.h"

namespace unsnarl::fuzz {
namespace {

/// Points up to which curves are untangled too: at 53 it took 20 s of a fuzzer, at 40 a few.
constexpr std::size_t most_points = 40;

std::optional<CurveDocument> parsed(const std::string& text, CurveFormat format) {
  try {
    return CurveDocument::parse(text, format);
  } catch (const FileError& refusal) {
    promise(refusal.what()[0] != '\0', "a refusal has a reason");
    return std::nullopt;
  }
}

/// Every other coordinate or so moved, the same way each time.
std::vector<Curve> moved(std::vector<Curve> curves) {
  std::uint64_t state = curves.size();
  for (Curve& curve : curves)
    for (double& x : curve.points) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const auto step = static_cast<double>(state >> 33 & 7) - 3;
      const double to = x + step / 16 * (std::abs(x) + 1);
      if (step > 0 && std::isfinite(to)) x = to;
    }
  return curves;
}

/// Points of an element that lie on each other are one point, so that fewer would be read back. `rounding`: of the
/// coordinates, / diagonal.
bool has_short_segments(const std::vector<Curve>& curves, double diagonal, double rounding) {
  double largest = 0;
  for (const Curve& curve : curves)
    for (const double c : curve.points) largest = std::max(largest, std::abs(c));
  const double length = 1e-11 * largest + rounding * diagonal;
  for (const Curve& curve : curves)
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const std::size_t next = (k + 1) % curve.size();
      const double dx = curve.points[2 * next] - curve.points[2 * k];
      const double dy = curve.points[2 * next + 1] - curve.points[2 * k + 1];
      if (!(std::max(std::abs(dx), std::abs(dy)) > length)) return true;
    }
  return false;
}

/// `exact`: the coordinates of the file are those of the curves, without transforms.
void check_patching(const CurveDocument& document, const std::string& text, double diagonal, bool exact) {
  const std::vector<Curve>& curves = document.curves();
  const std::vector<Curve> to = moved(curves);
  const std::vector<CurveWriting> polylines(curves.size(), CurveWriting::polyline);
  for (const bool all_digits : {false, true}) {
    promise(document.patched(curves, all_digits) == text, "without motion the file comes back byte for byte");
    for (const CurveWriting writing : {CurveWriting::smooth, CurveWriting::beziers}) {
      const std::vector<CurveWriting> all(curves.size(), writing);
      const std::vector<Curve> with_beziers = document.read_back(document.patched(to, all_digits, all));
      promise(with_beziers.size() <= curves.size(), "a file with Béziers has no more curves");
    }
    const std::vector<Curve> back = document.read_back(document.patched(to, all_digits, polylines));
    if (!exact || has_short_segments(to, diagonal, 1e-8)) continue;
    promise(back.size() == curves.size(), "a patched file has as many curves");
    for (std::size_t c = 0; c < curves.size(); ++c) {
      promise(back[c].closed == curves[c].closed, "closed curves stay closed");
      promise(back[c].points.size() == curves[c].points.size(), "a patched curve has as many points");
      for (std::size_t k = 0; k < back[c].points.size(); ++k)
        promise(all_digits ? back[c].points[k] == to[c].points[k]
                           : std::abs(back[c].points[k] - to[c].points[k]) <= 1e-8 * diagonal,
                "points are read back where they were put");
    }
  }
}

void check_untangling(const CurveDocument& document, double diagonal, bool exact) {
  const CurveResult result = untangle_curves(document.curves());
  const CurveReport& report = result.report;
  promise(find_crossings(result.curves, report.joints) == report.left, "the crossings left are those that are there");
  promise(report.left.size() == report.crossings_after, "the crossings left are counted");
  promise(report.crossings_after <= report.crossings_before, "no more crossings than before");
  promise((result.status == Status::embedded) == report.left.empty(), "'embedded' is true");
  for (const CurveJoint& joint : report.joints)
    for (const auto& [c, k] : joint)
      for (int axis = 0; axis < 2; ++axis)
        promise(result.curves[c].points[2 * k + axis] == result.curves[joint[0][0]].points[2 * joint[0][1] + axis],
                "joints stay together");
  const std::vector<CurveWriting> polylines(result.curves.size(), CurveWriting::polyline);
  const std::vector<Curve> back = document.read_back(document.patched(result.curves, true, polylines));
  if (!exact || has_short_segments(result.curves, diagonal, 0)) return;
  promise(find_crossings(back, report.joints) == report.left, "a written file has the crossings of the result");
}

void check(Bytes bytes, CurveFormat format) {
  const std::string text(bytes.begin(), bytes.end());
  const std::optional<CurveDocument> document = parsed(text, format);
  if (!document) return;
  promise(document->ids().size() == document->curves().size(), "one id a curve");
  std::size_t points = 0;
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  for (const Curve& curve : document->curves()) {
    points += curve.size();
    promise(curve.size() >= (curve.closed ? 3 : 2), "curves have enough points");
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      promise(std::isfinite(curve.points[k]), "coordinates are finite");
      low[k % 2] = std::min(low[k % 2], curve.points[k]);
      high[k % 2] = std::max(high[k % 2], curve.points[k]);
    }
  }
  const double diagonal = points == 0 ? 0 : std::hypot(high[0] - low[0], high[1] - low[1]);
  const bool exact = format == CurveFormat::json || text.find("transform") == std::string::npos;
  check_patching(*document, text, diagonal, exact);
  if (points > 0 && points <= most_points) check_untangling(*document, diagonal, exact);
}

}  // namespace

void curves_svg(Bytes bytes) {
  check(bytes, CurveFormat::svg);
}
void curves_json(Bytes bytes) {
  check(bytes, CurveFormat::json);
}

}  // namespace unsnarl::fuzz
