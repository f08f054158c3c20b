#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "unsnarl/repair_file_steps.h"

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

/// Main files and those that hold numbers for them.
std::vector<fs::path> files_read(const FilesToRepair& files) {
  std::vector<fs::path> read = files.inputs;
  for (std::size_t i = 0; i < files.inputs.size(); ++i)
    for (const fs::path& name : external_files(files.scene->document(i)))
      read.push_back(files.inputs[i].parent_path() / name);
  return read;
}

bool is_one_of(const fs::path& place, const std::vector<fs::path>& others) {
  return std::any_of(others.begin(), others.end(), [&](const fs::path& other) { return is_same_file(place, other); });
}

/// The extensions of VTK's XML files say which data set they hold: .vtp or .vtu. Other formats' say nothing more.
bool hold_different_data_sets(const fs::path& a, const fs::path& b) {
  const auto is_grid = [](const fs::path& path) { return path.extension() == ".vtu" || path.extension() == ".VTU"; };
  const auto is_known = [](const fs::path& path) { return format_from_extension(path.string()) == Format::vtp; };
  return is_known(a) && is_known(b) && is_grid(a) != is_grid(b);
}

/// A result is the input's file with other positions, so it cannot change its format.
void require_own_format(const FilesToRepair& files) {
  const Format own = files.scene->document(0).format();
  if (files.is_scene() || files.targets.empty()) return;
  const std::optional<Format> format = format_from_extension(files.output.string());
  const bool is_own = !format || *format == own;
  if (is_own && !hold_different_data_sets(files.inputs[0], files.output)) return;
  std::string extension = files.inputs[0].extension().string();  // of several, such as *.pial, the input's
  if (extension.empty() || format_from_extension(files.inputs[0].string()) != own)
    extension = fmt::format(".{}", to_string(own));
  throw std::invalid_argument(fmt::format("{}: the result keeps the format of the input, {}; name it *{}",
                                          files.output.string(), to_string(own), extension));
}

/// Throws where an external file of the result would replace a file that belongs to something else.
void require_own_external_files(const FilesToRepair& files, std::size_t i) {
  const std::vector<fs::path> names = files.names_beside(i);
  if (names.empty()) return;
  const fs::path main = files.main_place(i);
  const std::vector<fs::path> replaced =
      files.in_place ? names : external_files(main, files.scene->document(i).format());
  for (const fs::path& name : names) {
    const fs::path place = main.parent_path() / name;
    std::error_code ignored;
    if (fs::exists(place, ignored) && std::find(replaced.begin(), replaced.end(), name) == replaced.end())
      throw std::invalid_argument(
          fmt::format("{} exists and would be overwritten by a file of the same name that belongs to the "
                      "result; write the result to another folder",
                      place.string()));
  }
}

/// Outputs replace neither what was read nor each other.
void require_places_apart(const FilesToRepair& files) {
  if (files.in_place) return;
  const std::vector<fs::path> read = files_read(files);
  std::vector<fs::path> written;
  for (std::size_t i = 0; i < files.targets.size(); ++i) {
    std::vector<fs::path> places = {files.targets[i]};
    for (const fs::path& name : files.names_beside(i)) places.push_back(files.main_place(i).parent_path() / name);
    for (const fs::path& place : places) {
      if (is_one_of(place, read))
        throw std::invalid_argument(fmt::format(
            "{} holds part of the input and would be overwritten; write to another folder", place.string()));
      if (std::find(written.begin(), written.end(), place) != written.end())
        throw std::invalid_argument(
            fmt::format("{} would be written for two of the files; rename one of them", place.string()));
      written.push_back(place);
    }
  }
}

