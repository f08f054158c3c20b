#include "batch/folder.h"

#include <fmt/format.h>

#include <algorithm>

#include "platform/files.h"
#include "unsnarl/document.h"
#include "unsnarl/paths.h"
#include "usage_error.h"

namespace unsnarl::app {

namespace fs = std::filesystem;

std::string BatchFolder::mesh(const std::string& name) {
  const std::string path = "fixed/" + name;
  if (format_from_extension(name) != Format::gltf) return path;
  return path + "/" + path_of(name).filename().string();
}

namespace {

/// Whether a batch has been here: it writes to its journal before anything else.
bool has_records(const fs::path& journal) {
  std::error_code error;
  return std::any_of(fs::directory_iterator(journal, error), fs::directory_iterator(),
                     [](const fs::directory_entry& entry) { return entry.path().extension() == ".jsonl"; });
}

}  // namespace

void BatchFolder::prepare() const {
  std::error_code error;
  for (const char* const name :
       {"fixed", "reports", "thumbnails", "work", "results.jsonl", "results.csv", "index.html"})
    if (fs::exists(root / name, error) && !has_records(journal()))
      throw UsageError(
          fmt::format("{}: it holds '{}', which was not written by 'unsnarl batch' and would be replaced; use another "
                      "folder",
                      root.string(), name));
  fs::create_directories(journal(), error);
  if (error) throw_write_error(journal().string() + ": cannot make this folder", platform::errno_of(error));
}

bool BatchFolder::take_over(const fs::path& from, const std::string& to) const {
  const fs::path target = root / path_of(to);
  std::error_code error;
  if (!fs::exists(from, error)) {
    fs::remove(target, error);
    return false;
  }
  fs::create_directories(target.parent_path(), error);
  fs::rename(from, target, error);
  if (error) throw_write_error(target.string() + ": cannot be written", platform::errno_of(error));
  return true;
}

}  // namespace unsnarl::app
