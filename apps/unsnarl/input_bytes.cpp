#include "input_bytes.h"

#include <fstream>
#include <iostream>
#include <iterator>

#include "mesh_input.h"

namespace unsnarl::app {

std::string read_bytes(const std::string& path) {
  std::ifstream file;
  if (path != standard_stream) {
    file.open(path, std::ios::binary);
    if (!file) throw FileError(path + ": cannot open");
  }
  std::istream& in = path == standard_stream ? std::cin : file;
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw FileError((path == standard_stream ? "standard input" : path) + ": cannot read");
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
