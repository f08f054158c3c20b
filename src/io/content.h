#pragma once

#include <optional>
#include <string_view>

#include "unsnarl/document.h"

namespace unsnarl {

/// The format that the first bytes of a file (at least checked_start of them, or all) belong to without doubt. OBJ and
/// binary STL have no such bytes.
std::optional<Format> format_of_content(std::string_view start);

/// Throws FileError where the first bytes are those of another format than `format`, or all zero.
void refuse_other_content(std::string_view start, Format format);

}  // namespace unsnarl
