#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace unsnarl {

/// A part of a file, in bytes.
struct ByteRange {
  std::size_t begin = 0, size = 0;
};

/// The replacement of a part of a text.
struct TextEdit {
  std::size_t begin, end;
  std::string text;
};

/// The text with all replacements made; they must not overlap.
std::string with_edits(std::string_view text, std::vector<TextEdit> edits);

}  // namespace unsnarl
