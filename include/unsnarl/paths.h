#pragma once

#include <filesystem>
#include <string_view>

namespace unsnarl {

/// The path that UTF-8 text names; on POSIX, where names are bytes, that of these bytes. Use it for every text that may
/// hold more than ASCII: std::filesystem::path takes a std::string by a table of the system. path::string() gives the
/// text back. Throws std::system_error where text that is no UTF-8 names nothing on this system.
inline std::filesystem::path path_of(std::string_view text) {
  return std::u8string_view(reinterpret_cast<const char8_t*>(text.data()), text.size());
}

}  // namespace unsnarl
