#include "platform/terminal.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>

namespace unsnarl::platform {

void prepare_standard_streams() {
  for (const int id : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const int mode = id == STDOUT_FILENO ? O_RDONLY : O_RDWR;
    // The lowest free number is taken, which is this one.
    if (::fcntl(id, F_GETFD) < 0 && errno == EBADF) static_cast<void>(::open("/dev/null", mode));
  }
}

std::vector<std::string> command_line(int argc, char** argv) {
  return {argv + 1, argv + argc};
}

bool is_terminal_of_standard_error() {
  return ::isatty(STDERR_FILENO) != 0;
}

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace unsnarl::platform
