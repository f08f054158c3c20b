#pragma once

#include <span>
#include <string>

#include "render/image.h"

namespace unsnarl {

/// The images, all of one size, as an animated GIF that starts again at its end. delays_s: seconds that each is shown,
/// kept to hundredths. One palette for all; of each image only what differs from the one before is stored.
/// Throws std::invalid_argument for no images, different sizes, more than 65535 pixels a side, or another number of
/// delays; std::runtime_error where giflib fails.
std::string encode_gif(std::span<const Image> images, std::span<const double> delays_s);

}  // namespace unsnarl
