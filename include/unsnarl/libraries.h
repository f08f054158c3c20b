#pragma once

#include <string>
#include <vector>

namespace unsnarl {

struct LibraryVersion {
  std::string name;     ///< as its authors write it
  std::string version;  ///< as its authors count
};

/// What this library is made with: of shared libraries the version that is loaded, of those that are
/// headers only the one that was compiled in; "GCC" or "Clang" that compiled it, and "glibc" that runs it.
std::vector<LibraryVersion> libraries();

}  // namespace unsnarl
