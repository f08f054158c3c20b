#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "applications/seifert/fair_surface.h"
#include "applications/seifert/link_diagram.h"
#include "geometry/box.h"
#include "run/run_control.h"
#include "unsnarl/intersections.h"
#include "unsnarl/seifert.h"

namespace unsnarl {
namespace {

/// Edge length that is chosen by itself, at least (unit: bounding-box diagonal)
constexpr double finest_edge_rel = 1.0 / 45;
/// Edge length that is chosen by itself, at most (unit: bounding-box diagonal)
constexpr double coarsest_edge_rel = 1.0 / 20;
/// Least edge length that may be asked for (unit: bounding-box diagonal)
constexpr double least_edge_rel = 1e-3;
/// Handles, at most: each is hung from what the ones before have left of the lowest disc, and the last must be far
/// above rounding (unit: handles)
constexpr int most_handles = 100;
/// Distance between the discs of nested circles, so that fairing has room there (unit: edge length of the coarsest
/// level)
constexpr double disc_step = 1;

void check(const SeifertOptions& options) {
  if (options.edge_rel != 0 && !(options.edge_rel >= least_edge_rel && options.edge_rel <= 0.5))
    throw std::invalid_argument(fmt::format("edge_rel is {}; give {} to 0.5, or 0", options.edge_rel, least_edge_rel));
  if (options.views < 3 || options.views > 10000)
    throw std::invalid_argument(fmt::format("views is {}; give 3 to 10000", options.views));
  if (options.handles < 0 || options.handles > most_handles)
    throw std::invalid_argument(fmt::format("handles is {}; give 0 to {}", options.handles, most_handles));
  if (!(options.time_limit_s >= 0)) throw std::invalid_argument("time_limit_s is below 0");
}

double edge_length(const Link& link, const SeifertOptions& options) {
  Box box;
  double length = 0;
  for (const std::vector<double>& p : link.components) {
    const std::size_t n = p.size() / 3;
    const auto at = [&](std::size_t k) { return Vec3(p[3 * (k % n)], p[3 * (k % n) + 1], p[3 * (k % n) + 2]); };
    for (std::size_t k = 0; k < n; ++k) {
      box.extend(at(k));
      length += (at(k + 1) - at(k)).norm();
    }
  }
  const double diagonal = box.diagonal();
  if (options.edge_rel > 0) return options.edge_rel * diagonal;
  return std::clamp(length / static_cast<double>(link.point_count()), finest_edge_rel * diagonal,
                    coarsest_edge_rel * diagonal);
}

Surface surface_of(const SpanningMesh& mesh) {
  Surface surface;
  for (const Vec3& p : mesh.x) surface.positions.insert(surface.positions.end(), {p[0], p[1], p[2]});
  for (const Triangle& t : mesh.faces) surface.corners.insert(surface.corners.end(), t.begin(), t.end());
  return surface;
}

double area_of(const SpanningMesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.faces)
    area += 0.5 * (mesh.x[t[1]] - mesh.x[t[0]]).cross(mesh.x[t[2]] - mesh.x[t[0]]).norm();
  return area;
}

SeifertResult without_surface(SeifertResult result, const std::string& why) {
  result.status = Status::no_progress;
  result.message = why;
  return result;
}

/// By exact arithmetic, every vertex by itself.
std::size_t intersecting_pairs(const SpanningMesh& mesh) {
  FindOptions find;
  find.weld = Weld::none;
  return find_intersections(surface_of(mesh), find).size();
}

/// `start` is embedded, and the points of the link come first in it.
SeifertResult faired_and_certified(SeifertResult result, const SpanningMesh& start, const Link& link, double edge,
                                   const SeifertOptions& options, std::optional<int> euler_characteristic,
                                   RunControl& control) {
  SpanningMesh mesh = start;
  if (options.fair) {
    const auto progress = [&](double fraction) { control.tell(fraction, "fair"); };
    const auto goes_on = [&] { return !control.stopped(); };
    mesh = fair(std::move(mesh), static_cast<Index>(link.point_count()), edge, {}, progress, goes_on);
    result.status = control.status_or(Status::embedded);
  }
  const auto faults = [&](const SpanningMesh& made) {
    return seifert_faults(
        check_seifert_surface(surface_of(made), link, options.views, options.handles, euler_characteristic));
  };
  std::string wrong;
  try {
    wrong = faults(mesh);
  } catch (const std::invalid_argument& e) {  // faired to triangles so thin that their sides are not told apart
    if (!options.fair) throw;
    wrong = faults(start);
    mesh = start;
    result.message = fmt::format("the surface is left as it was before fairing, since after fairing {}", e.what());
  }
  if (!wrong.empty()) return without_surface(std::move(result), wrong);
  result.surface = surface_of(mesh);
  result.area = area_of(mesh);
  result.seconds = control.seconds();
  return result;
}

}  // namespace

