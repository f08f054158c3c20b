#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "unsnarl/document.h"

namespace unsnarl {

/// Files on their way: written to a temporary folder beside the main one's place, from where they can be read back, and
/// renamed into place by commit(). Whatever fails before the renaming leaves every old file as it was and nothing new.
class StagedFiles {
 public:
  /// target: the place of the main file; a link is followed. Throws WriteError where its folder is missing or, like an
  /// existing target, must not be written to.
  explicit StagedFiles(const std::filesystem::path& target);
  /// Removes the temporary folder.
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Replaces what was written before; the first file is the main one, as of Document::patched(). Throws WriteError.
  void write(const std::vector<OutputFile>& files);
  const std::filesystem::path& folder() const { return folder_; }
  /// The place of the main file until commit().
  std::filesystem::path main_file() const { return folder_ / target_.filename(); }
  /// Final places of the files written.
  std::vector<std::filesystem::path> targets() const;
  /// Renames all into place, the main file last; what is replaced keeps its permissions. Throws WriteError.
  void commit();

 private:
  /// Bytes that removing the folder needs: listing one takes a buffer of 32 kB, which there may be none for where the
  /// work has ended for lack of memory.
  static constexpr std::size_t reserve_size = std::size_t{1} << 16;

  std::unique_ptr<char[]> reserve_{new char[reserve_size]};
  std::filesystem::path target_;  // links followed
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> names_;  // relative to both folders, the main file first
};

}  // namespace unsnarl
