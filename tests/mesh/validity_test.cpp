#include "mesh/validity.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "mesh/shapes.h"

namespace unsnarl {
namespace {

using namespace shapes;

std::string complaint(const Surface& s) {
  try {
    require_valid(s);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return {};
}

TEST(Validity, says_what_is_wrong_and_where) {
  EXPECT_EQ(complaint(cube()), "");
  Surface s = cube();
  s.corners[5] = 8;
  EXPECT_NE(complaint(s).find("face 1 uses vertex 8, but there are 8"), std::string::npos) << complaint(s);
  s = cube();
  s.corners[0] = -1;
  EXPECT_NE(complaint(s), "");
  s = cube();
  s.positions[4] = std::numeric_limits<double>::infinity();
  EXPECT_NE(complaint(s).find("vertex 1 "), std::string::npos);
  s = cube();
  s.offsets[2] = 99;
  EXPECT_NE(complaint(s), "");
  s = cube();
  s.offsets.back() = 3;
  EXPECT_NE(complaint(s), "");
  s = cube();
  s.offsets.clear();
  s.corners.resize(4);
  EXPECT_NE(complaint(s), "");
  s = cube();
  s.positions.pop_back();
  EXPECT_NE(complaint(s), "");
}

}  // namespace
}  // namespace unsnarl
