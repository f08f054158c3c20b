#include "batch/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "batch/folder.h"
#include "content_hash.h"
#include "input_bytes.h"
#include "mesh_input.h"
#include "platform/files.h"
#include "unsnarl/document.h"
#include "unsnarl/paths.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

bool is_hidden(const fs::path& path) {
  return path.filename().string().starts_with('.');
}

/// Searches a folder and those below it.
class FolderSearch {
 public:
  FolderSearch(const fs::path& root, const fs::path& results) : root_(root), results_(results) {}

  BatchInputs run() {
    folders_ = {root_};
    while (!folders_.empty()) {
      const fs::path folder = std::move(folders_.back());
      folders_.pop_back();
      list(folder);
    }
    return std::move(found_);
  }

 private:
  void list(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) take(*it);
    if (!error) return;
    if (folder == root_) throw_read_error(folder.string() + ": cannot list the folder", platform::errno_of(error));
    found_.meshes.push_back({folder, name_of_entry(folder) + "/", 0, "cannot list the folder: " + error.message()});
  }

  void take(const fs::directory_entry& entry) {
    if (is_hidden(entry.path())) return;
    std::error_code error;
    if (entry.is_directory(error)) {
      if (!entry.is_symlink(error) && !holds_results(entry.path())) folders_.push_back(entry.path());
    } else if (entry.is_regular_file(error)) {
      take_file(entry.path());
    } else if (error && error != std::errc::no_such_file_or_directory) {
      found_.meshes.push_back({entry.path(), name_of_entry(entry.path()), 0, "cannot be read: " + error.message()});
    }
  }

  void take_file(const fs::path& path) {
    const std::string name = name_of_entry(path);
    if (format_from_extension(path.string())) {
      found_.meshes.push_back({path, name});
    } else {
      const std::string extension = path.extension().string();
      OtherFiles& others = found_.others[extension.empty() ? "without an extension" : "*" + extension];
      if (others.count++ == 0 || name < others.first) others.first = name;
    }
  }

  std::string name_of_entry(const fs::path& path) const { return path.lexically_relative(root_).generic_string(); }

  /// The folder that is searched may be that of the results too.
  bool holds_results(const fs::path& path) const {
    std::error_code ignored;
    return fs::equivalent(path, results_, ignored) || fs::equivalent(path, results_ / "fixed", ignored) ||
           fs::equivalent(path, results_ / "work", ignored);
  }

  const fs::path root_, results_;
  std::vector<fs::path> folders_;  // still to be listed
  BatchInputs found_;
};

/// The folders of a path are kept; of one that leads out of the current folder, all from the root on.
std::string name_of(const fs::path& path) {
  fs::path name = path.lexically_normal();
  std::error_code ignored;  // of a current folder that is gone: then the mesh cannot be read
  if (name.has_root_path() || *name.begin() == "..")
    name = fs::absolute(path, ignored).lexically_normal().relative_path();
  return name.generic_string();
}

bool stays_inside(const fs::path& name) {
  return !name.empty() && !name.has_root_path() && name.has_filename() &&
         std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".." || part == "."; });
}

BatchMesh mesh_of_line(const std::string& line, const std::string& place) {
  const std::size_t tab = line.find('\t');
  const std::string path = line.substr(0, tab);
  const std::string name = tab == std::string::npos && !path.empty() ? name_of(path_of(path)) : line.substr(tab + 1);
  BatchMesh mesh{path_of(path), name};
  if (path.empty()) {
    mesh.fault = place + ": there is no path of a mesh before the tab";
  } else if (!stays_inside(path_of(name))) {
    mesh.fault = fmt::format("{}: '{}' cannot be the name of a result; use a relative path without '..'", place, name);
  } else if (!format_from_extension(name)) {
    mesh.fault = fmt::format("{}: '{}' has no extension of a supported format: {}", place, name, format_names(" or "));
  }
  if (name.empty()) mesh.name = place;
  return mesh;
}

std::vector<BatchMesh> meshes_of_list(std::istream&& lines, const std::string& list) {
  std::vector<BatchMesh> meshes;
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) meshes.push_back(mesh_of_line(line, fmt::format("{}:{}", list, number)));
  }
  return meshes;
}

/// Two meshes must not write to one place: the second is refused. The same path twice is one mesh.
void keep_places_apart(std::vector<BatchMesh>& meshes) {
  std::map<fs::path, const BatchMesh*> by_place;
  std::vector<BatchMesh> kept;
  kept.reserve(meshes.size());
  for (BatchMesh& mesh : meshes) {
    if (!mesh.fault.empty()) {
      kept.push_back(std::move(mesh));
      continue;
    }
    const auto same = by_place.find(path_of(BatchFolder::mesh(mesh.name)));
    if (same != by_place.end() && same->second->path == mesh.path) continue;
    kept.push_back(std::move(mesh));
    if (same == by_place.end()) {
      by_place.emplace(path_of(BatchFolder::mesh(kept.back().name)), &kept.back());
    } else {
      kept.back().fault =
          fmt::format("{} and {} would both be written to {}; give one of them another name, after a tab in the list",
                      same->second->path.string(), kept.back().path.string(), kept.back().name);
    }
  }
  for (BatchMesh& mesh : kept)
    for (fs::path folder = path_of(BatchFolder::mesh(mesh.name)).parent_path(); !folder.empty() && mesh.fault.empty();
         folder = folder.parent_path())
      if (const auto file = by_place.find(folder); file != by_place.end())
        mesh.fault = fmt::format(
            "{} and {} would be written to {} and to a folder of that name; give one of them another name, after a tab "
            "in "
            "the list",
            file->second->path.string(), mesh.path.string(), file->second->name);
  meshes = std::move(kept);
}

