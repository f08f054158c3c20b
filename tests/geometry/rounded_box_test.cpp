#include "geometry/rounded_box.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

Box box_between(const Vec3& lo, const Vec3& hi) {
  Box box;
  box.extend(lo);
  box.extend(hi);
  return box;
}

TEST(RoundedBox, overlaps_what_the_box_overlaps) {
  const RoundedBox box(box_between(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  EXPECT_TRUE(box.overlaps(RoundedBox(box_between(Vec3(1, 1, 1), Vec3(2, 2, 2)))));
  EXPECT_TRUE(box.overlaps(RoundedBox(box_between(Vec3(-5, 0.5, 0.5), Vec3(5, 0.6, 0.6)))));
  for (int k = 0; k < 3; ++k) {
    Vec3 away = Vec3::Zero();
    away[k] = 1.001;
    EXPECT_FALSE(box.overlaps(RoundedBox(box_between(away, away + Vec3::Ones()))));
    EXPECT_FALSE(RoundedBox(box_between(away, away + Vec3::Ones())).overlaps(box));
  }
  // Too near to be told apart in single precision: these overlap too.
  EXPECT_TRUE(box.overlaps(RoundedBox(box_between(Vec3(1 + 1e-12, 0, 0), Vec3(2, 1, 1)))));
}

TEST(RoundedBox, empty_overlaps_nothing) {
  const RoundedBox box(box_between(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
  EXPECT_FALSE(RoundedBox().overlaps(box));
  EXPECT_FALSE(RoundedBox(Box()).overlaps(box));
  EXPECT_FALSE(RoundedBox().overlaps(RoundedBox()));
  RoundedBox extended;
  extended.extend(RoundedBox());
  extended.extend(box);
  EXPECT_TRUE(extended.overlaps(box));
}

TEST(RoundedBox, beyond_the_range_of_single_precision_overlaps_still) {
  const RoundedBox far(box_between(Vec3(1e200, 0, 0), Vec3(2e200, 1, 1)));
  EXPECT_TRUE(far.overlaps(RoundedBox(box_between(Vec3(-1e300, -1e300, -1e300), Vec3(1e300, 1e300, 1e300)))));
  EXPECT_TRUE(far.overlaps(far));
}

}  // namespace
}  // namespace unsnarl
