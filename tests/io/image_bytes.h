#pragma once

#include <cstdint>
#include <string>

namespace unsnarl {

inline std::string big_endian_bytes(std::uint32_t value, int bytes) {
  std::string result;
  for (int k = bytes - 1; k >= 0; --k) result += static_cast<char>(value >> (8 * k) & 0xFF);
  return result;
}

/// The start of a PNG file of this size, which is all that is read of it; then `more` bytes.
inline std::string png_bytes(std::uint32_t width, std::uint32_t height, std::size_t more = 0) {
  return "\x89PNG\r\n\x1A\n" + big_endian_bytes(13, 4) + "IHDR" + big_endian_bytes(width, 4) +
         big_endian_bytes(height, 4) + std::string(more, 'x');
}

/// The same of a JPEG file, with a segment of another kind in front.
inline std::string jpeg_bytes(std::uint32_t width, std::uint32_t height) {
  return "\xFF\xD8\xFF\xE0" + big_endian_bytes(7, 2) + "JFIF" + std::string(1, '\0') + "\xFF\xFF\xC2" +
         big_endian_bytes(11, 2) + '\x08' + big_endian_bytes(height, 2) + big_endian_bytes(width, 2) + "\x01...";
}

}  // namespace unsnarl
