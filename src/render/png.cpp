#include "render/png.h"

#include <png.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace unsnarl {

std::string encode_png(const Image& image) {
  if (image.width <= 0 || image.height <= 0)
    throw std::invalid_argument("cannot encode an image without pixels as PNG");
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  const auto fail = [&] {
    throw std::runtime_error(std::string("libpng could not encode the picture: ") + header.message);
  };
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr)) fail();
  bytes.resize(size);
  return bytes;
}

void write_png(const Image& image, const std::filesystem::path& path) {
  const std::string bytes = encode_png(image);
  std::filesystem::path temporary = path;
  temporary += ".partial";
  {
    std::ofstream file(temporary, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
      throw std::runtime_error("cannot write the picture " + path.string() + "; is its folder there and writable?");
    }
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error("cannot write the picture " + path.string() + ": " + error.message());
  }
}

}  // namespace unsnarl
