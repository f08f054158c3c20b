#pragma once

#include <string>
#include <vector>

namespace unsnarl::app {

/// The name of a mesh as the page shows it: the last part of its path.
std::string page_name(const std::string& path);
/// Those of several.
std::string scene_name(const std::vector<std::string>& paths);

}  // namespace unsnarl::app
