#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace unsnarl {

/// The `size` bytes that a zlib or gzip stream holds. Nothing: it is damaged, or holds another number of bytes; memory
/// is asked for only where so many bytes can be in it.
std::optional<std::string> inflated(std::string_view stream, std::size_t size);

/// A zlib stream, or a gzip stream, of zlib's usual level.
std::string deflated(std::string_view bytes, bool as_gzip);

/// Does a compressed stream start as gzip does?
inline bool is_gzip(std::string_view stream) {
  return stream.starts_with("\x1f\x8b");
}

}  // namespace unsnarl
