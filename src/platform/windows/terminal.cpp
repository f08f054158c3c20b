#include "platform/terminal.h"

#include <windows.h>
//
#include <fcntl.h>
#include <io.h>
#include <shellapi.h>

#include <cstdio>
#include <memory>

#include "platform/windows/system.h"

namespace unsnarl::platform {
namespace {

bool is_console(DWORD stream) {
  DWORD mode = 0;
  return ::GetConsoleMode(::GetStdHandle(stream), &mode) != 0;
}

/// Lines of progress move the cursor.
void let_text_move_the_cursor(DWORD stream) {
  constexpr DWORD processes_sequences = 0x0004;  ///< ENABLE_VIRTUAL_TERMINAL_PROCESSING (fixed by Windows)
  DWORD mode = 0;
  const HANDLE console = ::GetStdHandle(stream);
  if (::GetConsoleMode(console, &mode)) ::SetConsoleMode(console, mode | processes_sequences);
}

}  // namespace

void prepare_standard_streams() {
  for (const int id : {0, 1, 2}) {
    if (::_get_osfhandle(id) < 0) {  // -1, -2: it was closed at the start
      const int nothing = ::_open("NUL", (id == 1 ? _O_RDONLY : _O_RDWR) | _O_BINARY);
      if (nothing >= 0 && nothing != id) {
        ::_dup2(nothing, id);
        ::_close(nothing);
      }
    }
    ::_setmode(id, _O_BINARY);
  }
  if (is_console(STD_OUTPUT_HANDLE) || is_console(STD_ERROR_HANDLE)) ::SetConsoleOutputCP(CP_UTF8);
  let_text_move_the_cursor(STD_ERROR_HANDLE);
}

std::vector<std::string> command_line(int, char**) {
  struct Freed {
    void operator()(wchar_t** words) const { ::LocalFree(words); }
  };
  int count = 0;
  const std::unique_ptr<wchar_t*, Freed> words(::CommandLineToArgvW(::GetCommandLineW(), &count));
  std::vector<std::string> texts;
  for (int k = 1; k < count; ++k) texts.push_back(utf8_of(words.get()[k]));
  return texts;
}

bool is_terminal_of_standard_error() {
  return is_console(STD_ERROR_HANDLE);
}

std::size_t terminal_width() {
  CONSOLE_SCREEN_BUFFER_INFO screen{};
  if (!::GetConsoleScreenBufferInfo(::GetStdHandle(STD_OUTPUT_HANDLE), &screen)) return 0;
  return static_cast<std::size_t>(screen.srWindow.Right - screen.srWindow.Left + 1);
}

}  // namespace unsnarl::platform
