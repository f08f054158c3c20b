#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "file_places.h"
#include "unsnarl/document.h"
#include "unsnarl/scene_document.h"

namespace unsnarl::app {

/// The path that stands for standard input or output.
inline constexpr const char* standard_stream = "-";

/// A bare format name as users give it to --format. Throws UsageError, naming the choices.
std::optional<Format> format_from_name(const std::string& name);

/// Reads the mesh at `path`, or from standard input, where a format must be given. Throws FileError, UsageError.
Document read_mesh(const std::string& path, const std::optional<Format>& format);

/// Names of the files of a scene: their paths without folders, which must differ. Throws UsageError.
std::vector<std::string> scene_names(const std::vector<std::string>& paths);

/// Reads meshes that are one scene. One may come from standard input alone. Throws FileError, UsageError.
SceneDocument read_inputs(const std::vector<std::string>& paths, const std::optional<Format>& format);

/// Names all files of a mesh as inputs. Throws UsageError where one of them is an output.
void claim_input(FilePlaces& places, const std::string& what, const std::string& path, const Document& document);
void claim_inputs(FilePlaces& places, const std::string& what, const std::vector<std::string>& paths,
                  const SceneDocument& scene);

/// Whitespace-separated 0-based ids, '#' to the end of a line is a comment; one flag a vertex. Throws FileError.
std::vector<std::uint8_t> read_vertex_flags(const std::string& path, std::size_t vertex_count);

}  // namespace unsnarl::app
