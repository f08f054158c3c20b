#include "input_bytes.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "mesh_input.h"

namespace unsnarl::app {
namespace {

/// Open for reading until it goes; standard input stays open.
class Input {
 public:
  explicit Input(const std::string& path)
      : id_(path == standard_stream ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Input() {
    if (id_ > STDIN_FILENO) ::close(id_);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  int id() const { return id_; }

 private:
  int id_;
};

}  // namespace

void read_pieces(const std::string& path, const std::function<void(std::string_view)>& take,
                 const std::string& advice) {
  const std::string name = path == standard_stream ? "standard input" : path;
  const Input input(path);
  if (input.id() < 0) throw_read_error(name + ": cannot open", errno, advice);
  std::array<char, 1 << 16> piece;
  for (;;) {
    const ssize_t got = ::read(input.id(), piece.data(), piece.size());
    if (got == 0) return;
    if (got > 0) take({piece.data(), static_cast<std::size_t>(got)});
    if (got < 0 && errno != EINTR) throw_read_error(name + ": cannot read", errno, advice);
  }
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
