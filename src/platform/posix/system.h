#pragma once

#include <sys/time.h>

/// The files of this folder share these functions.
namespace unsnarl::platform {

inline constexpr double bytes_a_megabyte = 1e6;        ///< Bytes of a megabyte (fixed by SI units)
inline constexpr double seconds_a_microsecond = 1e-6;  ///< Seconds of a microsecond (fixed by SI units)

inline double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + seconds_a_microsecond * static_cast<double>(time.tv_usec);
}

}  // namespace unsnarl::platform
