#pragma once

#include <fmt/format.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "unsnarl/document.h"
#include "unsnarl/link.h"

namespace unsnarl::app {

/// Calls take(piece) with the bytes of the file at `path`, or of standard input for standard_stream, in their order;
/// `advice` ends the message where that fails. Throws FileError, SystemError.
void read_pieces(const std::string& path, const std::function<void(std::string_view piece)>& take,
                 const std::string& advice = "");
/// All these bytes.
std::string read_bytes(const std::string& path, const std::string& advice = "");
/// The same; none where there is no such file, or it must not be read. Throws SystemError.
std::string bytes_if_readable(const std::string& path);

/// parse(bytes) of the file at `path`. Throws FileError with the path in front of what the parser says.
template <class Parse>
auto parse_file(const std::string& path, Parse&& parse) {
  std::string bytes = read_bytes(path);
  try {
    return parse(std::move(bytes));
  } catch (const FileError& e) {
    throw FileError(fmt::format("{}: {}", path, e.what()), e.error_number());
  } catch (const std::invalid_argument& e) {
    throw FileError(fmt::format("{}: {}", path, e.what()));
  }
}

/// Reads and checks a knot or link in any of the forms of parse_link(). Throws FileError.
Link read_link(const std::string& path);

}  // namespace unsnarl::app
