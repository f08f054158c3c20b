#include "io/parse_json.h"

#include <fmt/format.h>

#include "unsnarl/depth_limit.h"
#include "unsnarl/document.h"

namespace unsnarl {

nlohmann::ordered_json parse_json(std::string_view text) {
  if (const std::size_t place = too_deep_bracket(text); place != std::string_view::npos)
    throw FileError(
        fmt::format("byte {}: nested too deeply: more than {} brackets within each other", place, deepest_nesting));
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    throw FileError(fmt::format("byte {}: this is not JSON", e.byte));
  } catch (const nlohmann::json::exception&) {
    throw FileError("a number is too large for double precision");
  }
}

}  // namespace unsnarl
