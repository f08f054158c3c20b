#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "interruption.h"
#include "unsnarl/staged_files.h"

namespace unsnarl::app {

/// All that one call writes: StagedFiles that an interruption removes, or lets be moved to the last, and streams.
class StagedOutput {
 public:
  explicit StagedOutput(Interruption& interruption) : interruption_(interruption) {}
  ~StagedOutput();
  StagedOutput(const StagedOutput&) = delete;
  StagedOutput& operator=(const StagedOutput&) = delete;

  // As of StagedFiles.
  void open(const std::filesystem::path& target);
  void open_beside(const std::filesystem::path& target, const std::vector<std::filesystem::path>& names);
  std::filesystem::path add(const std::filesystem::path& target, const std::vector<OutputFile>& files,
                            StagedFiles::Links links = StagedFiles::Links::followed);
  /// A file of its own, or a stream, which is written to by commit().
  void add(const std::string& path, std::string bytes);
  /// Writes to the streams, which cannot be taken back, then moves all files into place. Throws WriteError.
  void commit();

 private:
  struct Stream {
    std::string path, bytes;
  };
  void hold_off(const std::function<void()>& action);

  std::optional<StagedFiles> files_{std::in_place};
  std::vector<Stream> streams_;
  Interruption& interruption_;
};

/// A folder for outputs, made where it is missing. What was made is removed again if nothing came to lie in it.
class OutputFolder {
 public:
  /// Throws WriteError where it cannot be made, or is no folder.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  // the innermost first
};

/// A file of its own, whole or not at all; or a stream. Throws WriteError.
void write_file(const std::string& path, std::string_view bytes, Interruption& interruption);

}  // namespace unsnarl::app
