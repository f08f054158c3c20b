#include "platform/files.h"

#include <fcntl.h>
#include <glob.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <utility>

namespace unsnarl::platform {
namespace {

namespace fs = std::filesystem;

class Descriptor {
 public:
  explicit Descriptor(int id) : id_(id) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (id_ >= 0) ::close(id_);
  }
  int id() const { return id_; }
  bool close() { return ::close(std::exchange(id_, -1)) == 0; }

 private:
  int id_;
};

int error_of(int result) {
  return result == 0 ? 0 : errno;
}

FileStatus made_of(const struct stat& status) {
#ifdef __APPLE__
  const timespec& modified = status.st_mtimespec;
#else
  const timespec& modified = status.st_mtim;
#endif
  const FileKind kind = S_ISREG(status.st_mode)   ? FileKind::file
                        : S_ISDIR(status.st_mode) ? FileKind::folder
                                                  : FileKind::other;
  return {kind, {status.st_dev, status.st_ino, status.st_size, modified.tv_sec, modified.tv_nsec}};
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

FileStatus status_of(const fs::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? made_of(status) : FileStatus();
}

InputFile::InputFile(const fs::path& path, Opening opening)
    : descriptor_(opening == Opening::at_once ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)
                                              : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)),
      error_(descriptor_ < 0 ? errno : 0),
      is_owned_(descriptor_ >= 0) {}

InputFile::~InputFile() {
  if (is_owned_) ::close(descriptor_);
}

FileStatus InputFile::status() {
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0) return made_of(status);
  error_ = errno;
  return {};
}

std::size_t InputFile::read(char* bytes, std::size_t size) {
  ssize_t got = 0;
  do got = ::read(descriptor_, bytes, size);
  while (got < 0 && errno == EINTR);
  error_ = got < 0 ? errno : 0;
  return got < 0 ? 0 : static_cast<std::size_t>(got);
}

int write_new_file(const fs::path& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  const bool is_whole = file.id() >= 0 && write_all(file.id(), bytes) && ::fsync(file.id()) == 0 && file.close();
  return is_whole ? 0 : errno;
}

int write_to_device(const fs::path& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  const bool is_whole = file.id() >= 0 && write_all(file.id(), bytes) && file.close();
  return is_whole ? 0 : errno;
}

int why_not_writable(const fs::path& file) {
  return error_of(::access(file.c_str(), W_OK));
}

int why_not_writable_folder(const fs::path& folder) {
  return error_of(::access(folder.c_str(), W_OK | X_OK));
}

bool is_mount_point(const fs::path& path) {
#ifdef STATX_ATTR_MOUNT_ROOT
  struct statx status {};
  return ::statx(AT_FDCWD, path.c_str(), AT_SYMLINK_NOFOLLOW, STATX_TYPE, &status) == 0 &&
         (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
#else
  static_cast<void>(path);
  return false;
#endif
}

void copy_permissions(const fs::path& from, const fs::path& to) {
  struct stat old {};
  if (::stat(from.c_str(), &old) != 0) return;
  // The group may be one we are not in; then the permissions must not grow for another group.
  const bool same_group = ::chown(to.c_str(), static_cast<uid_t>(-1), old.st_gid) == 0;
  static_cast<void>(::chmod(to.c_str(), old.st_mode & (same_group ? 0777 : 0707)));
}

int move_file(const fs::path& from, const fs::path& to) {
  return error_of(::rename(from.c_str(), to.c_str()));
}

int give_second_name(const fs::path& file, const fs::path& name) {
  return error_of(::linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name.c_str(), 0));
}

int remove_file(const fs::path& file) {
  return error_of(::unlink(file.c_str()));
}

int make_folder(const fs::path& folder) {
  return error_of(::mkdir(folder.c_str(), 0777));
}

int remove_folder(const fs::path& folder) {
  return error_of(::rmdir(folder.c_str()));
}

void flush_folder(const fs::path& folder) {
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.id() >= 0) static_cast<void>(::fsync(opened.id()));
}

int make_temporary_folder(const fs::path& parent, const std::string& prefix, fs::path& made) {
  std::string pattern = (parent / (prefix + "XXXXXX")).string();
  if (::mkdtemp(pattern.data()) == nullptr) return errno;
  made = std::move(pattern);
  return 0;
}

int find_matches(const std::string& pattern, bool (*is_failure)(int error_number), std::vector<std::string>& paths) {
  glob_t found{};
  // glob() hands nothing on to its callback.
  thread_local bool (*stops)(int error_number);
  thread_local int failure;
  stops = is_failure;
  failure = 0;
  const auto note_failure = [](const char*, int error_number) -> int {
    if (stops(error_number)) failure = error_number;
    return failure;
  };
  const int status = ::glob(pattern.c_str(), 0, note_failure, &found);
  paths.insert(paths.end(), found.gl_pathv, found.gl_pathv + (status == 0 ? found.gl_pathc : 0));
  ::globfree(&found);
  if (status == GLOB_NOSPACE) throw std::bad_alloc();
  return failure;
}

}  // namespace unsnarl::platform
