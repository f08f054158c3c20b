#include "io/zlib_stream.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(ZlibStream, comes_back) {
  for (const bool as_gzip : {false, true})
    for (const std::size_t size : {0u, 1u, 1000u, 300000u}) {
      std::string bytes(size, 'a');
      for (std::size_t i = 0; i < size; i += 3) bytes[i] = static_cast<char>(i * i);
      const std::string stream = deflated(bytes, as_gzip);
      EXPECT_EQ(is_gzip(stream), as_gzip);
      EXPECT_EQ(inflated(stream, size), bytes);
      EXPECT_EQ(inflated(stream, size + 1), std::nullopt);
      EXPECT_EQ(inflated(stream, size == 0 ? 2 : size - 1), std::nullopt);
      EXPECT_EQ(inflated(stream.substr(0, stream.size() - 1), size), std::nullopt);
    }
}

TEST(ZlibStream, asks_for_no_memory_that_cannot_be_filled) {
  EXPECT_EQ(inflated(deflated("abc", false), std::size_t{1} << 60), std::nullopt);
  EXPECT_EQ(inflated("", 1), std::nullopt);
}

}  // namespace
}  // namespace unsnarl
