#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <iterator>

#include "arguments.h"
#include "results.h"
#include "unsnarl/parts.h"
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

/// The names by which files of a scene are told apart and written back.
std::vector<std::string> names_of(const std::vector<fs::path>& paths) {
  std::vector<std::string> names;
  for (const fs::path& path : paths) {
    names.push_back(path.filename().string());
    const auto same = std::find(names.begin(), names.end() - 1, names.back());
    if (same != names.end() - 1)
      throw std::invalid_argument(paths[static_cast<std::size_t>(same - names.begin())].string() + " and " +
                                  path.string() + " have the same name, under which both would be written; rename one");
  }
  return names;
}

std::unique_ptr<unsnarl_document> read(std::vector<fs::path> paths, std::optional<Format> format) {
  const std::vector<std::string> names = names_of(paths);
  std::vector<Document> documents;
  for (const fs::path& path : paths) documents.push_back(Document::read(path, format));
  SceneDocument scene(std::move(documents), names);
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
      new unsnarl_document{std::move(paths), std::move(scene), std::move(mesh_sizes), std::move(report), {}});
}

bool is_one_file(const unsnarl_document& input) {
  return input.paths.size() == 1;
}

/// The path that file i of the input is written to. `place`: the file, or the folder of several files.
fs::path target_of(const unsnarl_document& input, std::size_t i, const fs::path& place) {
  return is_one_file(input) ? place : place / input.paths[i].filename();
}

/// The name that Document::patched() derives those of the files beside the main one from; empty where the input is
/// overwritten.
fs::path main_name(const unsnarl_document& input, std::size_t i, const fs::path& target) {
  std::error_code ignored;
  return fs::equivalent(target, input.paths[i], ignored) ? fs::path() : target.filename();
}

/// All files that are read: the main ones, and those that hold numbers for them.
std::vector<fs::path> files_read(const unsnarl_document& input) {
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < input.paths.size(); ++i)
    for (const OutputFile& file : input.scene.patched(i, input.scene.surface().positions, true))
      files.push_back(file.name.empty() ? input.paths[i] : input.paths[i].parent_path() / file.name);
  return files;
}

/// Throws where files of several would overwrite one another, or the input.
void require_places_apart(const unsnarl_document& input, const fs::path& place) {
  const std::vector<fs::path> read = files_read(input);
  std::vector<fs::path> written;
  for (std::size_t i = 0; i < input.paths.size(); ++i) {
    const fs::path target = target_of(input, i, place), name = main_name(input, i, target);
    if (name.empty() && is_one_file(input)) return;
    for (const OutputFile& file : input.scene.patched(i, input.scene.surface().positions, true, name)) {
      const fs::path at = file.name.empty() ? target : target.parent_path() / file.name;
      std::error_code ignored;
      for (const fs::path& other : read)
        if (fs::equivalent(at, other, ignored))
          throw std::invalid_argument(at.string() +
                                      " holds part of the input and would be overwritten; write to another folder");
      if (std::find(written.begin(), written.end(), at) != written.end())
        throw std::invalid_argument(at.string() + " would be written for two of the files; rename one of them");
      written.push_back(at);
    }
  }
}

/// Throws where no file can be made in it.
void require_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw WriteError(folder.string() + ": there is no such folder; several files need one to go to", ENOENT);
}

void require_target(const unsnarl_document& input, const fs::path& place) {
  const Document& document = input.scene.document(0);
  if (const auto format = format_from_extension(place.string());
      is_one_file(input) && format && *format != document.format())
    throw std::invalid_argument(place.string() + ": the result keeps the format of the input, " +
                                std::string(to_string(document.format())));
  if (!is_one_file(input)) require_folder(place);
  for (std::size_t i = 0; i < input.paths.size(); ++i) {
    const fs::path target = target_of(input, i, place);
    std::vector<fs::path> beside;
    for (const OutputFile& file :
         input.scene.patched(i, input.scene.surface().positions, true, main_name(input, i, target)))
      if (!file.name.empty()) beside.push_back(file.name);
    StagedFiles().open_beside(target, beside);
  }
  require_places_apart(input, place);
}

/// Adds all files of a result, with an infix beside the targets, and reads them back.
void add(StagedFiles& staged, const unsnarl_document& input, const unsnarl_result& repaired, const fs::path& place,
         const std::string& infix = {}) {
  const auto& positions = std::get<std::vector<double>>(repaired.arrays.at("positions").values);
  const bool float32 = *repaired.precision == Precision::float32;
  const std::vector<double> expected = input.scene.as_written(positions, float32);
  const auto links = is_one_file(input) ? StagedFiles::Links::followed : StagedFiles::Links::replaced;
  for (std::size_t i = 0; i < input.paths.size(); ++i) {
    const fs::path target = target_of(input, i, place);
    const fs::path name = infix.empty() ? main_name(input, i, target) : target.filename();
    const fs::path written =
        staged.add(with_infix(target, infix), input.scene.patched(i, positions, float32, name, infix), links);
    const std::span<const double> own = input.scene.positions_of(i, expected);
    if (!std::ranges::equal(own, Document::read(written, input.scene.document(i).format()).surface().positions))
      throw std::logic_error(target.string() + " would not give back the positions that were to be written to it");
  }
}

