#include "input_bytes.h"

#include <cerrno>
#include <cstring>
#include <iostream>
#include <iterator>

#include "mesh_input.h"

namespace unsnarl::app {

std::ifstream opened(const std::string& path, const std::string& advice) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(fmt::format("{}: cannot open: {}{}", path, std::strerror(errno), advice));
  return file;
}

void require_no_failure(const std::istream& in, const std::string& path) {
  if (in.bad()) throw FileError(fmt::format("{}: cannot read: {}", path, std::strerror(errno)));
}

std::string read_bytes(const std::string& path) {
  std::ifstream file;
  if (path != standard_stream) file = opened(path);
  std::istream& in = path == standard_stream ? std::cin : file;
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  require_no_failure(in, path == standard_stream ? "standard input" : path);
  return bytes;
}

Link read_link(const std::string& path) {
  return parse_file(path, [](const std::string& bytes) {
    Link link = parse_link(bytes);
    check_link(link);
    return link;
  });
}

}  // namespace unsnarl::app
