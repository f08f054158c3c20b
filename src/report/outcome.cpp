#include <algorithm>

#include "unsnarl/nesting.h"
#include "unsnarl/report.h"

namespace unsnarl {

std::string_view outcome(Status status, std::span<const NestedPair> pairs) {
  const bool nested = std::all_of(pairs.begin(), pairs.end(), [](const NestedPair& pair) { return pair.is_nested; });
  return is_resolved(status) && !nested ? "not_nested" : to_string(status);
}

ExitCode exit_code_of(Status status, std::span<const NestedPair> pairs) {
  return outcome(status, pairs) == to_string(status) ? exit_code_of(status) : exit_obstructed;
}

}  // namespace unsnarl
