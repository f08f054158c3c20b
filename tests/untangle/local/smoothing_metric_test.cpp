#include "untangle/local/smoothing_metric.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

/// A flat sheet of n x n cells, and its metric.
struct Sheet {
  explicit Sheet(Index n, double range)
      : patch(shapes::patch_of(shapes::bumpy_sheet(n, 0))),
        edges(build_edges(patch.triangles)),
        metric(patch, edges, range) {}
  Patch patch;
  EdgeTable edges;
  SmoothingMetric metric;
};

TEST(SmoothingMetric, spreads_a_force_as_far_as_its_range) {
  const Index n = 12, middle = (n + 1) * (n / 2) + n / 2;
  double share_before = 0;
  for (const double range : {0.5, 1.0, 2.0}) {
    const Sheet sheet(n, range);
    ASSERT_TRUE(sheet.metric.ok());
    Positions force = Positions::Zero(3, sheet.patch.x.cols());
    force.col(middle) = Vec3(0, 0, 1);
    const Eigen::MatrixX3d direction = sheet.metric.solve(force);
    EXPECT_EQ(direction.rows(), sheet.patch.free_count);
    EXPECT_TRUE(direction.leftCols(2).isZero(1e-12)) << "components do not mix";
    Index largest = 0;
    direction.col(2).maxCoeff(&largest);
    EXPECT_EQ(largest, middle);
    const double share = direction(middle + 1, 2) / direction(middle, 2);
    EXPECT_GT(share, share_before) << "the wider, the smoother";
    share_before = share;
  }
}

TEST(SmoothingMetric, a_translation_costs_area_alone) {
  const Sheet sheet(6, 1);
  // The force of a translation: every vertex with its own area.
  Positions force = Positions::Zero(3, sheet.patch.x.cols());
  for (const Triangle& t : sheet.patch.triangles) {
    const Vec3 a = sheet.patch.x.col(t[0]), b = sheet.patch.x.col(t[1]), c = sheet.patch.x.col(t[2]);
    for (const Index v : t) force(0, v) += (b - a).cross(c - a).norm() / 6;
  }
  const Eigen::MatrixX3d direction = sheet.metric.solve(force);
  EXPECT_TRUE(direction.col(0).isApprox(Eigen::VectorXd::Ones(direction.rows()), 1e-9));
}

}  // namespace
}  // namespace unsnarl
