#pragma once

#include <string>
#include <string_view>

namespace unsnarl {

/// RFC 4648, with padding.
std::string base64_encoded(std::string_view bytes);

}  // namespace unsnarl
