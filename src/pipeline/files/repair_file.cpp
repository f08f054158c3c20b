#include "unsnarl/repair_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "unsnarl/certify.h"
#include "unsnarl/parts.h"
#include "unsnarl/repair_file_steps.h"
#include "unsnarl/stage_clock.h"

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

bool is_to_be_written(const RepairResult& result, const Surface& input, bool keep_partial) {
  switch (result.status) {
    case Status::embedded:
    case Status::allowed:
    case Status::gap_not_met: return true;
    // Nothing to repair but what cannot be: a refusal.
    case Status::obstructed: return result.positions != input.positions;
    default: return keep_partial;
  }
}

/// Was something better than the input reached, which is not what was asked for?
bool is_partial(const RepairResult& result, const Surface& input) {
  switch (result.status) {
    case Status::embedded:
    case Status::allowed:
    case Status::gap_not_met:
    case Status::obstructed:
    case Status::no_progress: return false;
    default: return result.positions != input.positions;
  }
}

/// The promise of the status that what was just written breaks. Empty: none.
std::string broken_promise(const RepairResult& result, Goal goal, const Surface& input, const Surface& read_back,
                           Certifier& certifier) {
  if (read_back.corners != input.corners || read_back.offsets != input.offsets ||
      read_back.positions.size() != input.positions.size())
    return "its faces are not those of the input";
  const Certificate certificate = certifier.certify(read_back.positions);
  if (!certificate.seams_closed) return "a seam that was closed in the input is open";
  const PairCounts &after = certificate.pairs, &before = result.report.before;
  const std::size_t disjoint = after[PairClass::disjoint];
  const bool all = goal == Goal::all;
  if (is_resolved(result.status) && (all ? after.total() : disjoint) > 0)
    return fmt::format("{} pairs of faces intersect", all ? after.total() : disjoint);
  const std::size_t allowed = all ? certificate.allowed.total() : certificate.allowed[PairClass::disjoint];
  if (is_resolved(result.status) && result.status != Status::allowed && allowed > 0)
    return fmt::format("{} pairs of faces intersect that may pass through each other", allowed);
  if (is_resolved(result.status) && all && !certificate.resolved())
    return fmt::format("{} faces have lost their area", certificate.new_zero_area_faces);
  if (disjoint > before[PairClass::disjoint] || (all && after.total() > before.total()))
    return fmt::format("more pairs of faces intersect than in the input: {} instead of {}", after.total(),
                       before.total());
  return {};
}

bool float32_digits(const RepairResult& result) {
  return result.report.precision == Precision::float32;
}

/// Writes all files, with an infix beside the targets, and reads them back.
SceneDocument written_and_read_back(const FilesToRepair& files, const RepairResult& result, const std::string& infix,
                                    StagedFiles& staged) {
  // The files of a scene all have names; what is a link in their folder is replaced.
  const auto links = files.is_scene() ? StagedFiles::Links::replaced : StagedFiles::Links::followed;
  std::vector<Document> documents;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < files.targets.size(); ++i) {
    fs::path main_name;  // in place, external files keep their names
    if (!infix.empty())
      main_name = files.targets[i].filename();
    else if (!files.in_place)
      main_name = files.main_place(i).filename();
    const fs::path place =
        staged.add(with_infix(files.targets[i], infix),
                   files.scene->patched(i, result.positions, float32_digits(result), main_name, infix), links);
    documents.push_back(Document::read(place, files.scene->document(i).format()));
    names.push_back(files.scene->files()[i].name);
  }
  return {std::move(documents), std::move(names)};
}

/// The certificate of the positions is worth nothing if the file says something else. Throws std::logic_error.
void require_kept_promise(const FilesToRepair& files, const RepairResult& result, Goal goal, const Surface& read_back,
                          Certifier& certifier) {
  const std::string broken = broken_promise(result, goal, files.scene->surface(), read_back, certifier);
  if (!broken.empty())
    throw std::logic_error(fmt::format("the written file was removed, because reading it back shows: {}", broken));
}

/// Stages the result, certified as it is read back, and returns the positions read.
std::vector<double> stage_certified(const std::string& infix, const FilesToRepair& files, const RepairResult& result,
                                    Goal goal, Certifier& certifier, StagedFiles& staged) {
  const SceneDocument read_back = written_and_read_back(files, result, infix, staged);
  require_kept_promise(files, result, goal, read_back.surface(), certifier);
  return read_back.surface().positions;
}

