#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace unsnarl::app {

/// Other ways to ask for what there is: `help`, and `help COMMAND`.
std::vector<std::string> with_usual_spelling(std::vector<std::string> words);

/// The fault of these words of a command line, which the parser refused, and what to do.
std::string explain_usage(const CLI::App& program, const CLI::ParseError& error, const std::vector<std::string>& words);

}  // namespace unsnarl::app
