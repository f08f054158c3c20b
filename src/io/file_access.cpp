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
#include "unsnarl/staged_files.h"

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

}  // namespace

FileStamp::FileStamp(const struct stat& status)
    : device(status.st_dev),
      inode(status.st_ino),
      size(status.st_size),
#ifdef __APPLE__
      modified_s(status.st_mtimespec.tv_sec),
      modified_ns(status.st_mtimespec.tv_nsec) {
}
#else
      modified_s(status.st_mtim.tv_sec),
      modified_ns(status.st_mtim.tv_nsec) {
}
#endif

std::string read_file(const std::filesystem::path& path) {
  return read_stamped_file(path).bytes;
}

FileRead read_stamped_file(const std::filesystem::path& path,
                           const std::function<void(std::string_view)>& check_start) {
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
  return {std::move(bytes), FileStamp(status)};
}

bool is_inside_folder(const std::filesystem::path& name) {
  if (name.empty() || name.is_absolute() || name.string().find('\0') != std::string::npos) return false;
  return std::none_of(name.begin(), name.end(), [](const std::filesystem::path& part) { return part == ".."; });
}

int write_new_file(const std::filesystem::path& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  const bool is_whole = file.id() >= 0 && write_all(file.id(), bytes) && ::fsync(file.id()) == 0 && file.close();
  return is_whole ? 0 : errno;
}

void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  struct stat status {};
  const bool is_device = ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
  if (is_device) return write_directly(path, bytes);
  StagedFiles files;
  files.add(path, bytes);
  files.commit();
}

}  // namespace unsnarl
