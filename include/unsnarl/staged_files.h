#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "unsnarl/document.h"

namespace unsnarl {

/// A file that is to be replaced is not the one that was read any more.
class ChangedMeanwhile : public WriteError {
 public:
  using WriteError::WriteError;
};

/// Is nothing at this place, or a file that StagedFiles may replace?
bool can_be_replaced(const std::filesystem::path& place);

/// Files on their way, in any folders: add() writes them to temporary folders beside their places, from where they can
/// be read back; commit() moves all of them into place. Until then, and whatever fails, every old file is as it was and
/// nothing new is there.
class StagedFiles {
 public:
  enum class Links : std::uint8_t { followed, replaced };
  /// Runs a step in which the temporary folders (see folders()) change or their files move into place. A program that
  /// signals may end holds them off meanwhile.
  using Guard = std::function<void(const StagedFiles& files, const std::function<void()>& step)>;

  /// guard: unset: steps are simply run.
  explicit StagedFiles(Guard guard = {});
  /// Removes the temporary folders.
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Makes the temporary folder of files for this place. Throws WriteError where none can be made in the folder of
  /// `target`, or where `target` is there and cannot be replaced: a folder, a device, a mount point, write-protected.
  void open(const std::filesystem::path& target, Links links = Links::followed);
  /// open(), then the same for files beside the main one at `target`, of these names relative to its folder. They may
  /// be in subfolders, which commit() makes, but not be hidden (unless the main file is), and not be led elsewhere by
  /// links.
  void open_beside(const std::filesystem::path& target, const std::vector<std::filesystem::path>& names);

  /// Writes the files of a result, see Document::patched(), whose main file goes to `target`. Returns the place of the
  /// main file until commit(); the others lie beside it as they will. Throws WriteError.
  std::filesystem::path add(const std::filesystem::path& target, const std::vector<OutputFile>& files,
                            Links links = Links::followed);
  std::filesystem::path add(const std::filesystem::path& target, std::string_view bytes);

  /// Moves all into place, the first added last; what is replaced keeps its permissions. Each old file is first put
  /// aside in the temporary folder, from where it comes back if any move fails. Throws WriteError; ChangedMeanwhile
  /// where OutputFile::replaces is not what is there.
  void commit();

  /// The temporary folders, all to be removed whatever happens.
  std::vector<std::filesystem::path> folders() const;
  const Guard& guard() const { return guard_; }

 private:
  struct File {
    std::filesystem::path staged, target, old;
    std::optional<FileStamp> replaces;
  };
  class Moves;
  void guarded(const std::function<void()>& step) const;
  void make_folder(const std::filesystem::path& target, const std::filesystem::path& folder);
  void remove_folders();
  void move_into_place();
  void prepare() const;
  const File* changed_file() const;
  std::string where_old_files_are() const;
  void remove_known_files(const std::filesystem::path& staging) const;
  std::filesystem::path staging_of(const std::filesystem::path& target) const;

  /// Bytes that removing a folder needs: listing one takes a buffer of 32 kB, which there may be none for where the
  /// work has ended for lack of memory.
  static constexpr std::size_t reserve_size = std::size_t{1} << 16;

  Guard guard_;
  std::unique_ptr<char[]> reserve_;
  std::map<std::filesystem::path, std::filesystem::path> folders_;  // by the folder of the targets
  std::vector<File> files_;
  bool is_kept_ = false;  // the folders hold old files that could not be put back
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

}  // namespace unsnarl
