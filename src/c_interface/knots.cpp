#include "arguments.h"
#include "results.h"
#include "unsnarl/knot_isotopy.h"

namespace unsnarl::c_interface {
namespace {

unsnarl_result moved(const Link& start, const Link& end, const unsnarl_options& given, Context* context) {
  KnotIsotopyOptions options;
  options.points = given.points;
  options.time_limit_s = given.time_limit;
  KnotIsotopy made = knot_isotopy(start, end, options, context);
  KnotIsotopyFindings findings;
  if (made.status == Status::embedded) findings = check_knot_isotopy(made, start, end);

  unsnarl_result result;
  result.status = to_string(made.status);
  std::vector<double> times;
  std::vector<std::vector<double>> points;
  for (KnotRing& ring : made.rings) {
    times.push_back(ring.time);
    points.push_back(std::move(ring.points));
  }
  made.rings.clear();
  result.report = knot_isotopy_json(made, findings);
  result.arrays["times"] = {std::move(times)};
  add_polylines(result, points, 3);
  return result;
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_knot_isotopy(const unsnarl_curves* start, const unsnarl_curves* end, const unsnarl_options* options,
                         unsnarl_context* context, unsnarl_result** result) {
  return hand_out(result, [&] {
    return moved(link_of(curves_of(start, "start")), link_of(curves_of(end, "end")),
                 options_of(options, Work::knot_isotopy), context_of(context));
  });
}
