#pragma once

#include <stdexcept>
#include <string>

namespace unsnarl {

/// An error that may come from a call of the system.
class NumberedError : public std::runtime_error {
 public:
  explicit NumberedError(const std::string& message, int error_number = 0)
      : std::runtime_error(message), error_number_(error_number) {}
  /// The errno (<cerrno>) of that call; 0: there was none.
  int error_number() const noexcept { return error_number_; }

 private:
  int error_number_;
};

/// A file cannot be read or is not valid. The message says what, where (line or byte, face and vertex as the format
/// counts them) and what to do.
class FileError : public NumberedError {
 public:
  using NumberedError::NumberedError;
};

/// A file cannot be written where it should be.
class WriteError : public NumberedError {
 public:
  using NumberedError::NumberedError;
};

/// The system failed: no descriptors, no memory, a device that gives errors. It says nothing about the file, and the
/// same call may succeed later.
class SystemError : public NumberedError {
 public:
  using NumberedError::NumberedError;
};

/// Does this errno tell of the system, rather than of the path that was given to it (missing, protected, a folder, on a
/// full disk)? Numbers that are not known to tell of a path tell of the system.
bool is_error_of_system(int error_number);

/// For a call of the system that failed while a file was read or written: throws SystemError where the errno tells of
/// the system, else FileError or WriteError. The reason follows the message, in the words of the system, and then the
/// advice.
[[noreturn]] void throw_read_error(const std::string& message, int error_number, const std::string& advice = "");
[[noreturn]] void throw_write_error(const std::string& message, int error_number);

}  // namespace unsnarl
