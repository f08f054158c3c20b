#pragma once

#include <optional>
#include <string>

#include "unsnarl/document.h"

namespace unsnarl::app {

/// The path that stands for standard input or output.
inline constexpr const char* standard_stream = "-";

/// A bare format name as users give it to --format. Throws UsageError, naming the choices.
std::optional<Format> format_from_name(const std::string& name);

/// Reads the mesh at `path`, or from standard input, where a format must be given. Throws FileError, UsageError.
Document read_mesh(const std::string& path, const std::optional<Format>& format);

/// Whitespace-separated 0-based ids, '#' to the end of a line is a comment; one flag a vertex. Throws FileError.
std::vector<std::uint8_t> read_vertex_flags(const std::string& path, std::size_t vertex_count);

}  // namespace unsnarl::app
