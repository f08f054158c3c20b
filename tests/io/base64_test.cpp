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

TEST(Base64, decodes_with_and_without_padding) {
  for (const char* bytes : {"", "f", "fo", "foo", "foob"}) EXPECT_EQ(base64_decoded(base64_encoded(bytes)), bytes);
  EXPECT_EQ(base64_decoded("Zg"), "f");
  EXPECT_EQ(base64_decoded("__79"), "\xff\xfe\xfd");
  EXPECT_EQ(base64_decoded("Z!"), std::nullopt);
}

TEST(Base64, new_digits_take_the_lines_of_the_old) {
  EXPECT_EQ(without_space(" ab\n cd\t"), "abcd");
  EXPECT_EQ(with_digits(" ab\n cd\t", "efgh"), " ef\n gh\t");
  EXPECT_EQ(with_digits(" ab\n cd\t", "efghi"), " efghi\t");
  EXPECT_EQ(with_digits(" \n", "ab"), " \nab");
  EXPECT_EQ(with_digits("", ""), "");
}

}  // namespace
}  // namespace unsnarl
