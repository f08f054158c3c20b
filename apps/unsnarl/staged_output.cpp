#include "staged_output.h"

#include <algorithm>

#include "standard_streams.h"
#include "unsnarl/paths.h"

namespace unsnarl::app {

namespace fs = std::filesystem;

namespace {

/// Signals wait while temporary folders change, and the folders that an interruption removes are always those that
/// there are.
StagedFiles::Guard held_off(Interruption& interruption) {
  return [&interruption](const StagedFiles& files, const std::function<void()>& step) {
    interruption.hold_off([&](std::vector<fs::path>& temporary_folders) {
      for (const fs::path& folder : files.folders()) std::erase(temporary_folders, folder);
      const auto note = [&] {
        for (const fs::path& folder : files.folders()) temporary_folders.push_back(folder);
      };
      try {
        step();
      } catch (...) {
        note();
        throw;
      }
      note();
    });
  };
}

}  // namespace

StagedOutput::StagedOutput(Interruption& interruption) : files_(held_off(interruption)) {}

void StagedOutput::add(const std::string& path, std::string bytes) {
  if (is_stream(path)) return streams_.push_back({path, std::move(bytes)});
  files_.add(path_of(path), bytes);
}

void StagedOutput::write_streams() {
  for (const Stream& stream : streams_) write_to_stream(stream.path, stream.bytes);
  streams_.clear();
}

void StagedOutput::commit() {
  write_streams();
  files_.commit();
}

void write_file(const std::string& path, std::string_view bytes, Interruption& interruption) {
  if (is_stream(path)) return write_to_stream(path, bytes);  // may wait for a reader; an interruption ends that
  StagedOutput file(interruption);
  file.add(path, std::string(bytes));
  file.commit();
}

}  // namespace unsnarl::app
