// Preloaded into a program, makes what it does with some files fail as a broken disk or a process without descriptors
// would: UNSNARL_FAIL_FILE is what the paths of these files end with, UNSNARL_FAIL_CALL "open" or "read",
// UNSNARL_FAIL_ERRNO the errno.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

bool fails(std::string_view call, std::string_view path) {
  const char* const file = std::getenv("UNSNARL_FAIL_FILE");
  if (file == nullptr || std::getenv("UNSNARL_FAIL_CALL") != call || !path.ends_with(file)) return false;
  errno = std::atoi(std::getenv("UNSNARL_FAIL_ERRNO"));
  return true;
}

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

int open_by(const char* name, const char* path, int flags, va_list more) {
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  return fails("open", path) ? -1 : real<int (*)(const char*, int, ...)>(name)(path, flags, mode);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int file = open_by("open", path, flags, more);
  va_end(more);
  return file;
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int file = open_by("open64", path, flags, more);
  va_end(more);
  return file;
}

ssize_t read(int file, void* bytes, std::size_t count) {
  char path[4096];
  const ssize_t length = ::readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), path, sizeof path);
  if (length > 0 && fails("read", {path, static_cast<std::size_t>(length)})) return -1;
  return real<ssize_t (*)(int, void*, std::size_t)>("read")(file, bytes, count);
}
}
