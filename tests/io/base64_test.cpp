#include "io/base64.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(Base64, is_that_of_rfc_4648) {
  // Section 10 of the RFC.
  EXPECT_EQ(base64_encoded(""), "");
  EXPECT_EQ(base64_encoded("f"), "Zg==");
  EXPECT_EQ(base64_encoded("fo"), "Zm8=");
  EXPECT_EQ(base64_encoded("foo"), "Zm9v");
  EXPECT_EQ(base64_encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_encoded("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace unsnarl
