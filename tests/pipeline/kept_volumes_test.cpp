// Recovery keeps most of the volume of closed components.
#include <gtest/gtest.h>

#include <vector>

#include "mesh/areas.h"
#include "unsnarl/repair.h"
#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

TEST(KeptVolumes, a_ball_in_the_end_of_a_box_squeezes_it_a_little) {
  shapes::Shape shape = shapes::box({2, 1, 1});
  shape.add(shapes::sphere({1.9, 0.6, 0.85}, 0.5, 16));
  const RepairResult result = repair(shape.surface(), {});
  ASSERT_EQ(result.status, Status::embedded);
  const Positions x = Eigen::Map<const Positions>(result.positions.data(), 3, shape.positions().cols());
  const std::vector<Triangle> box(shape.triangles.begin(), shape.triangles.begin() + 12);
  EXPECT_GT(signed_volume(x, box), 0.8 * signed_volume(shape.positions(), box));
}

}  // namespace
}  // namespace unsnarl
