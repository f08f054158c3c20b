#pragma once

#include <string>
#include <string_view>

#include "io/number_array.h"

namespace unsnarl {

/// Numbers as base64 digits, compressed before or not. White space around and between the digits stays.
class Base64Numbers final : public EncodedNumbers {
 public:
  enum class Compression : std::uint8_t { none, zlib, gzip };

  /// Decodes `range` of `file`. Throws FileError (starting with `where`) where that cannot be done. `size` is the
  /// number of bytes that compressed digits should give.
  Base64Numbers(std::string_view file, ByteRange range, bool is_compressed, std::size_t size, const std::string& where);

  void replace(std::string_view file, std::string_view changed, std::vector<TextEdit>& edits) const override;

 private:
  ByteRange range_;
  Compression compression_ = Compression::none;
};

}  // namespace unsnarl
