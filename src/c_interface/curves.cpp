#include "unsnarl/curves.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "arguments.h"
#include "results.h"
#include "unsnarl/isotopy.h"
#include "unsnarl/visible_text.h"

namespace unsnarl::c_interface {
namespace {

std::vector<std::int32_t> rows_of(std::span<const CurveCrossing> crossings) {
  std::vector<std::int32_t> rows;
  rows.reserve(4 * crossings.size());
  for (const CurveCrossing& c : crossings) rows.insert(rows.end(), {c.curve_a, c.segment_a, c.curve_b, c.segment_b});
  return rows;
}

unsnarl_result untangled(const std::vector<Curve>& curves, const unsnarl_options& given, Context* context) {
  CurveOptions options;
  options.gap_rel = given.gap;
  options.junction_rel = given.junction;
  options.fix_ends = given.fix_ends != 0;
  options.move_strands = given.move_strands != 0;
  options.recover = given.recover != 0;
  options.time_limit_s = given.time_limit;
  const CurveResult made = untangle_curves(curves, options, context);

  unsnarl_result result;
  result.status = to_string(made.status);
  result.report = curve_report_json(made);
  std::vector<std::vector<double>> points;
  for (const Curve& curve : made.curves) points.push_back(curve.points);
  add_polylines(result, points, 2);
  result.arrays["obstructions"] = {rows_of(made.report.fixed), 4};
  result.arrays["left"] = {rows_of(made.report.left), 4};
  return result;
}

/// Numbers of a text such as "0=1,2=0".
std::vector<std::array<std::int32_t, 2>> pairs_of(std::string_view text) {
  std::vector<std::array<std::int32_t, 2>> pairs;
  const std::string_view all = text;
  while (!text.empty()) {
    std::array<std::int32_t, 2>& pair = pairs.emplace_back();
    for (const int k : {0, 1}) {
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), pair[k]);
      const auto read = static_cast<std::size_t>(end - text.data());
      const char wanted = k == 0 ? '=' : ',';
      if (error != std::errc() || pair[k] < 0 || (read == text.size() ? k == 0 : text[read] != wanted) ||
          (k == 1 && read + 1 == text.size()))
        throw std::invalid_argument(
            fmt::format("pairs: \"{}\" is no list of pairs; write START=END,..., such as 0=1,1=0", visible_text(all)));
      text.remove_prefix(std::min(read + 1, text.size()));
    }
  }
  return pairs;
}

unsnarl_result isotopy(const std::vector<Curve>& start, const std::vector<Curve>& end, const unsnarl_options& given,
                       Context* context) {
  IsotopyOptions options;
  options.points = given.points;
  options.time_limit_s = given.time_limit;
  if (given.pairs != nullptr) {
    options.pairs = pairs_of(given.pairs);
  } else {
    for (std::size_t c = 0; c < std::min(start.size(), end.size()); ++c)
      options.pairs.push_back({static_cast<std::int32_t>(c), static_cast<std::int32_t>(c)});
  }
  Isotopy made = planar_isotopy(start, end, options, context);

  unsnarl_result result;
  result.status = to_string(made.status);
  result.report = fmt::format(
      R"({{"method": "{}", "shortened": {}, "length_kept": {}, "area_kept": {}, "becomes": [{}]}})",
      to_string(made.method), made.shortened, made.length_kept, made.area_kept, fmt::join(made.partner, ", "));
  std::vector<double> times;
  std::vector<std::vector<double>> points;
  for (const IsotopyRing& ring : made.rings) {
    times.push_back(ring.time);
    points.insert(points.end(), ring.curves.begin(), ring.curves.end());
  }
  result.arrays["times"] = {std::move(times)};
  add_polylines(result, points, 2);
  add_triangles(result, std::move(made.surface));
  return result;
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_find_crossings(const unsnarl_curves* curves, unsnarl_result** result) {
  return hand_out(result, [&] {
    unsnarl_result found;
    found.arrays["crossings"] = {rows_of(find_crossings(plane_curves(curves_of(curves, "curves")))), 4};
    return found;
  });
}

int unsnarl_untangle_curves(const unsnarl_curves* curves, const unsnarl_options* options, unsnarl_context* context,
                            unsnarl_result** result) {
  return hand_out(result, [&] {
    return untangled(plane_curves(curves_of(curves, "curves")), options_of(options, Work::curves), context_of(context));
  });
}

int unsnarl_planar_isotopy(const unsnarl_curves* start, const unsnarl_curves* end, const unsnarl_options* options,
                           unsnarl_context* context, unsnarl_result** result) {
  return hand_out(result, [&] {
    return isotopy(plane_curves(curves_of(start, "start")), plane_curves(curves_of(end, "end")),
                   options_of(options, Work::isotopy), context_of(context));
  });
}
