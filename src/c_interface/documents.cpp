#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <iterator>

#include "arguments.h"
#include "results.h"
#include "unsnarl/parts.h"
#include "unsnarl/paths.h"
#include "unsnarl/repair_file_steps.h"
#include "unsnarl/stage_clock.h"
#include "unsnarl/staged_files.h"

namespace unsnarl::c_interface {
namespace {

namespace fs = std::filesystem;

std::optional<Format> format_of(const char* name) {
  if (name == nullptr) return std::nullopt;
  const std::optional<Format> format = format_from_extension(name);
  if (!format) throw std::invalid_argument("format is '" + std::string(name) + "'; choose one of " + format_names());
  return format;
}

std::unique_ptr<unsnarl_document> read(std::vector<fs::path> paths, std::optional<Format> format) {
  auto read = std::make_shared<SceneDocument>(read_scene(paths, format));
  const SceneDocument& scene = *read;
  std::vector<std::size_t> mesh_sizes;
  if (paths.size() > 1)
    for (const SceneFile& file : scene.files()) mesh_sizes.insert(mesh_sizes.end(), {file.vertices, file.faces});
  const SurfaceView surface = scene.surface();
  const Json json = {{"format", to_string(scene.document(0).format())},
                     {"vertices", surface.vertex_count()},
                     {"faces", surface.face_count()},
                     {"notes", scene.notes()}};
  // Notes quote the file, whose bytes need not be UTF-8.
  std::string report = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return std::unique_ptr<unsnarl_document>(
      new unsnarl_document{std::move(paths), std::move(read), std::move(mesh_sizes), std::move(report), {}});
}

/// The document's files, to be written to this place: a file, which may be the input; of several their folder.
FilesToRepair files_for(const unsnarl_document& input, const fs::path& place) {
  std::error_code ignored;
  RepairFileOptions options;
  options.in_place = input.paths.size() == 1 && fs::equivalent(place, input.paths[0], ignored);
  return files_to_repair(input.scene, input.paths, options.in_place ? fs::path() : place, options);
}

/// Throws where files cannot be written to `place`.
FilesToRepair writable_files(const unsnarl_document& input, const fs::path& place) {
  FilesToRepair files = files_for(input, place);
  std::error_code error;
  if (files.is_scene() && !fs::is_directory(place, error))
    throw WriteError(place.string() + ": there is no such folder; several files need one to go to", ENOENT);
  require_writable(files);
  check_places(files);
  return files;
}

/// The repair that `repaired` came from, with its positions.
RepairResult result_of(const unsnarl_document& document, const unsnarl_result& repaired) {
  if (!repaired.repaired) throw std::invalid_argument("repaired is no result of unsnarl_repair");
  RepairResult result = repaired.repaired->result;
  result.positions = std::get<std::vector<double>>(repaired.arrays.at("positions").values);
  if (result.positions.size() != document.scene->surface().positions.size())
    throw std::invalid_argument("repaired is of another mesh: " + std::to_string(result.positions.size() / 3) +
                                " vertices, where the document has " +
                                std::to_string(document.scene->surface().view().vertex_count()));
  return result;
}

void write(const unsnarl_document& input, const unsnarl_result& repaired, const fs::path& place) {
  const RepairResult result = result_of(input, repaired);
  const FilesToRepair files = writable_files(input, place);
  StagedFiles staged;
  stage_result_as({}, files, result, repaired.repaired->options, staged);
  put_in_place(files, result, repaired.repaired->options, staged);
}

/// Beside the targets, where nothing is that was read. Returns the places.
std::vector<std::string> write_partial(const unsnarl_document& input, const unsnarl_result& repaired,
                                       const fs::path& place) {
  const RepairResult result = result_of(input, repaired);
  FilesToRepair files = files_for(input, place);
  check_places(files);
  StagedFiles staged;
  stage_result_as(files.partial_infix, files, result, repaired.repaired->options, staged);
  staged.commit();
  std::vector<std::string> places;
  for (const fs::path& target : files.targets) places.push_back(with_infix(target, files.partial_infix).string());
  return places;
}

unsnarl_result repaired_document(unsnarl_document& document, const unsnarl_surface& surface, const char* path,
                                 const unsnarl_options& given, Context* context) {
  const StageClock clock;
  if (surface.document != &document)
    throw std::invalid_argument("surface is not that of the document; give what unsnarl_document_surface sets");
  RepairFileOptions options;
  options.repair = repair_options(given, surface);
  options.nesting = nesting_of(surface, meshes_of(surface));
  options.in_place = path == nullptr;
  options.keep_partial = given.keep_partial != 0;
  options.no_partial = given.no_partial != 0;
  const fs::path output = options.in_place ? fs::path() : path_of(path);
  const FilesToRepair files = files_to_repair(document.scene, document.paths, output, options);
  RepairedFiles done = repair_files(files, options, context);
  measure_clearances(files, options.repair, done);
  done.report.whole = clock.stage("fix");
  document.partial.clear();
  for (const fs::path& place : done.partial) document.partial.push_back(place.string());
  return result_of_repair(std::move(done.result), std::move(options), done.report);
}

/// The parts of one kind and name. Throws std::invalid_argument.
Parts parts_of(const std::string& kind, const std::string& name) {
  if (kind == "object") return {.objects = {name}};
  if (kind == "group") return {.groups = {name}};
  if (kind == "material") return {.materials = {name}};
  if (kind == "file") return {.files = {name}};
  if (kind != "component")
    throw std::invalid_argument("kind is '" + kind + "'; choose object, group, material, component or file");
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size())
    throw std::invalid_argument("'" + name + "' is no number of a component; they count from 0");
  return {.components = {number}};
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_document_read(const char* path, const char* format, unsnarl_document** document) {
  return guarded([&] {
    require(path, "path");
    require(document, "document");
    *document = read({path_of(path)}, format_of(format)).release();
  });
}

int unsnarl_document_read_scene(const char* const* paths, size_t path_count, const char* format,
                                unsnarl_document** document) {
  return guarded([&] {
    require(paths, "paths");
    require(document, "document");
    if (path_count == 0) throw std::invalid_argument("there are no paths; give those of the files of the scene");
    for (std::size_t i = 0; i < path_count; ++i) require(paths[i], "paths[i]");
    std::vector<fs::path> files;
    for (std::size_t i = 0; i < path_count; ++i) files.push_back(path_of(paths[i]));
    *document = read(std::move(files), format_of(format)).release();
  });
}

int unsnarl_document_surface(const unsnarl_document* document, unsnarl_surface* surface) {
  return guarded([&] {
    require(document, "document");
    require(surface, "surface");
    check_size(surface->size, sizeof(unsnarl_surface), "surface");
    const Surface& stored = document->scene->surface();
    unsnarl_surface all = {};
    all.size = surface->size;
    all.positions = stored.positions.data();
    all.vertex_count = stored.positions.size() / 3;
    all.corners = stored.corners.data();
    all.corner_count = stored.corners.size();
    if (!stored.offsets.empty()) {
      all.offsets = stored.offsets.data();
      all.offset_count = stored.offsets.size();
    }
    if (!document->mesh_sizes.empty()) {
      all.mesh_sizes = document->mesh_sizes.data();
      all.mesh_count = document->mesh_sizes.size() / 2;
    }
    all.document = document;
    std::memcpy(surface, &all, surface->size);
  });
}

const char* unsnarl_document_report(const unsnarl_document* document) {
  return document->report.c_str();
}

int unsnarl_document_faces(const unsnarl_document* document, const char* kind, const char* name,
                           const unsnarl_options* options, unsnarl_result** result) {
  return hand_out(result, [&] {
    require(document, "document");
    require(kind, "kind");
    require(name, "name");
    const SceneDocument& scene = *document->scene;
    unsnarl_result found;
    found.arrays["faces"] = {faces_in_parts(scene.surface(), scene.face_labels(), parts_of(kind, name),
                                            find_options(options_of(options, Work::search)))};
    return found;
  });
}

int unsnarl_document_allowed(const unsnarl_document* document, const char* const* rules, size_t rule_count,
                             const unsnarl_options* options, unsnarl_result** result) {
  return hand_out(result, [&] {
    require(document, "document");
    if (rule_count > 0) require(rules, "rules");
    for (std::size_t i = 0; i < rule_count; ++i) require(rules[i], "rules[i]");
    const SceneDocument& scene = *document->scene;
    const std::vector<std::string> texts(rules, rules + rule_count);
    AllowedPairs allowed =
        allowed_pairs(scene.surface(), scene.face_labels(), texts, find_options(options_of(options, Work::search)));
    std::vector<std::int32_t> pairs;
    for (const auto& pair : allowed.parts) pairs.insert(pairs.end(), pair.begin(), pair.end());
    unsnarl_result found;
    found.arrays["face_parts"] = {std::move(allowed.part_of_face)};
    found.arrays["allowed"] = {std::move(pairs), 2};
    return found;
  });
}

int unsnarl_document_recompute_normals(unsnarl_document* document, int32_t* is_any) {
  return guarded([&] {
    require(document, "document");
    require(is_any, "is_any");
    *is_any = document->scene->recompute_normals();
  });
}

int unsnarl_document_check_output(const unsnarl_document* document, const char* path) {
  return guarded([&] {
    require(document, "document");
    require(path, "path");
    writable_files(*document, path_of(path));
  });
}

int unsnarl_document_write(const unsnarl_document* document, const unsnarl_result* repaired, const char* path) {
  return guarded([&] {
    require(document, "document");
    require(repaired, "repaired");
    require(path, "path");
    write(*document, *repaired, path_of(path));
  });
}

int unsnarl_document_write_partial(unsnarl_document* document, const unsnarl_result* repaired, const char* path) {
  return guarded([&] {
    require(document, "document");
    require(repaired, "repaired");
    require(path, "path");
    document->partial = write_partial(*document, *repaired, path_of(path));
  });
}

int unsnarl_document_repair(unsnarl_document* document, const unsnarl_surface* surface, const char* path,
                            const unsnarl_options* options, unsnarl_context* context, unsnarl_result** result) {
  return hand_out(result, [&] {
    require(document, "document");
    return repaired_document(*document, surface_of(surface), path, options_of(options, Work::document),
                             context_of(context));
  });
}

const char* unsnarl_document_partial(const unsnarl_document* document, size_t file) {
  return file < document->partial.size() ? document->partial[file].c_str() : nullptr;
}

void unsnarl_document_free(unsnarl_document* document) {
  delete document;
}
