#pragma once

#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include "geometry/types.h"

namespace unsnarl {

/// Four numbers side by side, in one register where the machine has such; operators are the compiler's, and the results
/// the same everywhere.
using FourFloats = float __attribute__((vector_size(16)));
using FourIndices = Index __attribute__((vector_size(16)));

/// The same number four times.
inline FourFloats four_times(float value) {
  return FourFloats{value, value, value, value};
}
inline FourIndices four_times(Index value) {
  return FourIndices{value, value, value, value};
}

/// Bit k: of four comparisons, whether the k-th holds.
template <class Comparisons>
unsigned bits_of(Comparisons holds) {
#ifdef __SSE__
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(holds)));
#else
  return (holds[0] & 1u) | (holds[1] & 2u) | (holds[2] & 4u) | (holds[3] & 8u);
#endif
}

}  // namespace unsnarl
