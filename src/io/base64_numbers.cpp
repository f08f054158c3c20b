#include "io/base64_numbers.h"

#include <fmt/format.h>

#include "io/base64.h"
#include "io/zlib_stream.h"
#include "unsnarl/document.h"

namespace unsnarl {

Base64Numbers::Base64Numbers(std::string_view file, ByteRange range, bool is_compressed, std::size_t size,
                             const std::string& where)
    : range_(range) {
  std::optional<std::string> decoded = base64_decoded(without_space(file.substr(range.begin, range.size)));
  if (!decoded) throw FileError(where + " holds characters that are not base64; the file is damaged");
  if (is_compressed) {
    compression_ = is_gzip(*decoded) ? Compression::gzip : Compression::zlib;
    decoded = inflated(*decoded, size);
    if (!decoded)
      throw FileError(
          fmt::format("{} cannot be decompressed to {} bytes; the file is cut short or damaged", where, size));
  }
  bytes = std::move(*decoded);
}

void Base64Numbers::replace(std::string_view file, std::string_view changed, std::vector<TextEdit>& edits) const {
  const std::string_view old = file.substr(range_.begin, range_.size);
  std::string digits;
  if (compression_ == Compression::none) {
    digits = without_space(old);
    base64_patch(digits, bytes, changed);
  } else {
    digits = base64_encoded(deflated(changed, compression_ == Compression::gzip));
  }
  edits.push_back({range_.begin, range_.begin + range_.size, with_digits(old, digits)});
}

}  // namespace unsnarl
