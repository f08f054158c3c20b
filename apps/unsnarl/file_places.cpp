#include "file_places.h"

#include <fmt/format.h>

#include <algorithm>

#include "mesh_input.h"
#include "platform/files.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "unsnarl/paths.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

/// Two paths of one file have one of these in common: the path without links, or the file's number on its device.
std::vector<std::string> identities_of(const fs::path& path) {
  if (path == standard_stream) return {standard_stream};
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  const fs::path canonical = fs::weakly_canonical(absolute, error);
  std::vector<std::string> identities = {(error ? absolute.lexically_normal() : canonical).string()};
  const platform::FileStatus status = platform::status_of(path);
  if (status.kind != platform::FileKind::none)
    identities.push_back(fmt::format("file {} on device {}", status.stamp.inode, status.stamp.device));
  return identities;
}

bool is_device(const std::string& path) {
  return path != standard_stream && is_stream(path);
}

}  // namespace

void FilePlaces::reads(const std::string& what, const std::string& path) {
  if (path.empty() || is_stream(path)) return;
  claim(path_of(path), {what, "", false});
}

void FilePlaces::writes(const std::string& what, const std::string& path, const std::string& advice) {
  if (path.empty() || is_device(path)) return;
  claim(path_of(path), {what, advice, true});
  if (path != standard_stream) outputs_.push_back(path_of(path));
}

void FilePlaces::claim(const fs::path& path, const File& file) {
  const std::vector<std::string> identities = identities_of(path);
  for (const std::string& identity : identities) {
    const auto other = files_.find(identity);
    if (other == files_.end() || !(other->second.is_written || file.is_written)) continue;
    if (path == standard_stream)
      throw UsageError(fmt::format("{} and {} both go to standard output; write one of them to a file",
                                   other->second.what, file.what));
    throw UsageError(fmt::format("{} and {} are the same file ({}); {}", other->second.what, file.what, path.string(),
                                 file.is_written ? file.advice : other->second.advice));
  }
  for (const std::string& identity : identities) files_.emplace(identity, file);
}

void FilePlaces::writes_beside(const std::string& what, const fs::path& main, const std::vector<fs::path>& names,
                               const std::string& advice) {
  for (const fs::path& name : names) {
    claim(main.parent_path() / name, {what, advice, true});
    beside_[main].push_back(name);
  }
}

bool FilePlaces::has(const fs::path& path) const {
  const std::vector<std::string> identities = identities_of(path);
  return std::any_of(identities.begin(), identities.end(),
                     [this](const std::string& identity) { return files_.contains(identity); });
}

void FilePlaces::require_writable(Interruption& interruption) const {
  StagedOutput outputs(interruption);
  for (const fs::path& path : outputs_) outputs.files().open(path);
  for (const auto& [main, names] : beside_) outputs.files().open_beside(main, names);
}

}  // namespace unsnarl::app
