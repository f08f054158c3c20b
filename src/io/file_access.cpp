#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "io/mesh_file.h"

namespace unsnarl {
namespace {

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

void write_directly(const std::filesystem::path& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.id() < 0 || !write_all(file.id(), bytes) || !file.close()) {
    throw_write_error(path.string() + ": cannot write", errno);
  }
}

/// A file next to the target that is removed again unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) {
    for (int attempt = 0; attempt < 1000; ++attempt) {
      path_ = target.parent_path() / fmt::format(".{}.{}-{}", target.filename().string(), ::getpid(), attempt);
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ >= 0 || errno != EEXIST) return;
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
  }

  bool is_open() const { return descriptor_ >= 0; }
  bool fill(std::string_view bytes) { return write_all(descriptor_, bytes) && ::fsync(descriptor_) == 0; }
  void take_permissions(const struct stat& from) {
    // The group may be one we are not in; then the permissions must not grow for another group.
    const bool same_group = ::fchown(descriptor_, static_cast<uid_t>(-1), from.st_gid) == 0;
    static_cast<void>(::fchmod(descriptor_, from.st_mode & (same_group ? 0777 : 0707)));
  }
  bool rename_to(const std::filesystem::path& target) {
    renamed_ = ::rename(path_.c_str(), target.c_str()) == 0;
    return renamed_;
  }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

}  // namespace

std::string read_file(const std::filesystem::path& path, const std::function<void(std::string_view)>& check_start) {
  // O_NONBLOCK: opening a pipe that nobody writes to must not hang.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (file.id() < 0 || ::fstat(file.id(), &status) != 0) {
    throw_read_error(path.string() + ": cannot open", errno);
  }
  if (S_ISDIR(status.st_mode))
    throw FileError(
        fmt::format("{}: is a folder; name a mesh file, or repair all in it with 'unsnarl batch'", path.string()),
        EISDIR);
  if (!S_ISREG(status.st_mode)) {
    throw FileError(fmt::format("{}: is not a regular file; pipe it in through standard input ('-')", path.string()));
  }
  std::string bytes;
  const auto read_up_to = [&](std::size_t end) {
    std::size_t size = bytes.size();
    bytes.resize(end);
    while (size < end) {
      const ssize_t got = ::read(file.id(), bytes.data() + size, end - size);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw_read_error(path.string() + ": cannot read", errno);
      if (got == 0) break;
      size += static_cast<std::size_t>(got);
    }
    bytes.resize(size);
  };
  const auto whole = static_cast<std::size_t>(status.st_size);
  if (check_start) {
    read_up_to(std::min(whole, checked_start));
    check_start(bytes);
    bytes.reserve(whole);
  }
  read_up_to(whole);
  return bytes;
}

bool is_inside_folder(const std::filesystem::path& name) {
  if (name.empty() || name.is_absolute() || name.string().find('\0') != std::string::npos) return false;
  return std::none_of(name.begin(), name.end(), [](const std::filesystem::path& part) { return part == ".."; });
}

void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  std::filesystem::path target = path;
  std::error_code error;
  if (std::filesystem::is_symlink(path, error)) {
    target = std::filesystem::weakly_canonical(path, error);
    if (error) throw_write_error(path.string() + ": cannot follow the link", error.value());
  }
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) {
    throw WriteError(fmt::format("{}: is a folder; name a file", path.string()), EISDIR);
  }
  if (exists && !S_ISREG(status.st_mode)) return write_directly(target, bytes);
  // Renaming would get past the protection of the old file.
  if (exists && ::access(target.c_str(), W_OK) != 0) {
    throw_write_error(path.string() + ": is write-protected", errno);
  }

  TemporaryFile temporary(target);
  if (!temporary.is_open()) {
    throw_write_error(path.string() + ": cannot create a file in its folder", errno);
  }
  if (exists) temporary.take_permissions(status);
  if (!temporary.fill(bytes) || !temporary.rename_to(target)) {
    throw_write_error(path.string() + ": cannot write", errno);
  }
  // The new name is only safe once the folder is on the disk too; some file systems cannot do this, which is no error.
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  Descriptor handle(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (handle.id() >= 0) static_cast<void>(::fsync(handle.id()));
}

}  // namespace unsnarl
