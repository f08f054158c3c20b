#include <nlohmann/json.hpp>

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

unsnarl_result relaxed(const Link& knot, const unsnarl_options& given, Context* context) {
  const RelaxedWire wire = relaxed_wire(knot, given.time_limit, context);
  unsnarl_result result;
  result.status = to_string(wire.status);
  result.report = Json{{"at_rest", wire.at_rest}, {"energy", wire.energy}, {"seconds", wire.seconds}}.dump();
  add_polylines(result, wire.link.components, 3);
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

int unsnarl_relaxed_wire(const unsnarl_curves* knot, const unsnarl_options* options, unsnarl_context* context,
                         unsnarl_result** result) {
  return hand_out(result, [&] {
    return relaxed(link_of(curves_of(knot, "knot")), options_of(options, Work::relaxed_wire), context_of(context));
  });
}
