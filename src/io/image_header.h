#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace unsnarl {

struct ImageHeader {
  std::string media_type;
  std::size_t width = 0, height = 0;  ///< pixels
};

/// The first things that a PNG (ISO/IEC 15948, section 11.2.2) or JPEG file (ITU-T T.81, annex B) says of itself.
/// Nothing: it is neither, or damaged there.
std::optional<ImageHeader> image_header(std::string_view bytes);

}  // namespace unsnarl
