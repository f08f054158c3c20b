#include "content_hash.h"

#include "input_bytes.h"
#include "platform/files.h"
#include "sha256.h"

namespace unsnarl::app {

std::string sha256(std::string_view bytes) {
  Sha256 sum;
  sum.add(bytes);
  return sum.digits();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);
  if (is_error_of_system(platform::errno_of(error)))
    throw_read_error(path.string() + ": cannot read", platform::errno_of(error));
  if (!is_file) return {};
  Sha256 sum;
  try {
    read_pieces(path.string(), [&sum](std::string_view piece) { sum.add(piece); });
  } catch (const FileError&) {
    return {};
  }
  return sum.digits();
}

}  // namespace unsnarl::app
