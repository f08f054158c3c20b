#include "unsnarl/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "contact/intersection_finder.h"
#include "contact/intersection_segments.h"
#include "geometry/parallel.h"
#include "io/parse_json.h"
#include "mesh/validity.h"
#include "render/page.h"
#include "scene/face_pairs.h"
#include "scene/prepared_surface.h"
#include "unsnarl/document.h"
#include "unsnarl/parts.h"

namespace unsnarl {
namespace {

nlohmann::ordered_json parsed(const std::string& report) {
  if (report.empty()) return nullptr;
  try {
    return parse_json(report);
  } catch (const FileError& error) {
    throw std::invalid_argument(fmt::format("PageSource::report: {}; give what report_json returns", error.what()));
  }
}

}  // namespace

std::string view_page(std::string_view page_template, const PageSource& source) {
  const ThreadLimit threads(source.find.threads);
  const PreparedSurface prepared = prepare(source.before, source.find);
  if (!source.after.empty()) require_positions(source.before, source.after);
  IntersectionFinder finder(prepared.triangles(), prepared.passing());
  std::vector<IntersectingPair> pairs_before, pairs_after;
  const auto state_at = [&](std::span<const double> positions, std::vector<IntersectingPair>& pairs) {
    const Positions x = prepared.gather(positions);
    std::vector<IntersectingPair> of_triangles = finder.find(x);
    if (source.goal == Goal::disjoint)
      std::erase_if(of_triangles, [](const IntersectingPair& pair) { return pair.kind != PairClass::disjoint; });
    pairs = pairs_of_faces(prepared.triangulation.polygon, of_triangles);
    std::vector<std::array<Vec3, 2>> curves = intersection_segments(x, prepared.triangles(), of_triangles);
    for (std::array<Vec3, 2>& segment : curves)
      for (Vec3& end : segment) end = end.unaryExpr([&](double number) { return prepared.scale.out(number); });
    return PageState{positions, pairs, std::move(curves), find_allowed_pairs(prepared, std::nullopt, x).size()};
  };
  PageContent content;
  content.input_name = source.input_name;
  content.output_name = source.output_name;
  content.files = source.files;
  content.faces = source.before;
  content.before = state_at(source.before.positions, pairs_before);
  if (!source.after.empty()) content.after = state_at(source.after, pairs_after);
  content.parts = parts_of_faces(source.before, source.labels, source.find);
  content.appearance = source.appearance;
  content.report = parsed(source.report);
  content.frames = source.frames;
  return make_page(page_template, content);
}

}  // namespace unsnarl
