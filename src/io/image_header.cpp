#include "io/image_header.h"

#include <cstdint>

#include "io/byte_order.h"

namespace unsnarl {
namespace {

template <class T>
std::size_t big_endian(std::string_view bytes, std::size_t at) {
  return load<T>(bytes.data() + at, std::endian::big);
}

std::optional<ImageHeader> with_size(std::string media_type, std::size_t width, std::size_t height) {
  if (width == 0 || height == 0) return std::nullopt;
  return ImageHeader{std::move(media_type), width, height};
}

/// Is this marker the header of a frame, which holds the size?
bool is_frame_header(unsigned marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

std::optional<ImageHeader> jpeg_header(std::string_view bytes) {
  for (std::size_t at = 2; at + 9 <= bytes.size();) {
    if (bytes[at] != '\xFF') return std::nullopt;
    const unsigned marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    if (is_frame_header(marker))
      return with_size("image/jpeg", big_endian<std::uint16_t>(bytes, at + 7),
                       big_endian<std::uint16_t>(bytes, at + 5));
    at += 2 + big_endian<std::uint16_t>(bytes, at + 2);
  }
  return std::nullopt;
}

}  // namespace

std::optional<ImageHeader> image_header(std::string_view bytes) {
  constexpr std::string_view png = "\x89PNG\r\n\x1A\n";
  if (bytes.starts_with(png)) {
    if (bytes.size() < 24 || bytes.substr(12, 4) != "IHDR") return std::nullopt;
    return with_size("image/png", big_endian<std::uint32_t>(bytes, 16), big_endian<std::uint32_t>(bytes, 20));
  }
  if (bytes.starts_with("\xFF\xD8\xFF")) return jpeg_header(bytes);
  return std::nullopt;
}

}  // namespace unsnarl
