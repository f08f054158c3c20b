#include "platform/locks.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace unsnarl::platform {

LockedFile::~LockedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

int LockedFile::open(const std::filesystem::path& path) {
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  return descriptor_ < 0 ? errno : 0;
}

bool LockedFile::try_lock() {
  return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

void LockedFile::lock() {
  while (::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
  }
}

bool LockedFile::ends_in_the_middle_of_a_line() const {
  const off_t size = ::lseek(descriptor_, 0, SEEK_END);
  char last = '\n';
  return size > 0 && ::pread(descriptor_, &last, 1, size - 1) == 1 && last != '\n';
}

int LockedFile::append(std::string_view bytes) {
  const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
  if (written == static_cast<ssize_t>(bytes.size())) return 0;
  return written < 0 ? errno : ENOSPC;
}

}  // namespace unsnarl::platform
