#pragma once

#include <string>
#include <string_view>

namespace unsnarl {

/// Text for a terminal or a message, in one line of UTF-8: what would not be seen there, or would do something, is
/// replaced by what can be read. Control characters (line ends among them) and bytes that are no UTF-8 become \x1b and
/// the like, characters that change the direction of writing or end lines \u{202e} and the like. All other text stays.
std::string visible_text(std::string_view text);

bool is_utf8(std::string_view text);

}  // namespace unsnarl
