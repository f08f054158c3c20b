#include "viewer.h"

#include <filesystem>

#include "mesh_input.h"
#include "unsnarl/page.h"
#include "usage_error.h"

namespace unsnarl::app {

void require_viewer() {
  if (built_in_page().empty())
    throw UsageError(
        "this build has no viewer: it was made without Node.js or without the viewer's packages. Install nodejs and "
        "npm, run 'npm ci' in viewer/, then configure and build again with -DUNSNARL_BUILD_VIEWER=ON (./demo does it "
        "all)");
}

std::string page_name(const std::string& path) {
  return path == standard_stream ? "mesh" : std::filesystem::path(path).filename().string();
}

std::string scene_name(const std::vector<std::string>& paths) {
  std::string names;
  for (const std::string& path : paths) names += (names.empty() ? "" : ", ") + page_name(path);
  return names;
}

}  // namespace unsnarl::app
