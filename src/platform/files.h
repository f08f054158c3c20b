#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "unsnarl/file_stamp.h"

/// The headers of this layer hold what the program and the library ask of the system beyond the standard library: a
/// header a concern, with a file for each system. Errors are errno (<cerrno>) on every system; 0: there is none.
namespace unsnarl::platform {

/// The errno of an error of the standard library, whose own numbers are those of the system.
inline int errno_of(const std::error_code& error) {
  return error.default_error_condition().value();
}

enum class FileKind : std::uint8_t { none, file, folder, other };
struct FileStatus {
  FileKind kind = FileKind::none;
  FileStamp stamp;  ///< of what is there
};
/// Returns what is at this place; follows links and allocates nothing.
FileStatus status_of(const std::filesystem::path& path);

/// A file, a pipe or a device that is open for reading until this goes.
class InputFile {
 public:
  /// Whether opening a pipe waits until somebody writes to it.
  enum class Opening : std::uint8_t { waits, at_once };
  InputFile(const std::filesystem::path& path, Opening opening);
  static InputFile standard_input() { return {}; }
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Why it could not be opened, or the last read() failed.
  int error() const { return error_; }
  FileStatus status();
  /// Returns how many bytes it got, at most `size`; 0: there are no more, or error().
  std::size_t read(char* bytes, std::size_t size);

 private:
  InputFile() = default;

  int descriptor_ = 0;
  int error_ = 0;
  bool is_owned_ = false;
};

/// Makes a file that was not there, on the disk when this returns. Returns the errno of what failed.
int write_new_file(const std::filesystem::path& path, std::string_view bytes);
/// Writes to a device or a pipe that is there.
int write_to_device(const std::filesystem::path& path, std::string_view bytes);

/// May this process write to the file, or make files in the folder? Returns the errno that would come of it.
int why_not_writable(const std::filesystem::path& file);
int why_not_writable_folder(const std::filesystem::path& folder);
/// Is this a mount point, which no other file can take the place of?
bool is_mount_point(const std::filesystem::path& path);
/// Lets whoever may use the file `from` use `to`, and nobody else, as far as this process may say so.
void copy_permissions(const std::filesystem::path& from, const std::filesystem::path& to);

// Moves and the like. Each returns the errno of its failure, and allocates nothing.

/// Puts the file in the place of another one, if there is one, in one step.
int move_file(const std::filesystem::path& from, const std::filesystem::path& to);
/// Gives the file a second name; some file systems have none.
int give_second_name(const std::filesystem::path& file, const std::filesystem::path& name);
int remove_file(const std::filesystem::path& file);
int make_folder(const std::filesystem::path& folder);
/// Removes an empty folder.
int remove_folder(const std::filesystem::path& folder);
/// Makes moves in the folder safe from a loss of power, where the file system can do that.
void flush_folder(const std::filesystem::path& folder);

/// Makes a folder for this user alone, in `parent`, of a name that begins with `prefix`. Returns the errno of its
/// failure.
int make_temporary_folder(const std::filesystem::path& parent, const std::string& prefix, std::filesystem::path& made);

/// Appends the paths that a pattern with *, ? and [...] stands for. A folder that cannot be listed holds none, unless
/// is_failure(its errno): then that is returned.
int find_matches(const std::string& pattern, bool (*is_failure)(int error_number), std::vector<std::string>& paths);

}  // namespace unsnarl::platform
