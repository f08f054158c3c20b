#include "viewer.h"

#include <filesystem>

#include "mesh_input.h"
#include "unsnarl/paths.h"

namespace unsnarl::app {

std::string page_name(const std::string& path) {
  return path == standard_stream ? "mesh" : path_of(path).filename().string();
}

std::string scene_name(const std::vector<std::string>& paths) {
  std::string names;
  for (const std::string& path : paths) names += (names.empty() ? "" : ", ") + page_name(path);
  return names;
}

}  // namespace unsnarl::app
