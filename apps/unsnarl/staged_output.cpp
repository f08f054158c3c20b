#include "staged_output.h"

#include <fmt/format.h>

#include "standard_streams.h"

namespace unsnarl::app {

namespace fs = std::filesystem;

StagedOutput::StagedOutput(const fs::path& target, Interruption& interruption) : interruption_(interruption) {
  interruption_.hold_off([&](fs::path& temporary_folder) { temporary_folder = files_.emplace(target).folder(); });
}

StagedOutput::~StagedOutput() {
  interruption_.hold_off([&](fs::path& temporary_folder) {
    files_.reset();
    temporary_folder.clear();
  });
}

void StagedOutput::commit() {
  interruption_.hold_off([&](fs::path&) { files_->commit(); });
}

OutputFolder::OutputFolder(const fs::path& path) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path at = fs::absolute(path).lexically_normal(); !fs::exists(at, error) && at.has_relative_path();
       at = at.parent_path())
    if (at.has_filename()) missing.push_back(at);
  fs::create_directories(path, error);
  if (!fs::is_directory(path)) {
    if (error) throw_write_error(path.string() + ": cannot make this folder", error.value());
    throw WriteError(path.string() + ": is no folder");
  }
  made_ = std::move(missing);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  for (const fs::path& folder : made_) fs::remove(folder, ignored);  // leaves what holds anything
}

void write_file(const std::string& path, std::string_view bytes, Interruption& interruption) {
  if (is_stream(path)) return write_to_stream(path, bytes);  // may wait for a reader; an interruption ends that
  interruption.hold_off([&](fs::path&) { write_atomically(path, bytes); });
}

}  // namespace unsnarl::app
