#include "input_bytes.h"

#include <array>

#include "mesh_input.h"
#include "platform/files.h"
#include "unsnarl/paths.h"

namespace unsnarl::app {
void read_pieces(const std::string& path, const std::function<void(std::string_view)>& take,
                 const std::string& advice) {
  const std::string name = path == standard_stream ? "standard input" : path;
  platform::InputFile input = path == standard_stream
                                  ? platform::InputFile::standard_input()
                                  : platform::InputFile(path_of(path), platform::InputFile::Opening::waits);
  if (input.error() != 0) throw_read_error(name + ": cannot open", input.error(), advice);
  std::array<char, 1 << 16> piece;
  while (const std::size_t got = input.read(piece.data(), piece.size())) take({piece.data(), got});
  if (input.error() != 0) throw_read_error(name + ": cannot read", input.error(), advice);
}

std::string read_bytes(const std::string& path, const std::string& advice) {
  std::string bytes;
  read_pieces(
      path, [&bytes](std::string_view piece) { bytes += piece; }, advice);
  return bytes;
}

std::string bytes_if_readable(const std::string& path) {
  try {
    return read_bytes(path);
  } catch (const FileError&) {
    return {};
  }
}

Link read_link(const std::string& path) {
  return parse_file(path, [](const std::string& bytes) {
    Link link = parse_link(bytes);
    check_link(link);
    return link;
  });
}

}  // namespace unsnarl::app
