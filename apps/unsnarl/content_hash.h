#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace unsnarl::app {

/// SHA-256 as 64 hexadecimal digits, as `sha256sum` prints it.
std::string sha256(std::string_view bytes);

/// SHA-256 of a file's bytes; empty where there is none, or it must not be read. Holds no more than a piece of it in
/// memory. Throws SystemError.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace unsnarl::app
