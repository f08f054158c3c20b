#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace unsnarl::app {

/// SHA-256 (FIPS 180-4) of bytes that come in pieces.
class Sha256 {
 public:
  void add(std::string_view bytes);
  /// 64 hexadecimal digits of all that was added, as `sha256sum` prints them. To be called once.
  std::string digits();

 private:
  static constexpr std::size_t block_size = 64;  // bytes
  void take_block(const char* block);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<char, block_size> begun_;  // the block that is not full yet
  std::uint64_t size_ = 0;              // bytes so far
};

}  // namespace unsnarl::app
