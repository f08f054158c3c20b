// One target under libFuzzer, which brings main(). UNSNARL_FUZZ_TARGET is its name.
#include <algorithm>
#include <cstddef>
#include <string>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  unsnarl::fuzz::UNSNARL_FUZZ_TARGET({data, size});
  return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// Now and then repeats a piece as often as there is room: single steps do not come to deep nesting.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  constexpr unsigned int seldom = 64, longest_piece = 32;
  if (size == 0 || seed % seldom != 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::size_t begin = seed / seldom % size;
  const std::size_t length = std::min<std::size_t>(1 + seed / seldom / size % longest_piece, size - begin);
  const std::string piece(data + begin, data + begin + length), rest(data + begin + length, data + size);
  std::size_t end = begin + length;
  for (; end + length + rest.size() <= max_size; end += length) std::copy(piece.begin(), piece.end(), data + end);
  std::copy(rest.begin(), rest.end(), data + end);
  return end + rest.size();
}
