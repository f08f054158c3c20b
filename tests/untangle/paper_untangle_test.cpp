#include "untangle/paper_untangle.h"

#include <gtest/gtest.h>

#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

using namespace shapes;

class PaperUntangleTest : public testing::TestWithParam<std::pair<PaperBandwidth, bool>> {};

TEST_P(PaperUntangleTest, parts_two_spheres) {
  Patch patch = patch_of(two_spheres(12));
  PaperOptions options;
  options.bandwidth = GetParam().first;
  options.adaptive = GetParam().second;
  options.max_iterations = 300;
  const PaperResult result = paper_untangle(patch, options);
  EXPECT_TRUE(result.clean) << result.disjoint_left;
  EXPECT_GT(result.iterations, 0);
  EXPECT_GT(result.mean_bandwidth, 0.5 * patch.edge_length);
  EXPECT_LT(result.mean_bandwidth, 4.01 * patch.edge_length);
  const auto pairs = IntersectionFinder(patch.triangles).find(patch.x);
  EXPECT_TRUE(std::none_of(pairs.begin(), pairs.end(),
                           [](const IntersectingPair& pair) { return pair.kind == PairClass::disjoint; }));
}

INSTANTIATE_TEST_SUITE_P(
    AllModels, PaperUntangleTest,
    testing::Values(std::pair{PaperBandwidth::global, false}, std::pair{PaperBandwidth::global, true},
                    std::pair{PaperBandwidth::independent, false}, std::pair{PaperBandwidth::independent, true},
                    std::pair{PaperBandwidth::symmetric, false}, std::pair{PaperBandwidth::symmetric, true}));

TEST(PaperUntangle, does_not_depend_on_the_unit) {
  Patch small = patch_of(limb_and_sheet()), large = small;
  large.rest *= 1024;  // a power of two: the scaled copies agree to the last bit
  large.x = large.rest;
  PaperOptions options;
  options.max_iterations = 5;
  paper_untangle(small, options);
  paper_untangle(large, options);
  EXPECT_NE(small.x, small.rest);
  EXPECT_EQ(Positions(1024 * small.x), large.x);
}

TEST(PaperUntangle, every_energy_can_be_left_out) {
  const Shape shape = two_spheres(12);
  PaperOptions by_length, gaussian_alone, nothing;
  by_length.mesh_energy = PaperMeshEnergy::intersection_length;
  by_length.lambda_gaussian = 0;
  gaussian_alone.lambda_mesh = 0;
  nothing.lambda_gaussian = nothing.lambda_mesh = 0;
  for (PaperOptions* options : {&by_length, &gaussian_alone}) {
    options->max_iterations = 300;
    Patch patch = patch_of(shape);
    EXPECT_TRUE(paper_untangle(patch, *options).clean);
  }
  Patch patch = patch_of(shape);
  EXPECT_FALSE(paper_untangle(patch, nothing).clean);
  EXPECT_LT((patch.x - patch.rest).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(PaperUntangle, the_global_bandwidth_is_stationary_where_vertices_lie_at_one_place) {
  PaperOptions options;
  options.bandwidth = PaperBandwidth::global;
  options.adaptive = false;
  options.max_iterations = 1;
  Patch patch = patch_of(two_spheres(12));
  // Two vertices that are not neighbours: the energy has no bound as the bandwidth goes to zero.
  patch.rest.col(patch.free_count - 1) = patch.rest.col(0);
  patch.x = patch.rest;
  EXPECT_GT(paper_untangle(patch, options).mean_bandwidth, 0.1 * patch.edge_length);
}

TEST(PaperUntangle, bandwidths_are_scaled_after_they_are_found) {
  PaperOptions options;
  options.bandwidth = PaperBandwidth::global;
  options.adaptive = false;
  options.max_iterations = 1;
  const auto bandwidth = [&](double scale) {
    options.bandwidth_scale = scale;
    Patch patch = patch_of(limb_and_sheet());
    return paper_untangle(patch, options).mean_bandwidth;
  };
  EXPECT_NEAR(bandwidth(3), 3 * bandwidth(1), 1e-9 * bandwidth(1));
}

TEST(PaperUntangle, goes_on_where_no_direction_descends) {
  // With the penalty alone the first line search ends at a kink.
  Patch patch = patch_of(figure_eight_torus());
  PaperOptions options;
  options.lambda_gaussian = 0;
  options.lambda_mesh = 10;
  options.max_iterations = 60;
  EXPECT_EQ(paper_untangle(patch, options).iterations, 60);
}

TEST(PaperUntangle, options_have_ranges) {
  EXPECT_NO_THROW(check_paper_options({}));
  const auto refuses = [](auto&& change) {
    PaperOptions options;
    change(options);
    EXPECT_THROW(check_paper_options(options), std::invalid_argument);
  };
  refuses([](PaperOptions& o) { o.lambda_mesh = -1; });
  refuses([](PaperOptions& o) { o.neighbourhood = 0; });
  refuses([](PaperOptions& o) { o.damping = 1.5; });
  refuses([](PaperOptions& o) { o.memory = 0; });
  refuses([](PaperOptions& o) { o.start_bandwidth = std::numeric_limits<double>::quiet_NaN(); });
}

TEST(PaperUntangle, fixed_vertices_stay) {
  Patch patch = patch_with_fixed(limb_and_sheet(), [](const Vec3& p) { return p[2] == 0.003; });
  const Positions before = patch.rest;
  PaperOptions options;
  options.max_iterations = 20;
  paper_untangle(patch, options);
  const Index fixed = static_cast<Index>(before.cols()) - patch.free_count;
  EXPECT_EQ(patch.x.rightCols(fixed), before.rightCols(fixed));
  EXPECT_NE(patch.x, before);
}

}  // namespace
}  // namespace unsnarl
