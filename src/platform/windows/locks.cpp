#include "platform/locks.h"

#include <fcntl.h>
#include <io.h>

#include "platform/windows/system.h"

namespace unsnarl::platform {
namespace {

HANDLE handle_of(int descriptor) {
  return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
}

/// Locks a byte far behind the end of the file: nobody else can read a locked byte, and all may read the lines.
bool lock_by(int descriptor, DWORD flags) {
  OVERLAPPED place{};
  place.OffsetHigh = 0x40000000;
  return ::LockFileEx(handle_of(descriptor), LOCKFILE_EXCLUSIVE_LOCK | flags, 0, 1, 0, &place) != 0;
}

}  // namespace

LockedFile::~LockedFile() {
  if (descriptor_ >= 0) ::_close(descriptor_);
}

int LockedFile::open(const std::filesystem::path& path) {
  Handle file = owned(::CreateFileW(path.c_str(), GENERIC_READ | FILE_APPEND_DATA,
                                    FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, OPEN_ALWAYS,
                                    FILE_ATTRIBUTE_NORMAL, nullptr));
  if (!file) return last_errno();
  descriptor_ = ::_open_osfhandle(reinterpret_cast<intptr_t>(file.get()), _O_APPEND | _O_BINARY);
  if (descriptor_ < 0) return errno;
  file.release();  // the descriptor's now
  return 0;
}

bool LockedFile::try_lock() {
  if (lock_by(descriptor_, LOCKFILE_FAIL_IMMEDIATELY)) return true;
  const DWORD error = ::GetLastError();
  return error != ERROR_LOCK_VIOLATION && error != ERROR_IO_PENDING;
}

void LockedFile::lock() {
  lock_by(descriptor_, 0);
}

bool LockedFile::ends_in_the_middle_of_a_line() const {
  LARGE_INTEGER size{};
  if (!::GetFileSizeEx(handle_of(descriptor_), &size) || size.QuadPart == 0) return false;
  OVERLAPPED place{};
  place.Offset = static_cast<DWORD>(size.QuadPart - 1);
  place.OffsetHigh = static_cast<DWORD>((size.QuadPart - 1) >> 32);
  char last = '\n';
  DWORD got = 0;
  return ::ReadFile(handle_of(descriptor_), &last, 1, &got, &place) && got == 1 && last != '\n';
}

int LockedFile::append(std::string_view bytes) {
  OVERLAPPED place{};
  place.Offset = place.OffsetHigh = 0xFFFFFFFF;  // the end of the file, wherever that is by then
  DWORD written = 0;
  if (!::WriteFile(handle_of(descriptor_), bytes.data(), static_cast<DWORD>(bytes.size()), &written, &place))
    return last_errno();
  return written == bytes.size() ? 0 : ENOSPC;
}

}  // namespace unsnarl::platform
