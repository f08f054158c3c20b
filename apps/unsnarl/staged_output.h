#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "interruption.h"
#include "unsnarl/staged_files.h"

namespace unsnarl::app {

/// All that one call writes: StagedFiles that an interruption removes, or lets be moved to the last, and streams.
class StagedOutput {
 public:
  explicit StagedOutput(Interruption& interruption);

  StagedFiles& files() { return files_; }
  /// As of StagedFiles.
  std::filesystem::path add(const std::filesystem::path& target, const std::vector<OutputFile>& files) {
    return files_.add(target, files);
  }
  /// A file of its own, or a stream, which is written to by commit().
  void add(const std::string& path, std::string bytes);
  /// Streams cannot be taken back, so they come before files are moved into place. Throws WriteError.
  void write_streams();
  /// write_streams(), then moves all files into place. Throws WriteError.
  void commit();

 private:
  struct Stream {
    std::string path, bytes;
  };

  StagedFiles files_;
  std::vector<Stream> streams_;
};

/// A file of its own, whole or not at all; or a stream. Throws WriteError.
void write_file(const std::string& path, std::string_view bytes, Interruption& interruption);

}  // namespace unsnarl::app
