#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace unsnarl::app {

/// The word of `known` that `given` may be a misspelling of: not more than a third of its letters are wrong, missing,
/// added or swapped with a neighbour. Empty: none is so near.
std::string nearest_word(std::string_view given, const std::vector<std::string>& known);

/// " Did you mean X?" with that word, or nothing.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& known);

}  // namespace unsnarl::app
