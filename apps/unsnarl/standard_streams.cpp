#include "standard_streams.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>

#include "mesh_input.h"
#include "unsnarl/document.h"
#include "unsnarl/visible_text.h"

namespace unsnarl::app {

void open_missing_streams() {
  for (const int id : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is taken, which is this one. A result for a standard output that is closed is not lost
    // without a word: writing to it fails.
    const int mode = id == STDOUT_FILENO ? O_RDONLY : O_RDWR;
    if (::fcntl(id, F_GETFD) < 0 && errno == EBADF) static_cast<void>(::open("/dev/null", mode));
  }
}

void tell(std::string_view lines) {
  std::string text;
  for (std::size_t end = 0; (end = lines.find('\n')) != lines.npos; lines.remove_prefix(end + 1))
    text += visible_text(lines.substr(0, end)) + '\n';
  draw(text + visible_text(lines));
}

void draw(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

bool is_stream(const std::string& path) {
  if (path == standard_stream) return true;
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

void write_to_stream(const std::string& path, std::string_view bytes) {
  if (path != standard_stream) return write_atomically(path, bytes);
  std::cout.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  std::cout.flush();
  if (!std::cout)
    throw WriteError("standard output: cannot write; it is closed, its reader has gone, or the disk is full");
}

}  // namespace unsnarl::app
