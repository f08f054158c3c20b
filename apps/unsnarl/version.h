#pragma once

#include <string>
#include <string_view>

namespace unsnarl::app {

/// `unsnarl --version --json`: {"unsnarl": version, "libraries": {name: version}}, in one line.
std::string version_json();

/// Advice on a defect of the program, as a sentence without its full stop. Says "report" only where there is an
/// address to report to.
std::string advice_on_defects(std::string_view homepage);

}  // namespace unsnarl::app
