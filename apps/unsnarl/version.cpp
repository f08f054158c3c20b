#include "version.h"

#include <openssl/crypto.h>

#include <CLI/Version.hpp>
#include <nlohmann/json.hpp>

#include "unsnarl/libraries.h"
#include "unsnarl/page.h"
#include "unsnarl/version.h"

namespace unsnarl::app {

std::string version_json() {
  const bool with_viewer = !built_in_page().empty();
  nlohmann::ordered_json libraries;
  for (const LibraryVersion& library : unsnarl::libraries()) libraries[library.name] = library.version;
  libraries["CLI11"] = CLI11_VERSION;
  libraries["OpenSSL"] = OpenSSL_version(OPENSSL_VERSION_STRING);
  if (with_viewer) libraries["three.js"] = UNSNARL_THREE_VERSION;
  return nlohmann::ordered_json{{"unsnarl", version}, {"viewer", with_viewer}, {"libraries", libraries}}.dump();
}

}  // namespace unsnarl::app
