#include "batch/folder.h"

#include <fmt/format.h>

#include "unsnarl/document.h"
#include "usage_error.h"

namespace unsnarl::app {

namespace fs = std::filesystem;

std::string BatchFolder::mesh(const std::string& name) {
  const std::string path = "fixed/" + name;
  if (format_from_extension(name) != Format::gltf) return path;
  return path + "/" + fs::path(name).filename().string();
}

void BatchFolder::prepare() const {
  std::error_code error;
  if (fs::exists(root / "fixed", error) && !fs::exists(journal(), error))
    throw UsageError(
        fmt::format("{}: there is a folder 'fixed' in it that no 'unsnarl batch' has written; name another "
                    "folder",
                    root.string()));
  fs::create_directories(journal(), error);
  if (error) throw_write_error(journal().string() + ": cannot make this folder", error.value());
}

bool BatchFolder::take_over(const fs::path& from, const std::string& to) const {
  const fs::path target = root / to;
  std::error_code error;
  if (!fs::exists(from, error)) {
    fs::remove(target, error);
    return false;
  }
  fs::create_directories(target.parent_path(), error);
  fs::rename(from, target, error);
  if (error) throw_write_error(target.string() + ": cannot be written", error.value());
  return true;
}

}  // namespace unsnarl::app
