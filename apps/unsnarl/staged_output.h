#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "interruption.h"
#include "unsnarl/staged_files.h"

namespace unsnarl::app {

/// StagedFiles that an interruption removes, or lets be renamed to the last.
class StagedOutput {
 public:
  /// Throws WriteError as StagedFiles does.
  StagedOutput(const std::filesystem::path& target, Interruption& interruption);
  ~StagedOutput();
  StagedOutput(const StagedOutput&) = delete;
  StagedOutput& operator=(const StagedOutput&) = delete;

  void write(const std::vector<OutputFile>& files) { files_->write(files); }
  std::filesystem::path main_file() const { return files_->main_file(); }
  /// The place of a file of this name, relative to the folder of the target, until commit().
  std::filesystem::path staged(const std::filesystem::path& name) const { return files_->folder() / name; }
  std::vector<std::filesystem::path> targets() const { return files_->targets(); }
  void commit();

 private:
  std::optional<StagedFiles> files_;
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