/// The bytes of one file, certified as they are parsed again.
std::string certified_bytes(const FilesToRepair& files, const RepairResult& result, Goal goal, Certifier& certifier) {
  std::string bytes = files.scene->patched(0, result.positions, float32_digits(result))[0].bytes;
  const Document read_back = Document::parse(bytes, files.scene->document(0).format());
  require_kept_promise(files, result, goal, read_back.surface(), certifier);
  return bytes;
}

std::vector<fs::path> partial_places(const FilesToRepair& files) {
  std::vector<fs::path> places;
  for (const fs::path& target : files.targets) places.push_back(with_infix(target, files.partial_infix));
  return places;
}

std::vector<std::string> as_texts(const std::vector<fs::path>& paths) {
  std::vector<std::string> texts;
  for (const fs::path& path : paths) texts.push_back(path.string());
  return texts;
}

void stage_whole(const FilesToRepair& files, const RepairFileOptions& options, Certifier& certifier,
                 StagedFiles& staged, RepairedFiles& done) {
  if (files.targets.empty())
    done.bytes = certified_bytes(files, done.result, options.repair.goal, certifier);
  else
    done.positions = stage_certified({}, files, done.result, options.repair.goal, certifier, staged);
  done.written = files.targets;
  done.report.output = files.output.string();
}

void keep_beside(const FilesToRepair& files, const RepairFileOptions& options, Certifier& certifier,
                 StagedFiles& staged, RepairedFiles& done) {
  done.positions = stage_certified(files.partial_infix, files, done.result, options.repair.goal, certifier, staged);
  done.partial = partial_places(files);
  done.report.partial = as_texts(done.partial);
}

/// What a report says of the files around a call.
void describe(const FilesToRepair& files, ReportFiles& report) {
  const SurfaceView surface = files.scene->surface();
  if (!files.is_scene()) {
    report.input = files.inputs[0].string();
    report.format = to_string(files.scene->document(0).format());
  }
  report.vertices = surface.vertex_count();
  report.faces = surface.face_count();
  report.notes = files.notes;
}

/// Components by the names that the files give to their faces.
void name_components(const SceneDocument& scene, RepairReport& report) {
  for (auto& component : report.overlapping_components)
    component.name = part_of_face(scene.face_labels(), component.first_face);
  for (auto& component : report.changed_components)
    component.name = part_of_face(scene.face_labels(), component.first_face);
}

/// Pairs by file, what lies inside what, as read back.
void describe_result(const FilesToRepair& files, const RepairFileOptions& options, Certifier& certifier,
                     RepairedFiles& done) {
  const Surface& before = files.scene->surface();
  if (!files.is_scene() && options.nesting.chains.empty()) return;
  const std::vector<IntersectingPair> after = certifier.find_intersections(done.positions);
  if (!options.nesting.chains.empty())
    done.report.nested = nested_pairs(before, done.positions, after, options.nesting, options.repair.find);
  if (!files.is_scene()) return;
  SceneReport& scene = done.report.scene;
  scene =
      scene_report(before, files.scene->files(), certifier.find_intersections(before.positions), done.positions, after);
  count_allowed_pairs(certifier.find_allowed_pairs(before.positions), certifier.find_allowed_pairs(done.positions),
                      scene);
  for (std::size_t i = 0; i < files.inputs.size(); ++i) {
    scene.files[i].input = files.inputs[i].string();
    scene.files[i].format = to_string(files.scene->document(i).format());
    if (done.is_written()) scene.files[i].output = files.targets[i].string();
  }
}

RepairResult repaired(const SurfaceView& surface, const RepairFileOptions& options, Context* context) {
  return options.nesting.chains.empty() ? repair(surface, options.repair, context)
                                        : repair_nested(surface, options.nesting, options.repair, context);
}

void recompute_normals(FilesToRepair& files) {
  if (files.scene->recompute_normals()) return;
  std::string names;
  for (const SceneFile& file : files.scene->files()) names += (names.empty() ? "" : ", ") + file.name;
  files.notes.push_back(fmt::format("recompute_normals: there are no vertex normals in {} to update", names));
}

}  // namespace

