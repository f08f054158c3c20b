#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "applications/curves/closeness.h"
#include "applications/curves/curve_net.h"

namespace unsnarl {
namespace {

/// Written points of one joint may be this far apart, since transforms of elements are inverted in doubles (unit:
/// bounding-box diagonal)
constexpr double joint_apart_rel = 1e-8;

/// Written Béziers may be this far from the curves of the result: near points that moved they are up to five tolerances
/// from them, and both are flattened (unit: tolerances of flattening)
constexpr double most_apart = 10;

/// Béziers may cross where their polylines do not. So curves are written as Béziers only if polylines within this part
/// of the tolerance do not cross either (unit: tolerances of flattening)
constexpr double chosen_part_of_tolerance = 1.0 / 16;

/// Rounds in which curves at fault are written more plainly, before all are (unit: rounds)
constexpr int most_rounds = 8;

struct Faults {
  std::string text;                           ///< empty: there are none
  std::vector<std::uint8_t> curves_at_fault;  ///< one flag a curve of the result, where single ones are
};

CurveNet net_of(const Curve& curve) {
  return make_net({&curve, 1}, {}, false);
}

/// The largest distance between two curves of a drawing, all along both of them.
double distance_between(const Curve& a, const Curve& b, double diagonal) {
  CurveNet first = net_of(a), second = net_of(b);
  first.diagonal = second.diagonal = diagonal;
  return std::max(closeness_of(first, first.rest, second, second.rest, 0).largest,
                  closeness_of(second, second.rest, first, first.rest, 0).largest);
}

/// The point of a written curve that is point k of the result's.
std::int32_t written_point(const Curve& written, const Curve& wanted, std::int32_t k) {
  if (written.tolerance == 0 || written.points == wanted.points) return k;
  const auto size = static_cast<std::int32_t>(written.size());
  if (k == 0) return 0;  // paths begin and end where their curves do
  if (!written.closed && k + 1 == static_cast<std::int32_t>(wanted.size())) return size - 1;
  std::int32_t nearest = 1;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t w = 1; w < (written.closed ? size : size - 1); ++w) {
    const double x = written.points[2 * w] - wanted.points[2 * k],
                 y = written.points[2 * w + 1] - wanted.points[2 * k + 1];
    if (x * x + y * y < least) {
      least = x * x + y * y;
      nearest = w;
    }
  }
  return nearest;
}

Faults faults_of(const std::vector<Curve>& written, const CurveResult& result) {
  const std::vector<Curve>& curves = result.curves;
  if (written.size() != curves.size()) return {"it has another number of curves", {}};
  Faults faults{{}, std::vector<std::uint8_t>(curves.size(), 0)};
  double tolerance = 0;
  for (const Curve& curve : curves) tolerance = std::max(tolerance, curve.tolerance);
  for (std::size_t c = 0; c < written.size(); ++c) {
    const Curve& curve = written[c];
    const bool is_as_long = curve.size() == curves[c].size();
    if (curve.closed != curves[c].closed || (!is_as_long && curve.tolerance == 0))
      return {fmt::format("{} has another number of points", name_of_curve(curve, c)), {}};
    if (curve.tolerance == 0 || curve.points == curves[c].points) continue;
    if (distance_between(curve, curves[c], result.report.diagonal) <= most_apart * tolerance) continue;
    faults.curves_at_fault[c] = 1;
    faults.text = fmt::format("{} is elsewhere", name_of_curve(curve, c));
  }
  std::vector<CurveJoint> joints = result.report.joints;
  for (CurveJoint& joint : joints) {
    for (auto& [c, k] : joint) k = written_point(written[c], curves[c], k);
    const auto [c, k] = joint[0];
    for (const auto& [other, point] : joint)
      for (int axis = 0; axis < 2; ++axis)
        if (!(std::abs(written[other].points[2 * point + axis] - written[c].points[2 * k + axis]) <=
              joint_apart_rel * result.report.diagonal))
          return {fmt::format("{} and {} have come apart", name_of_curve(written[c], static_cast<std::size_t>(c)),
                              name_of_curve(written[other], static_cast<std::size_t>(other))),
                  {}};
    std::sort(joint.begin(), joint.end());
  }
  const std::vector<CurveCrossing> crossings = find_crossings(written, joints);
  if (crossings.size() <= result.report.crossings_after) return faults;
  for (const CurveCrossing& crossing : crossings)
    faults.curves_at_fault[crossing.curve_a] = faults.curves_at_fault[crossing.curve_b] = 1;
  faults.text = fmt::format("it has {} crossing{}, the result {}", crossings.size(), crossings.size() == 1 ? "" : "s",
                            result.report.crossings_after);
  return faults;
}

Faults faults_of_bytes(const CurveDocument& document, const std::string& bytes, const CurveResult& result,
                       double part_of_tolerance) {
  try {
    return faults_of(document.read_back(bytes, part_of_tolerance), result);
  } catch (const std::invalid_argument& e) {  // a segment that has lost its length
    return {e.what(), {}};
  }
}

}  // namespace

std::string curve_file_faults(const CurveDocument& document, const std::string& bytes, const CurveResult& result) {
  return faults_of_bytes(document, bytes, result, 1).text;
}

std::string written_curves(const CurveDocument& document, const CurveResult& result) {
  std::vector<CurveWriting> writing(result.curves.size(), CurveWriting::smooth);
  for (const bool all_digits : {false, true}) {
    for (int round = 0; round < most_rounds; ++round) {
      std::string bytes = document.patched(result.curves, all_digits, writing);
      Faults faults = faults_of_bytes(document, bytes, result, 1);
      const bool is_certified = faults.text.empty();
      if (is_certified) faults = faults_of_bytes(document, bytes, result, chosen_part_of_tolerance);
      if (faults.text.empty()) return bytes;
      bool is_another = false;
      for (std::size_t c = 0; c < faults.curves_at_fault.size(); ++c) {
        if (faults.curves_at_fault[c] == 0 || writing[c] == CurveWriting::polyline) continue;
        writing[c] = writing[c] == CurveWriting::smooth ? CurveWriting::beziers : CurveWriting::polyline;
        is_another = true;
      }
      if (is_another) continue;
      if (is_certified) return bytes;  // the finer polylines cross where both curves are polylines already
      break;
    }
  }
  writing.assign(writing.size(), CurveWriting::polyline);
  return document.patched(result.curves, true, writing);
}

}  // namespace unsnarl
