#include "io/linked_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "io/mesh_file.h"
#include "io/text_scanner.h"
#include "unsnarl/paths.h"

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

/// A file could bring along a link to anywhere.
bool leads_inside(const fs::path& folder, const fs::path& name) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return true;  // there is no such folder, and nothing to be read
  const fs::path place = fs::weakly_canonical(root / name, error);
  return !error && std::mismatch(root.begin(), root.end(), place.begin(), place.end()).first == root.end();
}

}  // namespace

fs::path named_path(std::string text) {
  std::replace(text.begin(), text.end(), '\\', '/');
  return path_of(text);
}

fs::path linked_file(const fs::path& folder, const fs::path& name) {
  const fs::path from = folder.empty() ? fs::path(".") : folder;
  if (!is_inside_folder(name) || !leads_inside(from, name))
    throw FileError(
        fmt::format("{} is not in the folder of the file that names it, or is a link out of it; put it there",
                    in_quotes(name.string())));
  return folder / name;
}

}  // namespace unsnarl
