#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "applications/curves/curve_net.h"

namespace unsnarl {
namespace {

/// Written points of one joint may be this far apart, since transforms of elements are inverted in doubles (unit:
/// bounding-box diagonal)
constexpr double joint_apart_rel = 1e-8;

std::string faults_of(const std::vector<Curve>& written, const CurveResult& result) {
  if (written.size() != result.curves.size()) return "it has another number of curves";
  for (std::size_t c = 0; c < written.size(); ++c)
    if (written[c].size() != result.curves[c].size() || written[c].closed != result.curves[c].closed)
      return fmt::format("{} has another number of points", name_of_curve(written[c], c));
  for (const CurveJoint& joint : result.report.joints) {
    const auto [c, k] = joint[0];
    for (const auto& [other, point] : joint)
      for (int axis = 0; axis < 2; ++axis)
        if (!(std::abs(written[other].points[2 * point + axis] - written[c].points[2 * k + axis]) <=
              joint_apart_rel * result.report.diagonal))
          return fmt::format("{} and {} have come apart", name_of_curve(written[c], static_cast<std::size_t>(c)),
                             name_of_curve(written[other], static_cast<std::size_t>(other)));
  }
  const std::size_t crossings = find_crossings(written, result.report.joints).size();
  if (crossings <= result.report.crossings_after) return {};
  return fmt::format("it has {} crossing{}, the result {}", crossings, crossings == 1 ? "" : "s",
                     result.report.crossings_after);
}

}  // namespace

std::string curve_file_faults(const CurveDocument& document, const std::string& bytes, const CurveResult& result) {
  try {
    return faults_of(document.read_back(bytes), result);
  } catch (const std::invalid_argument& e) {  // a segment that has lost its length
    return e.what();
  }
}

}  // namespace unsnarl
