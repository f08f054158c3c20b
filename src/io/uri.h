#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace unsnarl {

/// "a%20b" -> "a b"; what is no code stays.
std::string percent_decoded(std::string_view text);

/// May this file be read and, at the output, written? Only below the folder of the file that names it.
bool is_inside_folder(const std::filesystem::path& name);

/// Place of the base64 digits in a data: URI; npos: it has none.
std::size_t data_uri_start(std::string_view uri);

}  // namespace unsnarl
