#include "staged_output.h"

#include <fmt/format.h>

#include <algorithm>

#include "standard_streams.h"

namespace unsnarl::app {

namespace fs = std::filesystem;

StagedOutput::~StagedOutput() {
  interruption_.hold_off([&](std::vector<fs::path>& temporary_folders) {
    for (const fs::path& folder : files_->folders()) std::erase(temporary_folders, folder);
    files_.reset();  // removes them
  });
}

/// The folders that an interruption removes are always those that there are.
void StagedOutput::hold_off(const std::function<void()>& action) {
  interruption_.hold_off([&](std::vector<fs::path>& temporary_folders) {
    for (const fs::path& folder : files_->folders()) std::erase(temporary_folders, folder);
    const auto note = [&] {
      for (const fs::path& folder : files_->folders()) temporary_folders.push_back(folder);
    };
    try {
      action();
    } catch (...) {
      note();
      throw;
    }
    note();
  });
}

void StagedOutput::open(const fs::path& target) {
  hold_off([&] { files_->open(target); });
}

void StagedOutput::open_beside(const fs::path& target, const std::vector<fs::path>& names) {
  hold_off([&] { files_->open_beside(target, names); });
}

fs::path StagedOutput::add(const fs::path& target, const std::vector<OutputFile>& files, StagedFiles::Links links) {
  hold_off([&] { files_->open(target, links); });
  return files_->add(target, files, links);
}

void StagedOutput::add(const std::string& path, std::string bytes) {
  if (is_stream(path)) return streams_.push_back({path, std::move(bytes)});
  hold_off([&] { files_->open(path); });
  files_->add(path, bytes);
}

void StagedOutput::commit() {
  for (const Stream& stream : streams_) write_to_stream(stream.path, stream.bytes);
  streams_.clear();
  hold_off([&] { files_->commit(); });
}

OutputFolder::OutputFolder(const fs::path& path) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path at = fs::absolute(path, error).lexically_normal(); !fs::exists(at, error) && at.has_relative_path();
       at = at.parent_path())
    if (at.has_filename()) missing.push_back(at);
  fs::create_directories(path, error);
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) {
    if (error) throw_write_error(path.string() + ": cannot make this folder", error.value());
    throw WriteError(path.string() + ": not a folder");
  }
  made_ = std::move(missing);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  for (const fs::path& folder : made_) fs::remove(folder, ignored);  // leaves what holds anything
}

void write_file(const std::string& path, std::string_view bytes, Interruption& interruption) {
  if (is_stream(path)) return write_to_stream(path, bytes);  // may wait for a reader; an interruption ends that
  StagedOutput file(interruption);
  file.add(path, std::string(bytes));
  file.commit();
}

}  // namespace unsnarl::app
