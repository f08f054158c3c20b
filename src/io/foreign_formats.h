#pragma once

#include <string>
#include <string_view>

namespace unsnarl {

/// Throws FileError, saying how to convert, for files of well-known formats that are not read, told by their first
/// bytes or by the extension of `path` (empty: not looked at).
void refuse_foreign_format(std::string_view bytes, const std::string& path);

}  // namespace unsnarl
