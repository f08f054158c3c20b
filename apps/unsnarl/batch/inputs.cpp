#include "batch/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "batch/folder.h"
#include "content_hash.h"
#include "input_bytes.h"
#include "mesh_input.h"
#include "unsnarl/document.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

bool is_hidden(const fs::path& path) {
  return path.filename().string().starts_with('.');
}

std::vector<BatchMesh> meshes_below(const fs::path& folder, const fs::path& results) {
  std::vector<BatchMesh> meshes;
  // The folder that is searched may be that of the results too.
  const auto holds_results = [&](const fs::path& path) {
    std::error_code ignored;
    return fs::equivalent(path, results, ignored) || fs::equivalent(path, results / "fixed", ignored) ||
           fs::equivalent(path, results / "work", ignored);
  };
  std::error_code error;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(folder, options, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (it->is_directory(ignored) && (is_hidden(it->path()) || holds_results(it->path())))
      it.disable_recursion_pending();
    else if (it->is_regular_file(ignored) && !is_hidden(it->path()) && format_from_extension(it->path().string()))
      meshes.push_back({it->path(), it->path().lexically_relative(folder).generic_string()});
  }
  if (error) throw FileError(fmt::format("{}: cannot list the folder: {}", folder.string(), error.message()));
  return meshes;
}

/// The folders of a path are kept; of one that leads out of the current folder, all from the root on.
std::string name_of(const fs::path& path) {
  fs::path name = path.lexically_normal();
  if (name.is_absolute() || *name.begin() == "..") name = fs::absolute(path).lexically_normal().relative_path();
  return name.generic_string();
}

bool stays_inside(const fs::path& name) {
  return !name.empty() && !name.is_absolute() && name.has_filename() &&
         std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".." || part == "."; });
}

std::vector<BatchMesh> meshes_of_list(std::istream& lines, const std::string& list) {
  std::vector<BatchMesh> meshes;
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    const std::size_t tab = line.find('\t');
    const std::string path = line.substr(0, tab);
    const std::string name = tab == std::string::npos ? name_of(path) : line.substr(tab + 1);
    if (path.empty() || !stays_inside(name))
      throw FileError(
          fmt::format("{}:{}: '{}' is no name of a result; give a relative path without '..'", list, number, name));
    if (!format_from_extension(name))
      throw FileError(fmt::format("{}:{}: the extension of '{}' tells no format that is read; choose {}", list, number,
                                  name, format_names(" or ")));
    meshes.push_back({path, name});
  }
  require_no_failure(lines, list);
  return meshes;
}

/// Two meshes must not write to one place. The same path twice is one mesh.
void sort_and_check(std::vector<BatchMesh>& meshes) {
  std::sort(meshes.begin(), meshes.end(),
            [](const BatchMesh& a, const BatchMesh& b) { return std::tie(a.name, a.path) < std::tie(b.name, b.path); });
  const auto same = [](const BatchMesh& a, const BatchMesh& b) { return a.name == b.name && a.path == b.path; };
  meshes.erase(std::unique(meshes.begin(), meshes.end(), same), meshes.end());
  std::map<fs::path, const BatchMesh*> by_place;
  for (const BatchMesh& mesh : meshes) {
    const auto [same, is_new] = by_place.emplace(BatchFolder::mesh(mesh.name), &mesh);
    if (!is_new)
      throw UsageError(
          fmt::format("{} and {} would both be written to {}; give one another name, after a tab in the "
                      "list",
                      same->second->path.string(), mesh.path.string(), mesh.name));
  }
  for (const auto& [place, mesh] : by_place)
    for (fs::path folder = place.parent_path(); !folder.empty(); folder = folder.parent_path())
      if (const auto file = by_place.find(folder); file != by_place.end())
        throw UsageError(
            fmt::format("{} and {} would be written to {} and to a folder of that name; give one another name, after "
                        "a tab in the list",
                        file->second->path.string(), mesh->path.string(), file->second->name));
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
    throw UsageError(
        fmt::format("task {} of a Slurm array of {} tasks that are not evenly numbered: say which part "
                    "is meant with --shard I/N (0/1: all; what is done already is not done again)",
                    *id, *count));
  return {(*id - first) / step, *count};
}

/// Resolves a relative URI of a glTF.
std::string decoded(const std::string& uri) {
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

/// The files that hold the numbers of a glTF. One that is no glTF refers to none: reading it will say what is wrong.
std::vector<fs::path> buffers_of_gltf(const fs::path& gltf) {
  std::vector<fs::path> files;
  std::ifstream file(gltf, std::ios::binary);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains("buffers") || !json["buffers"].is_array()) return files;
  for (const nlohmann::json& buffer : json["buffers"])
    if (buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string())
      if (const std::string uri = buffer["uri"]; !uri.starts_with("data:"))
        files.push_back(gltf.parent_path() / decoded(uri));
  return files;
}

/// The same of a GIFTI, which is read whole only where it has such files.
std::vector<fs::path> external_files_of_gifti(const fs::path& gifti) {
  std::vector<fs::path> files;
  std::ifstream file(gifti, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.find("ExternalFileBinary") == std::string::npos) return files;
  for (const fs::path& name : external_files(gifti, Format::gii)) files.push_back(gifti.parent_path() / name);
  return files;
}

}  // namespace

std::vector<BatchMesh> batch_meshes(const std::string& list_or_folder, const fs::path& results) {
  std::vector<BatchMesh> meshes;
  std::error_code ignored;
  if (list_or_folder == standard_stream) {
    meshes = meshes_of_list(std::cin, "standard input");
  } else if (fs::is_directory(list_or_folder, ignored)) {
    meshes = meshes_below(list_or_folder, results);
  } else {
    if (const auto format = format_from_extension(list_or_folder))
      throw UsageError(fmt::format(
          "{} is a mesh; give a folder of meshes or a list of their paths, or use 'unsnarl fix'", list_or_folder));
    std::ifstream list = opened(list_or_folder, "; give a folder of meshes, or a file with a path a line");
    meshes = meshes_of_list(list, list_or_folder);
  }
  if (meshes.empty()) throw FileError(fmt::format("{}: no mesh in it ({})", list_or_folder, format_names(", ")));
  sort_and_check(meshes);
  for (BatchMesh& mesh : meshes)
    if (const std::uintmax_t bytes = fs::file_size(mesh.path, ignored); bytes != static_cast<std::uintmax_t>(-1))
      mesh.bytes = bytes;
  return meshes;
}

Shard shard_from(const std::string& text) {
  if (text.empty()) return shard_of_slurm_task();
  const std::size_t slash = text.find('/');
  const auto index = whole_number(text.substr(0, slash).c_str());
  const auto count = slash == std::string::npos ? std::nullopt : whole_number(text.substr(slash + 1).c_str());
  if (!index || !count || *index >= *count)
    throw UsageError(fmt::format("--shard {}: give I/N, the part and their number, from 0/N to N-1/N", text));
  return {*index, *count};
}

std::vector<BatchMesh> part_of(const std::vector<BatchMesh>& meshes, const Shard& shard) {
  std::vector<BatchMesh> part;
  for (std::size_t i = shard.index; i < meshes.size(); i += shard.count) part.push_back(meshes[i]);
  return part;
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
