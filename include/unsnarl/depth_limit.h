#pragma once

#include <cstddef>
#include <string_view>

namespace unsnarl {

/// The deepest nesting that is read: of brackets, XML elements, groups and components within each other. Real files
/// have a few dozen. A file that is nested deeper is refused (FileError, "nested too deeply"), since everything that
/// follows it down takes stack.
inline constexpr std::size_t deepest_nesting = 256;

/// Place of the first bracket of a JSON text that is nested too deeply; npos: there is none. Looks at brackets and
/// strings alone: whether the text is JSON is for a parser to say.
std::size_t too_deep_bracket(std::string_view json);

}  // namespace unsnarl
