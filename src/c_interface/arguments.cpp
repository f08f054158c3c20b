#include "arguments.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "errors.h"
#include "handles.h"
#include "unsnarl/isotopy.h"
#include "unsnarl/paper.h"
#include "unsnarl/report.h"
#include "unsnarl/report_json.h"
#include "unsnarl/routes.h"
#include "unsnarl/seifert.h"
#include "unsnarl/sequence.h"

namespace unsnarl::c_interface {
namespace {

/// Fields of the caller's struct over those of `whole`; its version of the struct may be older.
template <class Struct>
Struct read(const Struct* given, const char* name, Struct whole = {}) {
  require(given, name);
  check_size(given->size, sizeof whole, name);
  std::memcpy(&whole, given, given->size);
  return whole;
}

/// The one of `choices` that is called `name`.
template <class Enum>
Enum named(const char* option, const std::string& name, std::initializer_list<Enum> choices) {
  std::string all;
  for (const Enum choice : choices) {
    if (to_string(choice) == name) return choice;
    all += (all.empty() ? "'" : ", '") + std::string(to_string(choice)) + "'";
  }
  throw std::invalid_argument(std::string(option) + " is '" + name + "'; choose one of " + all);
}

PaperOptions paper_options(const unsnarl_options& options) {
  PaperOptions paper;
  paper.bandwidth = named("paper_bandwidth", options.paper_bandwidth,
                          {PaperBandwidth::global, PaperBandwidth::independent, PaperBandwidth::symmetric});
  paper.adaptive = options.paper_adaptive != 0;
  paper.bandwidth_scale = options.paper_bandwidth_scale;
  paper.neighbourhood = options.paper_neighbourhood;
  paper.lambda_gaussian = options.paper_gaussian;
  paper.lambda_mesh = options.paper_mesh;
  paper.mesh_energy = named("paper_mesh_energy", options.paper_mesh_energy,
                            {PaperMeshEnergy::penetration_depth, PaperMeshEnergy::intersection_length});
  paper.whole_polygons = options.paper_whole_polygons != 0;
  paper.lambda_arap = options.paper_arap;
  paper.memory = options.paper_memory;
  paper.max_iterations = options.paper_iterations;
  return paper;
}

AllowedPairs allowed_of(const unsnarl_surface& surface) {
  AllowedPairs allowed;
  if (surface.allowed_count == 0) return allowed;
  require(surface.face_parts, "surface: face_parts");
  require(surface.allowed, "surface: allowed");
  allowed.part_of_face.assign(surface.face_parts, surface.face_parts + view_of(surface).face_count());
  for (std::size_t k = 0; k < surface.allowed_count; ++k)
    allowed.parts.push_back({surface.allowed[2 * k], surface.allowed[2 * k + 1]});
  return allowed;
}

void check_offsets(std::span<const std::int32_t> offsets, std::size_t corners, const std::string& what) {
  if (offsets.front() != 0 || static_cast<std::size_t>(offsets.back()) != corners)
    throw std::invalid_argument("offsets run from " + std::to_string(offsets.front()) + " to " +
                                std::to_string(offsets.back()) + "; give them from 0 to " + std::to_string(corners));
  const auto descent = std::adjacent_find(offsets.begin(), offsets.end(), std::greater<>());
  if (descent != offsets.end())
    throw std::invalid_argument(what + " " + std::to_string(descent - offsets.begin()) + " runs from offset " +
                                std::to_string(descent[0]) + " to " + std::to_string(descent[1]));
}

}  // namespace

void check_size(std::size_t given, std::size_t known, const char* name) {
  if (given <= sizeof given || given > known)
    throw std::invalid_argument(std::string(name) + ": its size is " + std::to_string(given) +
                                "; set it to sizeof of the struct, which has " + std::to_string(known) +
                                " bytes or, in older versions of the library, fewer");
}

unsnarl_options default_options() {
  const RepairOptions repair;
  const SequenceOptions sequence;
  const CurveOptions curves;
  const SeifertOptions seifert;
  const IsotopyOptions isotopy;
  unsnarl_options options = {};
  options.size = sizeof options;
  // Views of string literals, which end in a zero.
  options.weld = to_string(repair.find.weld).data();
  options.weld_tolerance = repair.find.weld_tolerance;
  options.both_diagonals = repair.find.both_diagonals;
  options.threads = repair.find.threads;
  options.goal = to_string(repair.goal).data();
  options.precision = "auto";
  options.min_gap = repair.min_gap_rel;
  options.gap_near_conflicts = repair.gap_near_conflicts;
  options.max_displacement = repair.max_displacement_rel;
  options.min_dihedral = repair.min_dihedral_deg;
  options.memory_limit = repair.memory_limit_mb;
  options.each_component = repair.each_component;
  options.paper = repair.paper.has_value();
  options.time_limit = repair.time_limit_s;
  options.recover = repair.recover;
  options.first_frame = sequence.first;
  options.last_frame = sequence.last;
  options.gap = curves.gap_rel;
  options.junction = curves.junction_rel;
  options.fix_ends = curves.fix_ends;
  options.move_strands = curves.move_strands;
  options.edge = seifert.edge_rel;
  options.views = seifert.views;
  options.fair = seifert.fair;
  options.points = isotopy.points;
  const PaperOptions paper;
  options.paper_bandwidth = to_string(paper.bandwidth).data();
  options.paper_adaptive = paper.adaptive;
  options.paper_bandwidth_scale = paper.bandwidth_scale;
  options.paper_neighbourhood = paper.neighbourhood;
  options.paper_gaussian = paper.lambda_gaussian;
  options.paper_mesh = paper.lambda_mesh;
  options.paper_mesh_energy = to_string(paper.mesh_energy).data();
  options.paper_whole_polygons = paper.whole_polygons;
  options.paper_arap = paper.lambda_arap;
  options.paper_memory = paper.memory;
  options.paper_iterations = paper.max_iterations;
  options.spacing = RouteOptions().spacing;
  options.handles = seifert.handles;
  const RepairFileOptions files;
  options.keep_partial = files.keep_partial;
  options.no_partial = files.no_partial;
  return options;
}

unsnarl_options options_of(const unsnarl_options* given, Work work) {
  const unsnarl_options defaults = default_options();
  if (given == nullptr) return defaults;
  unsnarl_options options = read(given, "options", defaults);
  if (options.weld == nullptr) options.weld = defaults.weld;
  if (options.goal == nullptr) options.goal = defaults.goal;
  if (options.precision == nullptr) options.precision = defaults.precision;
  if (options.paper_bandwidth == nullptr) options.paper_bandwidth = defaults.paper_bandwidth;
  if (options.paper_mesh_energy == nullptr) options.paper_mesh_energy = defaults.paper_mesh_energy;
  refuse_what_is_not_used(options, work);
  return options;
}

unsnarl_surface surface_of(const unsnarl_surface* given) {
  const unsnarl_surface surface = read(given, "surface");
  if (surface.vertex_count > 0) require(surface.positions, "surface: positions");
  if (surface.corner_count > 0) require(surface.corners, "surface: corners");
  constexpr std::size_t largest = std::numeric_limits<std::int32_t>::max();
  if (surface.vertex_count > largest || surface.corner_count > largest)
    throw std::invalid_argument("surface: more than 2^31 - 1 vertices or corners of faces");
  if (surface.offsets != nullptr && surface.offset_count > 0)
    check_offsets({surface.offsets, surface.offset_count}, surface.corner_count, "face");
  else if (surface.corner_count % 3 != 0)
    throw std::invalid_argument("surface: " + std::to_string(surface.corner_count) +
                                " corners are no triangles; give offsets for faces of other sizes");
  if (surface.mesh_count > 0) require(surface.mesh_sizes, "surface: mesh_sizes");
  return surface;
}

unsnarl_page_content content_of(const unsnarl_page_content* given) {
  return given == nullptr ? unsnarl_page_content{} : read(given, "page_content");
}

unsnarl_curves curves_of(const unsnarl_curves* given, const char* name) {
  const unsnarl_curves curves = read(given, name);
  if (curves.curve_count == 0) return curves;
  require(curves.offsets, "curves: offsets");
  check_offsets({curves.offsets, curves.curve_count + 1}, curves.offsets[curves.curve_count], "curve");
  if (curves.offsets[curves.curve_count] > 0) require(curves.points, "curves: points");
  return curves;
}

FindOptions find_options(const unsnarl_options& options, const unsnarl_surface& surface) {
  return {.weld = named("weld", options.weld, {Weld::none, Weld::seams, Weld::all}),
          .weld_tolerance = options.weld_tolerance,
          .both_diagonals = options.both_diagonals != 0,
          .allowed = allowed_of(surface),
          .threads = options.threads};
}

Goal goal_of(const unsnarl_options& options) {
  return named("goal", options.goal, {Goal::all, Goal::disjoint});
}

RepairOptions frame_options(const unsnarl_options& options, const unsnarl_surface& surface) {
  RepairOptions repair;
  repair.find = find_options(options, surface);
  repair.goal = goal_of(options);
  if (options.precision != std::string_view("auto"))
    repair.precision = named("precision", options.precision, {Precision::float32, Precision::float64});
  repair.min_gap_rel = options.min_gap;
  repair.gap_near_conflicts = options.gap_near_conflicts != 0;
  repair.max_displacement_rel = options.max_displacement;
  repair.time_limit_s = options.time_limit;
  if (surface.fixed != nullptr) repair.fixed.assign(surface.fixed, surface.fixed + surface.vertex_count);
  return repair;
}

RepairOptions repair_options(const unsnarl_options& options, const unsnarl_surface& surface) {
  RepairOptions repair = frame_options(options, surface);
  if (const double diagonal = options.absolute ? diagonal_of(view_of(surface)) : 0; diagonal > 0) {
    repair.min_gap_rel *= 1 / diagonal;
    repair.max_displacement_rel *= 1 / diagonal;
  }
  repair.min_dihedral_deg = options.min_dihedral;
  repair.memory_limit_mb = options.memory_limit;
  repair.recover = options.recover != 0;
  if (options.paper) repair.paper = paper_options(options);
  repair.each_component = options.each_component != 0;
  if (surface.rigid != nullptr) repair.rigid.assign(surface.rigid, surface.rigid + surface.vertex_count);
  if (surface.rigid_names != nullptr)
    repair.rigid_names.assign(surface.rigid_names, surface.rigid_names + surface.rigid_name_count);
  if (surface.document != nullptr) fit_to_files(*surface.document->scene, repair);
  return repair;
}

SurfaceView view_of(const unsnarl_surface& surface) {
  SurfaceView view{{surface.positions, 3 * surface.vertex_count}, {surface.corners, surface.corner_count}};
  if (surface.offsets != nullptr) view.offsets = {surface.offsets, surface.offset_count};
  return view;
}

std::vector<SceneFile> meshes_of(const unsnarl_surface& surface) {
  if (surface.document != nullptr && surface.mesh_count > 0 &&
      surface.mesh_sizes == surface.document->mesh_sizes.data())
    return surface.document->scene->files();
  std::vector<SceneFile> meshes;
  std::size_t vertices = 0, faces = 0;
  for (std::size_t i = 0; i < surface.mesh_count; ++i) {
    const std::size_t* const size = surface.mesh_sizes + 2 * i;
    meshes.push_back({std::to_string(i), vertices, size[0], faces, size[1]});
    vertices += size[0];
    faces += size[1];
  }
  const SurfaceView view = view_of(surface);
  if (!meshes.empty() && (vertices != view.vertex_count() || faces != view.face_count()))
    throw std::invalid_argument("surface: mesh_sizes count " + std::to_string(vertices) + " vertices and " +
                                std::to_string(faces) + " faces; there are " + std::to_string(view.vertex_count()) +
                                " and " + std::to_string(view.face_count()));
  return meshes;
}

Nesting nesting_of(const unsnarl_surface& surface, std::span<const SceneFile> meshes) {
  if (surface.nested == nullptr || surface.nested_count == 0) return {};
  Nesting nesting;
  auto surfaces = static_cast<std::int32_t>(meshes.size());
  if (surface.nested_surface != nullptr) {
    nesting.surface_of_vertex.assign(surface.nested_surface, surface.nested_surface + surface.vertex_count);
    surfaces = 0;
    for (const std::int32_t number : nesting.surface_of_vertex) surfaces = std::max(surfaces, number + 1);
    if (surface.nested_names != nullptr)
      nesting.names.assign(surface.nested_names, surface.nested_names + surface.nested_name_count);
  }
  std::vector<std::vector<std::int32_t>> chains(1);
  for (std::size_t i = 0; i < surface.nested_count; ++i) {
    const std::int32_t mesh = surface.nested[i];
    if (mesh == -1) {
      chains.emplace_back();
    } else if (mesh < 0 || mesh >= surfaces) {
      throw std::invalid_argument("nested: there is no mesh " + std::to_string(mesh) + "; there are " +
                                  std::to_string(surfaces) + ", counted from 0");
    } else {
      chains.back().push_back(mesh);
    }
  }
  if (chains.back().empty()) chains.pop_back();
  if (surface.nested_surface == nullptr) return nesting_of_files(meshes, std::move(chains));
  nesting.chains = std::move(chains);
  return nesting;
}

void check_corners(const SurfaceView& surface) {
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    for (const std::int32_t v : surface.face(f))
      if (v < 0 || static_cast<std::size_t>(v) >= surface.vertex_count())
        throw std::invalid_argument("face " + std::to_string(f) + " uses vertex " + std::to_string(v) +
                                    ", but there are " + std::to_string(surface.vertex_count()));
}

std::vector<Curve> plane_curves(const unsnarl_curves& curves) {
  std::vector<Curve> result(curves.curve_count);
  for (std::size_t c = 0; c < curves.curve_count; ++c) {
    const std::int32_t begin = curves.offsets[c], end = curves.offsets[c + 1];
    result[c].points.assign(curves.points + 2 * begin, curves.points + 2 * end);
    result[c].closed = curves.closed == nullptr || curves.closed[c] != 0;
    if (curves.fixed != nullptr) result[c].fixed.assign(curves.fixed + begin, curves.fixed + end);
  }
  return result;
}

Link link_of(const unsnarl_curves& curves) {
  Link link;
  for (std::size_t c = 0; c < curves.curve_count; ++c)
    link.components.emplace_back(curves.points + 3 * curves.offsets[c], curves.points + 3 * curves.offsets[c + 1]);
  return link;
}

}  // namespace unsnarl::c_interface
