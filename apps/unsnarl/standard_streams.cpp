#include "standard_streams.h"

#include <cstdio>
#include <iostream>

#include "mesh_input.h"
#include "platform/files.h"
#include "unsnarl/document.h"
#include "unsnarl/paths.h"
#include "unsnarl/visible_text.h"

namespace unsnarl::app {

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
  return platform::status_of(path_of(path)).kind == platform::FileKind::other;
}

void write_to_stream(const std::string& path, std::string_view bytes) {
  if (path != standard_stream) return write_atomically(path_of(path), bytes);
  std::cout.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  std::cout.flush();
  if (!std::cout)
    throw WriteError("standard output: cannot write; it is closed, its reader has gone, or the disk is full");
}

}  // namespace unsnarl::app
