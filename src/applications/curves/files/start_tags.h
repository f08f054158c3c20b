#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace unsnarl {

/// Attributes that say where a line, rect, circle or ellipse is.
inline constexpr std::array<const char*, 13> measures = {"x",  "y", "width", "height", "rx", "ry", "cx",
                                                         "cy", "r", "x1",    "y1",     "x2", "y2"};

/// An attribute of a start tag in a text.
struct Attribute {
  std::size_t begin = 0, end = 0;              ///< with its name and quotation marks
  std::size_t value_begin = 0, value_end = 0;  ///< without
};
using Attributes = std::map<std::string, Attribute, std::less<>>;  ///< by their names

/// The attributes of the start tag whose name begins at `name`; the text is well-formed.
Attributes attributes_of(std::string_view text, std::size_t name);

/// The place of the end tag that belongs to a start tag; `at` is behind that. The text is well-formed.
std::size_t end_tag_of(std::string_view text, std::size_t at);

}  // namespace unsnarl