/// Beside the targets, where nothing is that was read. Returns the places.
std::vector<std::string> write_partial(const unsnarl_document& input, const unsnarl_result& repaired,
                                       const fs::path& place) {
  const std::vector<fs::path> read = files_read(input);
  const auto is_free = [&](const fs::path& at) {
    std::error_code ignored;
    return can_be_replaced(at) && std::none_of(read.begin(), read.end(),
                                               [&](const fs::path& file) { return fs::equivalent(at, file, ignored); });
  };
  std::vector<std::string> places;
  std::string infix = partial_infix;
  for (int number = 2; places.size() < input.paths.size(); ++number) {
    places.clear();
    for (std::size_t i = 0; i < input.paths.size(); ++i)
      if (const fs::path at = with_infix(target_of(input, i, place), infix); is_free(at)) places.push_back(at.string());
    if (places.size() < input.paths.size()) infix = std::string(partial_infix) + "." + std::to_string(number);
  }
  StagedFiles staged;
  add(staged, input, repaired, place, infix);
  staged.commit();
  return places;
}

void write(const unsnarl_document& input, const unsnarl_result& repaired, const fs::path& place) {
  require_target(input, place);
  StagedFiles staged;
  add(staged, input, repaired, place);
  try {
    staged.commit();
  } catch (const ChangedMeanwhile& changed) {
    throw WriteError(std::string(changed.what()) + "; the result is in " + write_partial(input, repaired, place)[0]);
  }
}

void require_repaired(const unsnarl_document& document, const unsnarl_result& repaired) {
  if (!repaired.precision) throw std::invalid_argument("repaired is no result of unsnarl_repair");
  const auto& positions = std::get<std::vector<double>>(repaired.arrays.at("positions").values);
  if (positions.size() != document.scene.surface().positions.size())
    throw std::invalid_argument("repaired is of another mesh: " + std::to_string(positions.size() / 3) +
                                " vertices, where the document has " +
                                std::to_string(document.scene.surface().view().vertex_count()));
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
    *document = read({path}, format_of(format)).release();
  });
}

int unsnarl_document_read_scene(const char* const* paths, size_t path_count, const char* format,
                                unsnarl_document** document) {
  return guarded([&] {
    require(paths, "paths");
    require(document, "document");
    if (path_count == 0) throw std::invalid_argument("there are no paths; give those of the files of the scene");
    for (std::size_t i = 0; i < path_count; ++i) require(paths[i], "paths[i]");
    *document = read({paths, paths + path_count}, format_of(format)).release();
  });
}

int unsnarl_document_surface(const unsnarl_document* document, unsnarl_surface* surface) {
  return guarded([&] {
    require(document, "document");
    require(surface, "surface");
    check_size(surface->size, sizeof(unsnarl_surface), "surface");
    const Surface& stored = document->scene.surface();
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
    const SceneDocument& scene = document->scene;
    unsnarl_result found;
    found.arrays["faces"] = {
        faces_in_parts(scene.surface(), scene.face_labels(), parts_of(kind, name), find_options(options_of(options)))};
    return found;
  });
}

int unsnarl_document_recompute_normals(unsnarl_document* document, int32_t* is_any) {
  return guarded([&] {
    require(document, "document");
    require(is_any, "is_any");
    *is_any = document->scene.recompute_normals();
  });
}

int unsnarl_document_check_output(const unsnarl_document* document, const char* path) {
  return guarded([&] {
    require(document, "document");
    require(path, "path");
    require_target(*document, path);
  });
}

int unsnarl_document_write(const unsnarl_document* document, const unsnarl_result* repaired, const char* path) {
  return guarded([&] {
    require(document, "document");
    require(repaired, "repaired");
    require(path, "path");
    require_repaired(*document, *repaired);
    write(*document, *repaired, path);
  });
}

int unsnarl_document_write_partial(unsnarl_document* document, const unsnarl_result* repaired, const char* path) {
  return guarded([&] {
    require(document, "document");
    require(repaired, "repaired");
    require(path, "path");
    require_repaired(*document, *repaired);
    document->partial = write_partial(*document, *repaired, path);
  });
}

const char* unsnarl_document_partial(const unsnarl_document* document, size_t file) {
  return file < document->partial.size() ? document->partial[file].c_str() : nullptr;
}

void unsnarl_document_free(unsnarl_document* document) {
  delete document;
}
