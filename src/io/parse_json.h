#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace unsnarl {

/// A JSON text as a value whose members keep their order. Throws FileError, naming the byte, where it is not JSON, is
/// nested deeper than deepest_nesting or has a number too large for double precision.
nlohmann::ordered_json parse_json(std::string_view text);

}  // namespace unsnarl
