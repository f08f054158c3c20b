#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace unsnarl {

/// RFC 4648, with padding.
std::string base64_encoded(std::string_view bytes);

/// Also of the URL-safe alphabet, with or without padding. Nothing: some character is no base64 digit.
std::optional<std::string> base64_decoded(std::string_view text);

/// Replaces the digits of `text` whose bytes differ; everything else in it stays, be it padding or unused bits.
void base64_patch(std::string& text, std::string_view old_bytes, std::string_view new_bytes);

/// `text` without white space.
std::string without_space(std::string_view text);

/// `digits` where `old_text` has its digits: in the same lines if there are as many, else between the same ends.
std::string with_digits(std::string_view old_text, std::string_view digits);

}  // namespace unsnarl
