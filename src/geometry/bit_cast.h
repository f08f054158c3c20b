#pragma once

#include <bit>

namespace unsnarl {

#if defined(__cpp_lib_bit_cast)
using std::bit_cast;
#else  // libc++ before 14
template <class To, class From>
constexpr To bit_cast(const From& from) {
  return __builtin_bit_cast(To, from);
}
#endif

}  // namespace unsnarl
