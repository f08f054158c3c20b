#define _GLIBCXX_ASSERTIONS  // whatever the layers are compiled with

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace unsnarl {
namespace {

TEST(AssertFail, an_element_beyond_the_end_ends_the_process_and_says_why) {
  const std::vector<int> one(1);
  volatile std::size_t beyond = 1;
  EXPECT_DEATH(static_cast<void>(one[beyond] + 0), "Assertion '__n < this->size\\(\\)' failed");
}

}  // namespace
}  // namespace unsnarl