/// It replaces nothing that was read, not even an earlier partial result that this repair goes on from.
std::string free_partial_infix(const FilesToRepair& files, const std::function<bool(const fs::path&)>& is_taken) {
  const std::vector<fs::path> read = files_read(files);
  const auto is_free = [&](const fs::path& place) {
    return can_be_replaced(place) && !is_one_of(place, read) && !(is_taken && is_taken(place));
  };
  const auto are_free = [&](const std::string& infix) {
    for (std::size_t i = 0; i < files.targets.size(); ++i) {
      const fs::path main = with_infix(files.targets[i], infix);
      if (!is_free(main)) return false;
      for (const fs::path& name : external_files(files.scene->document(i), files.targets[i].filename(), infix))
        if (!is_free(main.parent_path() / name)) return false;
    }
    return true;
  };
  std::string infix = partial_infix;
  for (int number = 2; !are_free(infix); ++number) infix = fmt::format("{}.{}", partial_infix, number);
  return infix;
}

}  // namespace

fs::path FilesToRepair::main_place(std::size_t file) const {
  std::error_code error;
  const fs::path place = is_scene() ? targets[file] : fs::weakly_canonical(targets[file], error);
  return error ? targets[file] : place;
}

std::vector<fs::path> FilesToRepair::names_beside(std::size_t file) const {
  if (in_place || targets.empty()) return external_files(scene->document(file));
  return external_files(scene->document(file), main_place(file).filename());
}

SceneDocument read_scene(const std::vector<fs::path>& paths, std::optional<Format> format) {
  std::vector<std::string> names;
  for (const fs::path& path : paths) {
    names.push_back(path.filename().string());
    const auto same = std::find(names.begin(), names.end() - 1, names.back());
    if (same != names.end() - 1)
      throw std::invalid_argument(
          fmt::format("{} and {} have the same name, under which both would be written; rename one",
                      paths[static_cast<std::size_t>(same - names.begin())].string(), path.string()));
  }
  std::vector<Document> documents;
  for (const fs::path& path : paths) documents.push_back(Document::read(path, format));
  return {std::move(documents), std::move(names)};
}

FilesToRepair files_to_repair(std::shared_ptr<SceneDocument> scene, std::vector<fs::path> inputs, fs::path output,
                              const RepairFileOptions& options) {
  FilesToRepair files{std::move(inputs), std::move(scene), std::move(output), {}, options.in_place, {}, {}};
  files.notes = files.scene->notes();
  if (options.in_place && files.is_scene())
    throw std::invalid_argument("in_place takes one file; of several, name a folder for all of them");
  if (options.in_place && !files.output.empty())
    throw std::invalid_argument("in_place and an output exclude each other; give one of them");
  if (options.in_place) files.output = files.inputs[0];
  if (files.output.empty() && files.is_scene())
    throw std::invalid_argument("there is no output; several files need a folder to go to");
  if (files.output.empty()) return files;
  for (const fs::path& input : files.inputs)
    files.targets.push_back(files.is_scene() ? files.output / input.filename() : files.output);
  return files;
}

void check_places(FilesToRepair& files, bool no_partial, const std::function<bool(const fs::path&)>& is_taken) {
  require_own_format(files);
  for (std::size_t i = 0; i < files.targets.size(); ++i) require_own_external_files(files, i);
  require_places_apart(files);
  if (!no_partial && !files.targets.empty()) files.partial_infix = free_partial_infix(files, is_taken);
}

void require_writable(const FilesToRepair& files) {
  StagedFiles staged;
  for (std::size_t i = 0; i < files.targets.size(); ++i) staged.open_beside(files.targets[i], files.names_beside(i));
}

void fit_to_files(const SceneDocument& scene, RepairOptions& options) {
  if (const std::optional<std::size_t> file = scene.float32_file()) {
    if (options.precision == Precision::float64)
      throw std::invalid_argument(
          fmt::format("precision is 'float64', but {} stores 32-bit numbers", scene.files()[*file].name));
    options.precision = Precision::float32;
  }
  options.as_written = [&scene](std::span<const double> positions, bool float32) {
    return scene.as_written(positions, float32);
  };
}

}  // namespace unsnarl
