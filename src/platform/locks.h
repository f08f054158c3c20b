#pragma once

#include <filesystem>
#include <string_view>

namespace unsnarl::platform {

/// A file for lines, made where it is missing, that processes take turns with: a lock keeps out who asks for one, on
/// this machine, until the file is closed. Where the file system has no locks, nobody waits.
class LockedFile {
 public:
  LockedFile() = default;
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  /// Returns the errno of its failure; 0: none. To be called once, before the others.
  int open(const std::filesystem::path& path);
  /// Returns false where another process has it now.
  bool try_lock();
  /// Waits for the others.
  void lock();

  bool ends_in_the_middle_of_a_line() const;
  /// Adds bytes at the end, in one piece. Returns the errno of its failure; 0: none.
  int append(std::string_view bytes);

 private:
  int descriptor_ = -1;
};

}  // namespace unsnarl::platform
