#pragma once

#include <string>
#include <string_view>

namespace unsnarl {

/// "a%20b" -> "a b"; what is no code stays.
std::string percent_decoded(std::string_view text);

/// Place of the base64 digits in a data: URI; npos: it has none.
std::size_t data_uri_start(std::string_view uri);

}  // namespace unsnarl
