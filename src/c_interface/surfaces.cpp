#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>

#include "arguments.h"
#include "errors.h"
#include "handles.h"
#include "results.h"
#include "unsnarl/certify.h"
#include "unsnarl/check.h"
#include "unsnarl/clearance.h"
#include "unsnarl/nesting.h"
#include "unsnarl/parts.h"
#include "unsnarl/report_json.h"
#include "unsnarl/sequence.h"
#include "unsnarl/stage_clock.h"

namespace unsnarl::c_interface {
namespace {

Json by_kind(const PairCounts& counts) {
  return Json::parse(pairs_json(counts))["by_class"];
}

/// The report's entries on files: of the one that was read, or of each of several.
void describe_document(const unsnarl_surface& given, ReportFiles& files) {
  if (given.document == nullptr) return;
  const SceneDocument& scene = *given.document->scene;
  files.notes = scene.notes();
  files.parts = named_parts(scene.surface(), scene.face_labels());
  if (scene.files().size() > 1) return;
  files.input = given.document->paths[0].string();
  files.format = to_string(scene.document(0).format());
}

/// What a report says of each of several files.
void describe_scene_files(const unsnarl_surface& given, SceneReport& report) {
  if (given.document == nullptr || report.files.size() != given.document->paths.size()) return;
  for (std::size_t i = 0; i < report.files.size(); ++i) {
    report.files[i].input = given.document->paths[i].string();
    report.files[i].format = to_string(given.document->scene->document(i).format());
  }
}

void add_pairs(unsnarl_result& result, const std::vector<IntersectingPair>& pairs) {
  std::vector<std::int32_t> faces;
  std::vector<std::uint8_t> kinds;
  faces.reserve(2 * pairs.size());
  kinds.reserve(pairs.size());
  for (const IntersectingPair& pair : pairs) {
    faces.insert(faces.end(), {pair.a, pair.b});
    kinds.push_back(static_cast<std::uint8_t>(pair.kind));
  }
  result.arrays["pairs"] = {std::move(faces), 2};
  result.arrays["kinds"] = {std::move(kinds), 1};
}

/// Components by the names that the files give to their faces.
void name_components(const unsnarl_surface& given, CheckReport& report) {
  if (given.document == nullptr) return;
  for (OverlappingComponent& component : report.overlapping_components)
    component.name = part_of_face(given.document->scene->face_labels(), component.first_face);
}

unsnarl_result checked(const unsnarl_surface& given, const unsnarl_options& options) {
  const SurfaceView surface = view_of(given);
  const FindOptions find = find_options(options, given);
  CheckReport report = check(surface, find);
  name_components(given, report);
  ReportFiles files;
  files.vertices = surface.vertex_count();
  files.faces = surface.face_count();
  describe_document(given, files);
  if (const std::vector<SceneFile> meshes = meshes_of(given); !meshes.empty()) {
    files.scene = scene_report(surface, meshes, report.pairs);
    count_allowed_pairs(report.allowed_pairs, {}, files.scene);
    describe_scene_files(given, files.scene);
  }
  unsnarl_result found;
  add_pairs(found, report.pairs);
  found.report = check_json(report, goal_of(options), find, files);
  return found;
}

unsnarl_result repaired(const unsnarl_surface& given, const unsnarl_options& given_options, Context* context) {
  const StageClock clock;
  const SurfaceView surface = view_of(given);
  const RepairOptions options = repair_options(given_options, given);
  const std::vector<SceneFile> meshes = meshes_of(given);
  const Nesting nesting = nesting_of(given, meshes);
  RepairResult repaired =
      nesting.chains.empty() ? repair(surface, options, context) : repair_nested(surface, nesting, options, context);

  ReportFiles files;
  files.vertices = surface.vertex_count();
  files.faces = surface.face_count();
  describe_document(given, files);
  if (!meshes.empty()) {
    Certifier certifier(surface, options.find);
    const std::vector<IntersectingPair> after = certifier.find_intersections(repaired.positions);
    files.scene =
        scene_report(surface, meshes, certifier.find_intersections(surface.positions), repaired.positions, after);
    count_allowed_pairs(certifier.find_allowed_pairs(surface.positions),
                        certifier.find_allowed_pairs(repaired.positions), files.scene);
    describe_scene_files(given, files.scene);
  }
  if (!nesting.chains.empty()) {
    Certifier certifier(surface, options.find);
    files.nested = nested_pairs(surface, repaired.positions, certifier.find_intersections(repaired.positions), nesting,
                                options.find);
  }
  files.clearance_before =
      measure_clearance(surface, surface.positions, options.find, repaired.report.before.total() == 0);
  const bool float32 = repaired.report.precision == Precision::float32;
  const std::vector<double> written =
      options.as_written ? options.as_written(repaired.positions, float32) : repaired.positions;
  const bool is_unchanged = std::equal(written.begin(), written.end(), surface.positions.begin());
  files.clearance_after = is_unchanged
                              ? files.clearance_before
                              : measure_clearance(surface, written, options.find, repaired.report.after.total() == 0);
  files.whole = clock.stage("repair");
  RepairFileOptions asked;
  asked.repair = options;
  return result_of_repair(std::move(repaired), std::move(asked), files);
}

/// The status of a sequence: that of the first frame that has something left, else of an allowed one, else of one whose
/// gap is not met. `all`: no frame is missing.
Status status_of(std::span<const FrameReport> reports, bool all) {
  for (const FrameReport& frame : reports)
    if (!is_resolved(frame.status)) return frame.status;
  if (!all) return Status::cancelled;
  const auto is_any = [&](Status status) {
    return std::any_of(reports.begin(), reports.end(),
                       [&](const FrameReport& frame) { return frame.status == status; });
  };
  for (const Status status : {Status::allowed, Status::gap_not_met})
    if (is_any(status)) return status;
  return Status::embedded;
}

unsnarl_result repaired_sequence(const unsnarl_surface& given, std::size_t frame_count,
                                 const unsnarl_options& given_options, Context* context) {
  const std::size_t size = 3 * given.vertex_count;
  const std::span<const double> frames(given.positions, size * frame_count);
  SequenceOptions options;
  options.first = given_options.first_frame;
  options.last = std::min(given_options.last_frame, frame_count);
  if (options.first > options.last)
    throw std::invalid_argument("first_frame is " + std::to_string(options.first) + ", last_frame " +
                                std::to_string(options.last) + " (excluded), of " + std::to_string(frame_count));
  if (given.nested != nullptr) throw std::invalid_argument("surface: nested is not of sequences; repair single frames");
  if (given.rigid != nullptr)
    throw std::invalid_argument(
        "surface: rigid is not of sequences; repair single frames, or hold these parts by fixed");
  options.repair = frame_options(given_options, given);
  SequenceSource source;
  const SurfaceView surface = view_of(given);
  source.corners = surface.corners;
  source.offsets = surface.offsets;
  source.frames = frame_count;
  source.positions = [&](std::size_t t) {
    const auto frame = frames.subspan(t * size, size);
    return std::vector<double>(frame.begin(), frame.end());
  };
  const auto wanted = frames.subspan(options.first * size, (options.last - options.first) * size);
  std::vector<double> positions(wanted.begin(), wanted.end());
  const auto take = [&](FrameResult&& frame) {
    const std::size_t begin = (frame.report.frame - options.first) * size;
    std::copy(frame.positions.begin(), frame.positions.end(), positions.begin() + static_cast<std::ptrdiff_t>(begin));
  };
  const std::vector<FrameReport> reports = repair_sequence(source, options, take, context);

  unsnarl_result result;
  const bool all_reached = reports.size() == options.last - options.first;
  result.status = to_string(status_of(reports, all_reached));
  for (const FrameReport& frame : reports) result.report += (result.report.empty() ? "[" : ",") + frame_json(frame);
  result.report += result.report.empty() ? "[]" : "]";
  result.arrays["positions"] = {std::move(positions), 3};
  return result;
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_find_intersections(const unsnarl_surface* surface, const unsnarl_options* options,
                               unsnarl_result** result) {
  return hand_out(result, [&] {
    const unsnarl_surface given = surface_of(surface);
    const std::vector<IntersectingPair> pairs =
        find_intersections(view_of(given), find_options(options_of(options, Work::search), given));
    unsnarl_result found;
    found.report = by_kind(count_by_class(pairs)).dump();
    add_pairs(found, pairs);
    return found;
  });
}

int unsnarl_check(const unsnarl_surface* surface, const unsnarl_options* options, unsnarl_result** result) {
  return hand_out(result, [&] { return checked(surface_of(surface), options_of(options, Work::search)); });
}

const char* unsnarl_pair_kind(int kind) {
  const bool is_one = kind >= 0 && static_cast<std::size_t>(kind) < pair_class_count;
  return is_one ? pair_class_names[static_cast<std::size_t>(kind)].data() : nullptr;
}

int unsnarl_certify(const unsnarl_surface* surface, const double* moved, size_t moved_count,
                    const unsnarl_options* options, unsnarl_result** result) {
  return hand_out(result, [&] {
    if (moved_count > 0) require(moved, "moved");
    const unsnarl_surface given = surface_of(surface);
    const Certificate certificate =
        certify(view_of(given), {moved, 3 * moved_count}, find_options(options_of(options, Work::search), given));
    unsnarl_result found;
    found.report =
        Json{{"embedded", certificate.embedded()},       {"float32_embedded", certificate.float32_embedded()},
             {"pairs", by_kind(certificate.pairs)},      {"pairs_float32", by_kind(*certificate.pairs_float32)},
             {"allowed", by_kind(certificate.allowed)},  {"new_zero_area_faces", certificate.new_zero_area_faces},
             {"seams_closed", certificate.seams_closed}, {"resolved", certificate.resolved()}}
            .dump();
    return found;
  });
}

int unsnarl_repair(const unsnarl_surface* surface, const unsnarl_options* options, unsnarl_context* context,
                   unsnarl_result** result) {
  return hand_out(
      result, [&] { return repaired(surface_of(surface), options_of(options, Work::repair), context_of(context)); });
}

int unsnarl_repair_sequence(const unsnarl_surface* surface, size_t frame_count, const unsnarl_options* options,
                            unsnarl_context* context, unsnarl_result** result) {
  return hand_out(result, [&] {
    return repaired_sequence(surface_of(surface), frame_count, options_of(options, Work::sequence),
                             context_of(context));
  });
}

int unsnarl_component_of_faces(const unsnarl_surface* surface, const unsnarl_options* options,
                               unsnarl_result** result) {
  return hand_out(result, [&] {
    unsnarl_result found;
    found.arrays["components"] = {
        component_of_faces(view_of(surface_of(surface)), find_options(options_of(options, Work::search)))};
    return found;
  });
}

int unsnarl_boundary_vertices(const unsnarl_surface* surface, const unsnarl_options* options, unsnarl_result** result) {
  return hand_out(result, [&] {
    unsnarl_result found;
    found.arrays["vertices"] = {
        boundary_vertices(view_of(surface_of(surface)), find_options(options_of(options, Work::search)))};
    return found;
  });
}

int unsnarl_vertices_of_faces(const unsnarl_surface* surface, const uint8_t* faces, size_t face_count,
                              unsnarl_result** result) {
  return hand_out(result, [&] {
    const SurfaceView view = view_of(surface_of(surface));
    check_corners(view);
    if (face_count != view.face_count())
      throw std::invalid_argument("there are " + std::to_string(face_count) + " flags for " +
                                  std::to_string(view.face_count()) + " faces");
    if (face_count > 0) require(faces, "faces");
    unsnarl_result found;
    found.arrays["vertices"] = {vertices_of_faces(view, {faces, face_count})};
    return found;
  });
}
