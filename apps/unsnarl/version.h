#pragma once

#include <string>

namespace unsnarl::app {

/// `unsnarl --version --json`: {"unsnarl": version, "viewer": whether it can write pages, "libraries": {name:
/// version}}, in one line.
std::string version_json();

}  // namespace unsnarl::app
