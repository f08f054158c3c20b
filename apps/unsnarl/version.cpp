#include "version.h"

#include <CLI/Version.hpp>
#include <nlohmann/json.hpp>

#include "unsnarl/libraries.h"
#include "unsnarl/version.h"

namespace unsnarl::app {

std::string version_json() {
  nlohmann::ordered_json libraries;
  for (const LibraryVersion& library : unsnarl::libraries()) libraries[library.name] = library.version;
  libraries["CLI11"] = CLI11_VERSION;
  libraries["three.js"] = UNSNARL_THREE_VERSION;
  return nlohmann::ordered_json{{"unsnarl", version}, {"libraries", libraries}}.dump();
}

std::string advice_on_defects(std::string_view homepage) {
  const std::string evidence = "the command, the mesh and this message";
  if (homepage.empty())
    return "This is a defect of the program; whoever gave it to you needs " + evidence + " to mend it";
  return "This is a defect of the program; please report it at " + std::string(homepage) + ", with " + evidence;
}

}  // namespace unsnarl::app
