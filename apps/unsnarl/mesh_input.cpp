#include "mesh_input.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "input_bytes.h"
#include "unsnarl/paths.h"
#include "usage_error.h"

namespace unsnarl::app {

std::optional<Format> format_from_name(const std::string& name) {
  if (name.empty()) return {};
  const std::optional<Format> format = format_from_extension(name);
  if (!format) throw UsageError(fmt::format("--format must be {1}, not '{0}'", name, format_names(" or ")));
  return format;
}

Document read_mesh(const std::string& path, const std::optional<Format>& format) {
  if (path != standard_stream) return Document::read(path_of(path), format);
  if (!format) throw UsageError("the format of standard input is unknown; add --format, as in --format obj");
  return Document::parse(read_bytes(standard_stream), *format);
}

std::vector<std::string> scene_names(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  for (const std::string& path : paths) {
    if (path == standard_stream && paths.size() > 1)
      throw UsageError("'-' (standard input) must be the only input; the files of a scene need names");
    names.push_back(path_of(path).filename().string());
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
      if (names[i] == names.back())
        throw UsageError(
            fmt::format("{} and {} have the same name, but the files of a scene are identified and written by "
                        "name; rename one of them",
                        paths[i], path));
  }
  return names;
}

SceneDocument read_inputs(const std::vector<std::string>& paths, const std::optional<Format>& format) {
  std::vector<std::string> names = scene_names(paths);
  std::vector<Document> documents;
  for (const std::string& path : paths) documents.push_back(read_mesh(path, format));
  return {std::move(documents), std::move(names)};
}

void claim_input(FilePlaces& places, const std::string& what, const std::string& path, const Document& document) {
  places.reads(what, path);
  if (path == standard_stream) return;
  for (const std::filesystem::path& name : external_files(document))
    places.reads("an external file of " + what, (path_of(path).parent_path() / name).string());
}

void claim_inputs(FilePlaces& places, const std::string& what, const std::vector<std::string>& paths,
                  const SceneDocument& scene) {
  for (std::size_t i = 0; i < paths.size(); ++i) claim_input(places, what, paths[i], scene.document(i));
}

std::vector<std::uint8_t> read_vertex_flags(const std::string& path, std::size_t vertex_count) {
  std::istringstream file(read_bytes(path, "; --fix-vertices needs a file of 0-based vertex ids"));
  std::vector<std::uint8_t> flags(vertex_count, 0);
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    for (std::string word; words >> word;) {
      std::size_t id = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
      if (error != std::errc{} || end != word.data() + word.size())
        throw FileError(
            fmt::format("{}:{}: '{}' is not a vertex id; ids are whole numbers from 0", path, number, word));
      if (id >= vertex_count)
        throw FileError(fmt::format("{}:{}: there is no vertex {}; the mesh has {} vertices, counted from 0", path,
                                    number, id, vertex_count));
      flags[id] = 1;
    }
  }
  return flags;
}

}  // namespace unsnarl::app
