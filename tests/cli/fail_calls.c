/* Makes one call of the system fail, for programs that are run with this in LD_PRELOAD: call number FAIL_AT (from 1) of
 * the kind FAIL_WHAT, as with a full disk, a lost file server or no permission, where it concerns a path or a file
 * below FAIL_BELOW. FAIL_MODE=after: so do all later ones; FAIL_MODE=kill: the process ends there at once;
 * FAIL_MODE=edit: it does not fail, but somebody appends to the file FAIL_EDIT right before. Each call of the kind is
 * counted in the size of the file FAIL_COUNT, if it is set. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static atomic_long calls;

static void append(const char* path, const char* text) {
  if (path == NULL) return;
  const int file = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND, 0600);
  if (file < 0) return;
  syscall(SYS_write, file, text, strlen(text));
  syscall(SYS_close, file);
}

static int fails(const char* kind, const char* path) {
  const char *what = getenv("FAIL_WHAT"), *below = getenv("FAIL_BELOW"), *at = getenv("FAIL_AT"),
             *mode = getenv("FAIL_MODE");
  if (what == NULL || below == NULL || strcmp(what, kind) != 0 || path == NULL) return 0;
  if (strncmp(path, below, strlen(below)) != 0) return 0;
  const long number = ++calls, wanted = at == NULL ? 0 : atol(at);
  append(getenv("FAIL_COUNT"), ".");
  const int is_after = mode != NULL && strcmp(mode, "after") == 0;
  if (wanted <= 0 || (is_after ? number < wanted : number != wanted)) return 0;
  if (mode != NULL && strcmp(mode, "kill") == 0) _exit(137);
  if (mode != NULL && strcmp(mode, "edit") == 0) {
    append(getenv("FAIL_EDIT"), "# edited\n");
    return 0;
  }
  errno = EIO;
  return 1;
}

static int fails_of_file(const char* kind, int file) {
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t size = readlink(link, path, sizeof path - 1);
  if (size < 0) return 0;
  path[size] = '\0';
  return fails(kind, path);
}

#define REAL(name, type, arguments) \
  static type(*real) arguments;     \
  if (real == NULL) real = (type(*) arguments)dlsym(RTLD_NEXT, #name)

ssize_t write(int file, const void* bytes, size_t size) {
  REAL(write, ssize_t, (int, const void*, size_t));
  return fails_of_file("write", file) ? -1 : real(file, bytes, size);
}
int fsync(int file) {
  REAL(fsync, int, (int));
  return fails_of_file("fsync", file) ? -1 : real(file);
}
int close(int file) {
  REAL(close, int, (int));
  if (!fails_of_file("close", file)) return real(file);
  real(file);
  errno = EIO;
  return -1;
}
int rename(const char* from, const char* to) {
  REAL(rename, int, (const char*, const char*));
  return fails("rename", to) ? -1 : real(from, to);
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  REAL(linkat, int, (int, const char*, int, const char*, int));
  return fails("link", to) ? -1 : real(from_folder, from, to_folder, to, flags);
}
int unlink(const char* path) {
  REAL(unlink, int, (const char*));
  return fails("unlink", path) ? -1 : real(path);
}
int mkdir(const char* path, mode_t mode) {
  REAL(mkdir, int, (const char*, mode_t));
  return fails("mkdir", path) ? -1 : real(path, mode);
}
char* mkdtemp(char* pattern) {
  REAL(mkdtemp, char*, (char*));
  return fails("mkdir", pattern) ? NULL : real(pattern);
}
#define OPEN(name)                                             \
  int name(const char* path, int flags, ...) {                 \
    REAL(name, int, (const char*, int, ...));                  \
    mode_t mode = 0;                                           \
    if (flags & O_CREAT) {                                     \
      va_list more;                                            \
      va_start(more, flags);                                   \
      mode = va_arg(more, mode_t);                             \
      va_end(more);                                            \
    }                                                          \
    return fails("open", path) ? -1 : real(path, flags, mode); \
  }
OPEN(open)
OPEN(open64)
