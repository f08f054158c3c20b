#pragma once

#include <filesystem>
#include <string>

#include "render/image.h"

namespace unsnarl {

/// The image as a PNG file (8-bit RGB, sRGB). Throws std::invalid_argument for an empty image, std::runtime_error where
/// libpng fails.
std::string encode_png(const Image& image);

/// Writes encode_png(image) to a temporary file beside `path`, then renames it. Throws std::runtime_error naming the
/// path.
void write_png(const Image& image, const std::filesystem::path& path);

}  // namespace unsnarl
