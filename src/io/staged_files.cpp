#include "unsnarl/staged_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

fs::path with_links_followed(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  if (error) throw_write_error(path.string() + ": cannot follow the link", error.value());
  return target;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A rename is only safe from a loss of power once the folder is on the disk; some file systems cannot, which is fine.
void flush_folder(const fs::path& folder) {
  const int id = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (id < 0) return;
  static_cast<void>(::fsync(id));
  ::close(id);
}

void require_replaceable(const fs::path& target) {
  std::error_code ignored;
  if (fs::is_directory(target, ignored))
    throw WriteError(fmt::format("{}: is a folder; name a file in it", target.string()), EISDIR);
  if (!fs::exists(target, ignored)) return;
  if (!fs::is_regular_file(target, ignored))
    throw WriteError(fmt::format("{}: is not a regular file", target.string()));
  // Renaming would get past the protection of the old file.
  if (::access(target.c_str(), W_OK) != 0) throw_write_error(target.string() + ": is write-protected", errno);
}

}  // namespace

StagedFiles::StagedFiles(const fs::path& target) : target_(with_links_followed(target)) {
  require_replaceable(target_);
  std::string pattern = (folder_of(target_) / ".unsnarl-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw_write_error(
        fmt::format("{}: cannot create files in the folder {}", target.string(), folder_of(target_).string()), errno);
  folder_ = pattern;
}

StagedFiles::~StagedFiles() {
  std::error_code ignored;
  reserve_.reset();
  fs::remove_all(folder_, ignored);
}

void StagedFiles::write(const std::vector<OutputFile>& files) {
  names_.clear();
  for (const OutputFile& file : files) {
    const fs::path name = file.name.empty() ? target_.filename() : file.name;
    const fs::path staged = folder_ / name;
    std::error_code error;
    // Whoever interrupts the process may have removed folder_, which must not be made anew.
    if (name.has_parent_path()) fs::create_directories(staged.parent_path(), error);
    try {
      write_atomically(staged, file.bytes);
    } catch (const WriteError& e) {
      // The reader of the message knows the final name only.
      throw WriteError(fmt::format("{}: cannot be written ({})", (folder_of(target_) / name).string(), e.what()),
                       e.error_number());
    }
    names_.push_back(name);
  }
}

std::vector<fs::path> StagedFiles::targets() const {
  std::vector<fs::path> paths;
  for (const fs::path& name : names_) paths.push_back(folder_of(target_) / name);
  return paths;
}

void StagedFiles::commit() {
  // Either all files of a glTF, a GIFTI or a scene are the new ones, or none is.
  for (const fs::path& target : targets()) require_replaceable(target);
  for (std::size_t i = names_.size(); i-- > 0;) {
    const fs::path from = folder_ / names_[i], to = folder_of(target_) / names_[i];
    std::error_code error;
    fs::create_directories(folder_of(to), error);
    struct stat old {};
    if (::stat(to.c_str(), &old) == 0) {
      // The group may be one we are not in; then the permissions must not grow for another group.
      const bool same_group = ::chown(from.c_str(), static_cast<uid_t>(-1), old.st_gid) == 0;
      static_cast<void>(::chmod(from.c_str(), old.st_mode & (same_group ? 0777 : 0707)));
    }
    fs::rename(from, to, error);
    if (error) throw_write_error(to.string() + ": cannot be written", error.value());
  }
  flush_folder(folder_of(target_));
}

}  // namespace unsnarl