RepairedFiles stage_result(const FilesToRepair& files, RepairResult result, const RepairFileOptions& options,
                           StagedFiles& staged) {
  const StageClock clock;
  const bool is_written = is_to_be_written(result, files.scene->surface(), options.keep_partial);
  const bool is_kept = !is_written && !files.partial_infix.empty() && is_partial(result, files.scene->surface());
  RepairedFiles done;
  done.positions = result.positions;
  done.result = std::move(result);
  describe(files, done.report);
  name_components(*files.scene, done.result.report);
  if (is_written || is_kept || files.is_scene() || !options.nesting.chains.empty()) {
    Certifier certifier(files.scene->surface(), options.repair.find);
    if (is_written) stage_whole(files, options, certifier, staged, done);
    if (is_kept) keep_beside(files, options, certifier, staged, done);
    describe_result(files, options, certifier, done);
  }
  done.report.after_repair.push_back(clock.stage("write"));
  return done;
}

std::vector<double> stage_result_as(const std::string& infix, const FilesToRepair& files, const RepairResult& result,
                                    const RepairFileOptions& options, StagedFiles& staged) {
  Certifier certifier(files.scene->surface(), options.repair.find);
  return stage_certified(infix, files, result, options.repair.goal, certifier, staged);
}

Document stage_document(const Document& document, std::span<const double> positions, bool float32,
                        const fs::path& target, StagedFiles& staged) {
  return Document::read(staged.add(target, document.patched(positions, float32, target.filename())), document.format());
}

void put_in_place(const FilesToRepair& files, const RepairResult& result, const RepairFileOptions& options,
                  StagedFiles& staged) {
  try {
    staged.commit();
  } catch (const ChangedMeanwhile& changed) {
    if (files.partial_infix.empty()) throw;
    StagedFiles beside(staged.guard());
    stage_result_as(files.partial_infix, files, result, options, beside);
    beside.commit();
    throw WriteError(
        fmt::format("{}; the result is in {}", changed.what(), fmt::join(as_texts(partial_places(files)), ", ")));
  }
}

void measure_clearances(const FilesToRepair& files, const RepairOptions& options, RepairedFiles& done) {
  const Surface& input = files.scene->surface();
  const auto measured = [&](std::span<const double> positions, std::size_t pairs) {
    return measure_clearance(input, positions, options.find, pairs == 0);
  };
  const RepairReport& report = done.result.report;
  done.report.clearance_before = measured(input.positions, report.before.total());
  if (!done.is_written()) return;
  const std::vector<double> written = files.scene->as_written(done.result.positions, float32_digits(done.result));
  done.report.clearance_after =
      written == input.positions ? done.report.clearance_before : measured(written, report.after.total());
}

RepairedFiles repair_files(FilesToRepair files, RepairFileOptions options, Context* context) {
  const StageClock clock;
  fit_to_files(*files.scene, options.repair);
  // A folder that is missing or must not be written to is found now rather than after the work.
  std::optional<OutputFolder> made;
  if (files.is_scene()) made.emplace(files.output);
  require_writable(files);
  check_places(files, options.no_partial);

  RepairResult result = repaired(files.scene->surface(), options, context);
  StagedFiles staged;
  RepairedFiles done = stage_result(files, std::move(result), options, staged);
  put_in_place(files, done.result, options, staged);
  done.report.whole = clock.stage("fix");
  return done;
}

RepairedFiles repair_files(const std::vector<fs::path>& in, const fs::path& folder, const RepairFileOptions& given,
                           Context* context) {
  const StageClock clock;
  RepairFileOptions options = given;
  FilesToRepair files =
      files_to_repair(std::make_shared<SceneDocument>(read_scene(in, options.format)), in, folder, options);
  if (options.recompute_normals) recompute_normals(files);
  if (options.when_read) options.when_read(*files.scene, options);
  const StageReport reading = clock.stage("read");
  RepairedFiles done = repair_files(std::move(files), std::move(options), context);
  done.report.before_repair.push_back(reading);
  done.report.whole = clock.stage("fix");
  return done;
}

RepairedFiles repair_file(const fs::path& in, const fs::path& out, const RepairFileOptions& options, Context* context) {
  if (out.empty() && !options.in_place)
    throw std::invalid_argument("there is no output; name a file, or overwrite the input with in_place");
  return repair_files({in}, out, options, context);
}

}  // namespace unsnarl
