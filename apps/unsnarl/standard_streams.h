#pragma once

#include <string>
#include <string_view>

namespace unsnarl::app {

/// Lines to standard error, as visible_text() of each. Where that is closed or full there is nobody to tell, which is
/// no error.
void tell(std::string_view lines);
/// The same without a change: text that moves the cursor and holds no name.
void draw(std::string_view text);

/// Standard output, a device or a pipe: there is nothing to rename, nor to read back.
bool is_stream(const std::string& path);
/// Throws WriteError.
void write_to_stream(const std::string& path, std::string_view bytes);

}  // namespace unsnarl::app
