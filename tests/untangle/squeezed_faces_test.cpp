#include "untangle/squeezed_faces.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

TEST(SqueezedFaces, are_those_that_lost_nearly_all_their_area) {
  Patch patch = shapes::patch_of(shapes::bumpy_sheet(2, 0));
  const Positions start = patch.x;
  EXPECT_FALSE(has_squeezed_face(patch, start, start, 1));
  Positions x = start;
  x.col(4) = 0.999 * start.col(0) + 0.001 * start.col(4);  // the middle onto a corner
  EXPECT_TRUE(has_squeezed_face(patch, start, x, 0.01));
  EXPECT_FALSE(has_squeezed_face(patch, start, x, 0.0005));
  // A face without area at the start has nothing to lose.
  EXPECT_FALSE(has_squeezed_face(patch, x, x, 1));
  Positions collapsed = start;
  collapsed.col(1) = collapsed.col(0);
  EXPECT_FALSE(has_squeezed_face(patch, collapsed, collapsed, 0.5));
  EXPECT_TRUE(has_squeezed_face(patch, start, collapsed, 0.5));
}

}  // namespace
}  // namespace unsnarl