SeifertResult seifert_surface(const Link& link, const SeifertOptions& options, Context* context) {
  check(options);
  check_link(link);
  RunControl control(context, {.time_s = options.time_limit_s});
  SeifertResult result;
  const auto stop = [&] { return control.stopped(); };
  std::optional<LinkDiagram> best = best_diagram(link, options.views, stop);
  if (!best) throw std::invalid_argument("no view of the link tells its strands apart; are some closer than rounding?");
  const LinkDiagram diagram = roomier_diagram(link, std::move(*best), stop);
  result.crossings = diagram.crossings.size();
  result.circles = static_cast<std::size_t>(diagram.circles);
  const double edge = edge_length(link, options);
  SpanningMesh start;
  try {
    start = spanning_start(link, diagram, disc_step * edge, options.handles);
  } catch (const NoSpanningStart& e) {
    return without_surface(std::move(result), e.what());
  }
  if (const std::size_t pairs = intersecting_pairs(start); pairs > 0)
    return without_surface(std::move(result), fmt::format("{} pairs of its faces intersect", pairs));
  return faired_and_certified(std::move(result), start, link, edge, options, {}, control);
}

SeifertResult untangled_seifert_surface(const SurfaceView& start, const SeifertOptions& options, Context* context) {
  check(options);
  if (options.handles != 0) throw std::invalid_argument("handles are not added to a surface that is brought");
  const SpanningBoundary boundary = spanning_boundary(start);
  check_link(boundary.link);
  RunControl control(context, {.time_s = options.time_limit_s});
  RepairOptions hold_boundary;
  hold_boundary.find.weld = Weld::none;
  hold_boundary.precision = Precision::float64;
  hold_boundary.time_limit_s = options.time_limit_s;
  hold_boundary.fixed.assign(start.vertex_count(), 0);
  for (const std::int32_t v : boundary.vertices) hold_boundary.fixed[v] = 1;
  const RepairResult untangled = repair(start, hold_boundary, context);
  SeifertResult result;
  result.seconds = control.seconds();
  if (untangled.status != Status::embedded) {
    result.status = untangled.status == Status::cancelled ? Status::cancelled : Status::no_progress;
    result.message = fmt::format("with the boundary held, {} pairs of faces still intersect ({})",
                                 untangled.report.after.total(), to_string(untangled.status));
    return result;
  }
  SpanningMesh mesh;  // the boundary first
  std::vector<Index> id(start.vertex_count(), -1);
  const auto add = [&](std::size_t v) {
    id[v] = static_cast<Index>(mesh.x.size());
    mesh.x.emplace_back(Eigen::Map<const Vec3>(&untangled.positions[3 * v]));
  };
  for (const std::int32_t v : boundary.vertices) add(static_cast<std::size_t>(v));
  for (std::size_t v = 0; v < start.vertex_count(); ++v)
    if (id[v] < 0) add(v);
  for (std::size_t f = 0; f < start.face_count(); ++f) {
    const auto corners = start.face(f);
    mesh.faces.push_back({id[corners[0]], id[corners[1]], id[corners[2]]});
  }
  return faired_and_certified(std::move(result), mesh, boundary.link, edge_length(boundary.link, options), options,
                              boundary.euler_characteristic, control);
}

}  // namespace unsnarl
