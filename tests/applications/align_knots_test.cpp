#include "applications/knots/align_knots.h"

#include <gtest/gtest.h>

#include "applications/knots/knot_path.h"

namespace unsnarl {
namespace {

TEST(AlignKnots, finds_the_similarity_the_order_and_the_direction) {
  const Positions x = points_of(knot_of_table("8_19").components[0]);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Vec3(2, -1, 2) / 3).toRotationMatrix();
  for (const bool backwards : {false, true}) {
    const Positions y = reordered(Positions((0.25 * turn * x).colwise() + Vec3(7, -8, 9)), 17, backwards);
    const std::vector<Alignment> found = alignments(x, y, backwards, 3);
    ASSERT_FALSE(found.empty());
    EXPECT_LT(found[0].distance, 1e-12);
    EXPECT_NEAR(found[0].scale, 4, 1e-9);
    EXPECT_NEAR(found[0].rotation.determinant(), 1, 1e-12);
    EXPECT_LT((found[0].applied(reordered(y, found[0].first, backwards)) - x).norm(), 1e-9);
    // Along the other way, or in the mirror, it does not fit.
    EXPECT_GT(alignments(x, y, !backwards, 1)[0].distance, 0.01);
    EXPECT_GT(alignments(Positions(-x), y, backwards, 1)[0].distance, 0.01);
  }
}

TEST(AlignKnots, the_nearest_order_is_that_of_shifted_points) {
  const Positions x = points_of(knot_of_table("4_1").components[0]);
  const auto n = static_cast<Index>(x.cols());
  EXPECT_EQ(nearest_order(x, reordered(x, 5, false)), n - 5);
  EXPECT_EQ(nearest_order(x, x), 0);
}

}  // namespace
}  // namespace unsnarl
