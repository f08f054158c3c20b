#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "io/mesh_file.h"
#include "platform/files.h"
#include "unsnarl/staged_files.h"

namespace unsnarl {

std::string read_file(const std::filesystem::path& path) {
  return read_stamped_file(path).bytes;
}

FileRead read_stamped_file(const std::filesystem::path& path,
                           const std::function<void(std::string_view)>& check_start) {
  platform::InputFile file(path, platform::InputFile::Opening::at_once);
  const platform::FileStatus status = file.error() == 0 ? file.status() : platform::FileStatus();
  if (file.error() != 0) throw_read_error(path.string() + ": cannot open", file.error());
  if (status.kind == platform::FileKind::folder)
    throw FileError(
        fmt::format("{}: is a folder; name a mesh file, or repair all in it with 'unsnarl batch'", path.string()),
        EISDIR);
  if (status.kind != platform::FileKind::file) {
    throw FileError(fmt::format("{}: is not a regular file; pipe it in through standard input ('-')", path.string()));
  }
  std::string bytes;
  const auto read_up_to = [&](std::size_t end) {
    std::size_t size = bytes.size();
    bytes.resize(end);
    while (size < end) {
      const std::size_t got = file.read(bytes.data() + size, end - size);
      if (file.error() != 0) throw_read_error(path.string() + ": cannot read", file.error());
      if (got == 0) break;
      size += got;
    }
    bytes.resize(size);
  };
  const auto whole = static_cast<std::size_t>(status.stamp.size);
  if (check_start) {
    read_up_to(std::min(whole, checked_start));
    check_start(bytes);
    bytes.reserve(whole);
  }
  read_up_to(whole);
  return {std::move(bytes), status.stamp};
}

bool is_inside_folder(const std::filesystem::path& name) {
  if (name.empty() || name.has_root_path() || name.string().find('\0') != std::string::npos) return false;
  return std::none_of(name.begin(), name.end(), [](const std::filesystem::path& part) { return part == ".."; });
}

void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  if (platform::status_of(path).kind == platform::FileKind::other) {
    const int failed = platform::write_to_device(path, bytes);
    if (failed != 0) throw_write_error(path.string() + ": cannot write", failed);
    return;
  }
  StagedFiles files;
  files.add(path, bytes);
  files.commit();
}

}  // namespace unsnarl