std::optional<std::size_t> whole_number(const char* text) {
  if (text == nullptr) return {};
  const std::string_view digits = text;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size()) return {};
  return number;
}

Shard shard_of_slurm_task() {
  const auto variable = [](const char* name) { return whole_number(std::getenv(name)); };
  const auto id = variable("SLURM_ARRAY_TASK_ID"), count = variable("SLURM_ARRAY_TASK_COUNT");
  if (!id || !count || *count == 0) return {};
  const std::size_t first = variable("SLURM_ARRAY_TASK_MIN").value_or(0);
  const std::size_t step = std::max<std::size_t>(1, variable("SLURM_ARRAY_TASK_STEP").value_or(1));
  const bool is_even = *id >= first && (*id - first) % step == 0;
  if (!is_even || (*id - first) / step >= *count)
    throw UsageError(fmt::format(
        "task {} of a Slurm array of {} tasks whose numbers are not evenly spaced; say with --shard I/N which "
        "part to repair (0/1: all; meshes that are done are skipped)",
        *id, *count));
  return {(*id - first) / step, *count};
}

/// The files that hold the numbers of a glTF. One that is no glTF refers to none: reading it will say what is wrong.
std::vector<fs::path> buffers_of_gltf(const fs::path& gltf) {
  std::vector<fs::path> files;
  const nlohmann::json json = nlohmann::json::parse(bytes_if_readable(gltf.string()), nullptr, false);
  if (!json.is_object() || !json.contains("buffers") || !json["buffers"].is_array()) return files;
  for (const nlohmann::json& buffer : json["buffers"])
    if (buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string())
      if (const std::string uri = buffer["uri"]; !uri.starts_with("data:"))
        files.push_back(gltf.parent_path() / path_of(decoded_uri(uri)));
  return files;
}

/// The same of a GIFTI, which is read whole only where it has such files.
std::vector<fs::path> external_files_of_gifti(const fs::path& gifti) {
  std::vector<fs::path> files;
  if (bytes_if_readable(gifti.string()).find("ExternalFileBinary") == std::string::npos) return files;
  for (const fs::path& name : external_files(gifti, Format::gii)) files.push_back(gifti.parent_path() / name);
  return files;
}

}  // namespace

BatchInputs batch_inputs(const std::string& list_or_folder, const fs::path& results) {
  BatchInputs inputs;
  std::error_code error;
  if (list_or_folder == standard_stream) {
    inputs.meshes = meshes_of_list(std::istringstream(read_bytes(standard_stream)), "standard input");
  } else if (fs::is_directory(path_of(list_or_folder), error)) {
    inputs = FolderSearch(path_of(list_or_folder), results).run();
  } else {
    if (const auto format = format_from_extension(list_or_folder))
      throw UsageError(
          fmt::format("{} is a mesh; 'unsnarl batch' needs a folder of meshes or a list of their paths; for one mesh "
                      "use 'unsnarl fix'",
                      list_or_folder));
    inputs.meshes = meshes_of_list(
        std::istringstream(read_bytes(list_or_folder, "; give a folder of meshes, or a file with a path a line")),
        list_or_folder);
  }
  if (inputs.meshes.empty())
    throw FileError(fmt::format("{}: no mesh found in it (supported: {})", list_or_folder, format_names(", ")));
  std::stable_sort(inputs.meshes.begin(), inputs.meshes.end(),
                   [](const BatchMesh& a, const BatchMesh& b) { return a.name < b.name; });
  keep_places_apart(inputs.meshes);
  for (BatchMesh& mesh : inputs.meshes)
    if (const std::uintmax_t bytes = fs::file_size(mesh.path, error); mesh.fault.empty() && !error) mesh.bytes = bytes;
  return inputs;
}

Shard shard_from(const std::string& text) {
  if (text.empty()) return shard_of_slurm_task();
  const std::size_t slash = text.find('/');
  const auto index = whole_number(text.substr(0, slash).c_str());
  const auto count = slash == std::string::npos ? std::nullopt : whole_number(text.substr(slash + 1).c_str());
  if (!index || !count || *index >= *count)
    throw UsageError(fmt::format("--shard must be I/N, as in 0/4, with I from 0 to N-1, not '{}'", text));
  return {*index, *count};
}

std::vector<BatchMesh> part_of(const std::vector<BatchMesh>& meshes, const Shard& shard) {
  std::vector<BatchMesh> part;
  for (std::size_t i = shard.index; i < meshes.size(); i += shard.count) part.push_back(meshes[i]);
  return part;
}

std::string encoded_uri(const std::string& path) {
  std::string uri;
  const bool is_text = is_utf8(path);
  for (const char byte : path) {
    const auto code = static_cast<unsigned char>(byte);
    if (byte == '%' || (!is_text && code >= 0x80))
      uri += fmt::format("%{:02X}", code);
    else
      uri += byte;
  }
  return uri;
}

std::string decoded_uri(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned int code = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(uri.data() + i + 1, uri.data() + i + 3, code, 16).ptr == uri.data() + i + 3) {
      text += static_cast<char>(code);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

std::string content_hash(const BatchMesh& mesh) {
  std::string own = sha256_of_file(mesh.path);
  const std::optional<Format> format = format_from_extension(mesh.name);
  std::vector<fs::path> others;
  if (format == Format::gltf) others = buffers_of_gltf(mesh.path);
  if (format == Format::gii) others = external_files_of_gifti(mesh.path);
  for (const fs::path& file : others) own += '\n' + sha256_of_file(file);
  return others.empty() && format != Format::gltf ? own : sha256(own);
}

}  // namespace unsnarl::app
