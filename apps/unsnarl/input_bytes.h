#pragma once

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "unsnarl/document.h"
#include "unsnarl/link.h"

namespace unsnarl::app {

/// The file at `path`, open for reading; `advice` ends the message where that fails. Throws FileError.
std::ifstream opened(const std::string& path, const std::string& advice = "");

/// Throws FileError, naming `path`, where reading has just failed.
void require_no_failure(const std::istream& in, const std::string& path);

/// The bytes of the file at `path`, or of standard input for standard_stream. Throws FileError.
std::string read_bytes(const std::string& path);

/// parse(bytes) of the file at `path`. Throws FileError with the path in front of what the parser says.
template <class Parse>
auto parse_file(const std::string& path, Parse&& parse) {
  std::string bytes = read_bytes(path);
  try {
    return parse(std::move(bytes));
  } catch (const FileError& e) {
    throw FileError(fmt::format("{}: {}", path, e.what()));
  } catch (const std::invalid_argument& e) {
    throw FileError(fmt::format("{}: {}", path, e.what()));
  }
}

/// Reads and checks a knot or link in any of the forms of parse_link(). Throws FileError.
Link read_link(const std::string& path);

}  // namespace unsnarl::app
