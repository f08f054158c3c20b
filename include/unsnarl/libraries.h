#pragma once

#include <string>
#include <vector>

namespace unsnarl {

struct LibraryVersion {
  std::string name;     ///< as its authors write it
  std::string version;  ///< as its authors count
};

/// The versions of all that this library is made with. Shared libraries count with the version that is loaded,
/// libraries of headers with the one that was compiled in. "GCC" or "Clang" compiled it, "glibc" runs it.
std::vector<LibraryVersion> libraries();

}  // namespace unsnarl
