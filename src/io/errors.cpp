#include "unsnarl/errors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace unsnarl {
namespace {

/// What a path can be the reason of: its name, its kind, its permissions, the file system or the stream that it is on.
constexpr std::array errors_of_paths = {ENOENT, EACCES, EPERM,     EISDIR, ENOTDIR,    ELOOP,  ENAMETOOLONG,
                                        EINVAL, EILSEQ, EROFS,     EEXIST, ENOTEMPTY,  EBUSY,  EXDEV,
                                        EMLINK, ENXIO,  EOVERFLOW, ENODEV, ENOSPC,
#ifdef EDQUOT  // where there are quotas
                                        EDQUOT,
#endif
                                        EFBIG,  EPIPE,  EBADF,     ENOSYS, EOPNOTSUPP, ETXTBSY};

std::string with_reason(const std::string& message, int error_number) {
  return message + ": " + std::generic_category().message(error_number);
}

}  // namespace

bool is_error_of_system(int error_number) {
  return error_number != 0 &&
         std::find(errors_of_paths.begin(), errors_of_paths.end(), error_number) == errors_of_paths.end();
}

void throw_read_error(const std::string& message, int error_number, const std::string& advice) {
  if (is_error_of_system(error_number)) throw SystemError(with_reason(message, error_number), error_number);
  throw FileError(with_reason(message, error_number) + advice, error_number);
}

void throw_write_error(const std::string& message, int error_number) {
  if (is_error_of_system(error_number)) throw SystemError(with_reason(message, error_number), error_number);
  throw WriteError(with_reason(message, error_number), error_number);
}

}  // namespace unsnarl
