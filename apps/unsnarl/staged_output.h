#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "interruption.h"
#include "unsnarl/document.h"

namespace unsnarl::app {

/// Output files on their way: written to a temporary folder beside the target, from where they can be read back, and
/// renamed into place by commit(). Whatever happens before that, nothing is left behind.
class StagedOutput {
 public:
  /// Throws WriteError where the folder of `target` is missing or cannot be written to.
  StagedOutput(const std::filesystem::path& target, Interruption& interruption);
  ~StagedOutput();
  StagedOutput(const StagedOutput&) = delete;
  StagedOutput& operator=(const StagedOutput&) = delete;

  /// Replaces what was written before. Throws WriteError.
  void write(const std::vector<OutputFile>& files);
  /// Where the main file lies until commit().
  std::filesystem::path main_file() const { return folder_ / target_.filename(); }
  /// Final places of the files written.
  std::vector<std::filesystem::path> targets() const;
  /// Renames all into place, the main file last. Throws WriteError.
  void commit();

 private:
  std::filesystem::path target_;  // links followed
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> names_;  // relative to both folders, the main file first
  Interruption& interruption_;
};

/// Standard output, a device or a pipe: there is nothing to rename, nor to read back.
bool is_stream(const std::string& path);
/// Throws WriteError.
void write_to_stream(const std::string& path, std::string_view bytes);

}  // namespace unsnarl::app
