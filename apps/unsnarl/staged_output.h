#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "interruption.h"
#include "unsnarl/document.h"

namespace unsnarl::app {

/// Output files on their way: written to a temporary folder beside the target, from where they can be read back, and
/// renamed into place by commit(). Whatever happens before that, nothing is left behind.
class StagedOutput {
 public:
  /// Throws WriteError where the folder of `target` is missing or, like an existing target, must not be written to.
  StagedOutput(const std::filesystem::path& target, Interruption& interruption);
  ~StagedOutput();
  StagedOutput(const StagedOutput&) = delete;
  StagedOutput& operator=(const StagedOutput&) = delete;

  /// Replaces what was written before. Throws WriteError.
  void write(const std::vector<OutputFile>& files);
  /// The place of the main file until commit().
  std::filesystem::path main_file() const { return folder_ / target_.filename(); }
  /// The same of a file of this name, relative to the folder of the target.
  std::filesystem::path staged(const std::filesystem::path& name) const { return folder_ / name; }
  /// Final places of the files written.
  std::vector<std::filesystem::path> targets() const;
  /// Renames all into place, the main file last. Throws WriteError.
  void commit();

 private:
  void rename_all() const;

  /// Bytes that removing the folder needs: listing one takes a buffer of 32 kB, which there may be none for where the
  /// work has ended for lack of memory.
  static constexpr std::size_t reserve_size = std::size_t{1} << 16;

  std::unique_ptr<char[]> reserve_{new char[reserve_size]};
  std::filesystem::path target_;  // links followed
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> names_;  // relative to both folders, the main file first
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
