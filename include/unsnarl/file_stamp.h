#pragma once

#include <cstdint>

namespace unsnarl {

/// A file as it was at one time. Where anything differs later, somebody has changed the file or put another in its
/// place.
struct FileStamp {
  bool operator==(const FileStamp&) const = default;

  std::uint64_t device = 0, inode = 0;
  std::int64_t size = 0;                         ///< bytes
  std::int64_t modified_s = 0, modified_ns = 0;  ///< when the bytes were last changed
};

}  // namespace unsnarl
