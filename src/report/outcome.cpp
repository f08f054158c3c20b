#include <algorithm>

#include "unsnarl/nesting.h"
#include "unsnarl/report.h"

namespace unsnarl {

std::string_view outcome(Status status, std::span<const NestedPair> pairs) {
  const bool nested = std::all_of(pairs.begin(), pairs.end(), [](const NestedPair& pair) { return pair.is_nested; });
  const bool is_embedded = status == Status::embedded || status == Status::gap_not_met;
  return is_embedded && !nested ? "not_nested" : to_string(status);
}

ExitCode exit_code_of(Status status, std::span<const NestedPair> pairs) {
  return outcome(status, pairs) == to_string(status) ? exit_code_of(status) : exit_obstructed;
}

}  // namespace unsnarl
