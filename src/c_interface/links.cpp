#include "unsnarl/link.h"

#include <nlohmann/json.hpp>

#include "arguments.h"
#include "results.h"
#include "unsnarl/seifert.h"

namespace unsnarl::c_interface {
namespace {

Json json_of(const SeifertFindings& found) {
  return {{"intersecting_pairs", found.intersecting_pairs},
          {"oriented", found.oriented},
          {"spans_link", found.spans_link},
          {"components", found.components},
          {"genus", found.genus},
          {"euler_characteristic", found.euler_characteristic},
          {"expected_euler_characteristic", found.expected_euler_characteristic},
          {"alexander_of_surface", found.alexander_of_surface},
          {"alexander_of_link", found.alexander_of_link},
          {"determinant", found.determinant},
          {"signature", found.signature},
          {"genus_is_least", found.genus_is_least},
          {"hold", found.hold()}};
}

SeifertOptions seifert_options(const unsnarl_options& given) {
  SeifertOptions options;
  options.edge_rel = given.edge;
  options.views = given.views;
  options.fair = given.fair != 0;
  options.handles = given.handles;
  options.time_limit_s = given.time_limit;
  return options;
}

unsnarl_result result_of(SeifertResult made, Json json) {
  if (!made.message.empty()) json["message"] = made.message;
  json["crossings"] = made.crossings;
  json["circles"] = made.circles;
  json["area"] = made.area;
  json["seconds"] = made.seconds;
  unsnarl_result result;
  result.status = to_string(made.status);
  result.report = json.dump();
  add_triangles(result, std::move(made.surface));
  return result;
}

unsnarl_result spanned(const Link& link, const unsnarl_options& given, Context* context) {
  const SeifertOptions options = seifert_options(given);
  SeifertResult made = seifert_surface(link, options, context);
  Json json = Json::object();
  if (made.status != Status::no_progress)
    json = json_of(check_seifert_surface(made.surface, link, options.views, options.handles));
  return result_of(std::move(made), std::move(json));
}

unsnarl_result untangled(const SurfaceView& start, const unsnarl_options& given, Context* context) {
  const SeifertOptions options = seifert_options(given);
  const SpanningBoundary boundary = spanning_boundary(start);
  SeifertResult made = untangled_seifert_surface(start, options, context);
  Json json = Json::object();
  if (!made.surface.positions.empty())
    json = json_of(check_seifert_surface(made.surface, boundary.link, options.views, 0, boundary.euler_characteristic));
  return result_of(std::move(made), std::move(json));
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_seifert_surface(const unsnarl_curves* link, const unsnarl_options* options, unsnarl_context* context,
                            unsnarl_result** result) {
  return hand_out(result, [&] {
    return spanned(link_of(curves_of(link, "link")), options_of(options, Work::seifert), context_of(context));
  });
}

int unsnarl_untangled_seifert_surface(const unsnarl_surface* start, const unsnarl_options* options,
                                      unsnarl_context* context, unsnarl_result** result) {
  return hand_out(result, [&] {
    const SurfaceView view = view_of(surface_of(start));
    check_corners(view);
    return untangled(view, options_of(options, Work::seifert), context_of(context));
  });
}

int unsnarl_check_seifert_surface(const unsnarl_surface* surface, const unsnarl_curves* link,
                                  const unsnarl_options* options, unsnarl_result** result) {
  return hand_out(result, [&] {
    const SurfaceView view = view_of(surface_of(surface));
    check_corners(view);
    const Link of = link_of(curves_of(link, "link"));
    const unsnarl_options given = options_of(options, Work::check_seifert);
    unsnarl_result found;
    found.report = json_of(check_seifert_surface(view, of, given.views, given.handles)).dump();
    return found;
  });
}

int unsnarl_knot_tube(const unsnarl_curves* link, const unsnarl_surface* spanning, unsnarl_result** result) {
  return hand_out(result, [&] {
    const SurfaceView view = view_of(surface_of(spanning));
    check_corners(view);
    KnotTube tube = knot_tube(link_of(curves_of(link, "link")), view);
    unsnarl_result made;
    made.report = Json{{"radius", tube.radius}}.dump();
    add_triangles(made, std::move(tube.surface));
    return made;
  });
}

int unsnarl_knot_of_table(const char* name, unsnarl_result** result) {
  return hand_out(result, [&] {
    require(name, "name");
    unsnarl_result found;
    add_polylines(found, knot_of_table(name).components, 3);
    return found;
  });
}
