#include "untangle/flow.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "untangle/flow_samples.h"
#include "untangle/paper_untangle.h"

namespace unsnarl {
namespace {

constexpr double tau = 2 * std::numbers::pi;

struct Shape {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  void add(const Shape& other) {
    const Index first = static_cast<Index>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (const Triangle& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
};

// A grid of points f(i / m, j / n), closed in either direction where asked for.
Shape grid(Index m, Index n, bool close_u, bool close_v, const std::function<Vec3(double, double)>& f) {
  Shape shape;
  const Index rows = close_u ? m : m + 1, columns = close_v ? n : n + 1;
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j)
      shape.points.push_back(f(static_cast<double>(i) / m, static_cast<double>(j) / n));
  }
  for (Index i = 0; i < m; ++i) {
    for (Index j = 0; j < n; ++j) {
      const auto id = [&](Index a, Index b) { return (a % rows) * columns + b % columns; };
      shape.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      shape.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return shape;
}

Shape sphere(const Vec3& center, double radius, Index n) {
  Shape shape = grid(n, 2 * n, false, true, [&](double u, double v) {
    const double polar = (0.02 + 0.96 * u) * tau / 2;
    return Vec3(center + radius * Vec3(std::sin(polar) * std::cos(tau * v), std::sin(polar) * std::sin(tau * v),
                                       std::cos(polar)));
  });
  return shape;
}

// A tube around the closed curve c.
Shape tube(Index along, Index around, double radius, const std::function<Vec3(double)>& c) {
  return grid(along, around, true, true, [&](double u, double v) {
    const Vec3 p = c(u), tangent = (c(u + 1e-4) - c(u - 1e-4)).normalized();
    const Vec3 side = tangent.cross(Vec3::UnitZ()).normalized(), up = side.cross(tangent);
    return Vec3(p + radius * (std::cos(tau * v) * side + std::sin(tau * v) * up));
  });
}

// A trefoil too thick for its curve.
Shape thick_trefoil() {
  return tube(72, 8, 0.75, [](double t) {
    const double a = tau * t;
    return Vec3(std::sin(a) + 2 * std::sin(2 * a), std::cos(a) - 2 * std::cos(2 * a), -0.6 * std::sin(3 * a));
  });
}

// A figure eight swept around a ring, with one full turn.
Shape figure_eight_torus() {
  return grid(40, 20, true, true, [](double u, double v) {
    const double s = std::sin(tau * v), d = 0.5 * std::sin(2 * tau * v), a = tau * u;
    const double x = std::cos(a) * s - std::sin(a) * d, z = std::sin(a) * s + std::cos(a) * d;
    return Vec3((3 + x) * std::cos(a), (3 + x) * std::sin(a), z);
  });
}

// A limb pressed through a sheet.
Shape limb_and_sheet() {
  Shape shape = grid(16, 16, false, false, [](double u, double v) { return Vec3(4 * u - 2, 4 * v - 2, 0.003); });
  shape.add(grid(16, 12, false, true, [](double u, double v) {
    return Vec3(3 * u - 1.5 + 0.013, 0.4 * std::cos(tau * v) + 0.007, 0.4 * std::sin(tau * v) + 0.25);
  }));
  return shape;
}

Patch patch_of(const Shape& shape) {
  Patch patch;
  patch.rest.resize(3, static_cast<Index>(shape.points.size()));
  for (std::size_t i = 0; i < shape.points.size(); ++i) patch.rest.col(static_cast<Index>(i)) = shape.points[i];
  patch.x = patch.rest;
  patch.triangles = shape.triangles;
  patch.free_count = static_cast<Index>(shape.points.size());
  patch.active_count = static_cast<Index>(shape.triangles.size());
  patch.edge_length = mean_edge_length(patch.rest, patch.triangles);
  return patch;
}

// Reorders vertices and triangles so that those for which `fixed` says so come last.
Patch patch_with_fixed(const Shape& shape, const std::function<bool(const Vec3&)>& fixed) {
  Shape sorted;
  std::vector<Index> id(shape.points.size());
  Index free_count = 0;
  for (const bool last : {false, true}) {
    for (std::size_t i = 0; i < shape.points.size(); ++i) {
      if (fixed(shape.points[i]) != last) continue;
      id[i] = static_cast<Index>(sorted.points.size());
      sorted.points.push_back(shape.points[i]);
    }
    if (!last) free_count = static_cast<Index>(sorted.points.size());
  }
  for (const Triangle& t : shape.triangles) sorted.triangles.push_back({id[t[0]], id[t[1]], id[t[2]]});
  const auto is_active = [&](const Triangle& t) { return *std::min_element(t.begin(), t.end()) < free_count; };
  const auto middle = std::stable_partition(sorted.triangles.begin(), sorted.triangles.end(), is_active);
  Patch patch = patch_of(sorted);
  patch.free_count = free_count;
  patch.active_count = static_cast<Index>(middle - sorted.triangles.begin());
  return patch;
}

std::size_t count_pairs(const Patch& patch) {
  return IntersectionFinder(patch.triangles, patch.active_count).find(patch.x).size();
}

// Tries one variant after the other; the last one's result.
FlowResult try_all(Patch& patch) {
  FlowResult result;
  for (const FlowSettings& strategy : flow_variants()) {
    result = flow(patch, strategy);
    if (result.clean) break;
  }
  return result;
}

double mean_displacement(const Patch& patch) {
  const double diagonal = (patch.rest.rowwise().maxCoeff() - patch.rest.rowwise().minCoeff()).norm();
  return (patch.x - patch.rest).colwise().norm().mean() / diagonal;
}

void expect_untangled(Patch& patch, double largest_mean_displacement, double largest_growth) {
  ASSERT_GT(count_pairs(patch), 0u);
  const FlowResult result = try_all(patch);
  EXPECT_TRUE(result.clean) << result.strategy << ": " << result.pairs_left;
  EXPECT_EQ(count_pairs(patch), 0u);
  EXPECT_LT(mean_displacement(patch), largest_mean_displacement);
  const double growth = total_area(patch.x, patch.triangles) / total_area(patch.rest, patch.triangles);
  EXPECT_LT(growth, largest_growth);
  EXPECT_GT(growth, 1 / largest_growth);
  for (const Triangle& t : patch.triangles) {
    EXPECT_GE(triangle_area(patch.x, t), 1e-3 * triangle_area(patch.rest, t));
  }
}

TEST(Flow, ParsTwoSpheres) {
  Shape shape = sphere(Vec3(0, 0, 0), 1, 12);
  shape.add(sphere(Vec3(1.9, 0.05, 0.02), 1, 12));
  Patch patch = patch_of(shape);
  expect_untangled(patch, 0.02, 1.1);
}

TEST(Flow, OpensAThickTrefoil) {
  Patch patch = patch_of(thick_trefoil());
  expect_untangled(patch, 0.2, 2);
}

TEST(Flow, OpensAFigureEightTorus) {
  Patch patch = patch_of(figure_eight_torus());
  ASSERT_GT(count_pairs(patch), 0u);
  FlowResult result;
  for (const FlowSettings& strategy : flow_variants()) {
    if (strategy.locality > 10) continue;  // too local for this
    result = flow(patch, strategy);
    if (result.clean) break;
  }
  EXPECT_TRUE(result.clean) << result.pairs_left;
  EXPECT_EQ(count_pairs(patch), 0u);
  EXPECT_LT(mean_displacement(patch), 0.25);
}

TEST(Flow, GivesUpEarlyWhereAStrategyHasNoEffect) {
  Patch patch = patch_of(figure_eight_torus());
  const FlowResult result = flow(patch, flow_variants()[0]);
  EXPECT_FALSE(result.clean);
  EXPECT_LT(result.iterations, flow_variants()[0].max_iterations);
  EXPECT_EQ(count_pairs(patch), result.pairs_left);
}

TEST(Flow, FreesALimbPressedThroughASheet) {
  Patch patch = patch_of(limb_and_sheet());
  expect_untangled(patch, 0.1, 1.2);
}

TEST(Flow, FixedVerticesAndObstaclesStayBitIdentical) {
  // The sheet stands still: only the limb may give way.
  Patch patch = patch_with_fixed(limb_and_sheet(), [](const Vec3& p) { return p[2] == 0.003; });
  ASSERT_LT(patch.active_count, static_cast<Index>(patch.triangles.size()));
  const Positions before = patch.rest;
  expect_untangled(patch, 0.2, 1.5);
  const Index fixed = static_cast<Index>(before.cols()) - patch.free_count;
  EXPECT_EQ(patch.x.rightCols(fixed), before.rightCols(fixed));
  EXPECT_EQ(patch.rest, before);
}

TEST(Flow, WorksInARegionWithFixedSurroundings) {
  // Two sheets, one dented through the other in the middle; only the middle may move.
  const auto sheet = [](double height, double dent) {
    return grid(20, 20, false, false, [=](double u, double v) {
      const double x = 4 * u - 2, y = 4 * v - 2;
      return Vec3(x, y, height - dent * std::exp(-4 * (x * x + y * y)));
    });
  };
  Shape shape = sheet(0.1, 0.25);
  shape.add(sheet(0.0, 0));
  Patch patch = patch_with_fixed(shape, [](const Vec3& p) { return p.head<2>().norm() > 1.5; });
  const Positions before = patch.rest;
  expect_untangled(patch, 0.05, 1.1);
  const Index fixed = static_cast<Index>(before.cols()) - patch.free_count;
  EXPECT_EQ(patch.x.rightCols(fixed), before.rightCols(fixed));
}

TEST(Flow, SeparatesCoincidentSheets) {
  const auto sheet = [] { return grid(6, 6, false, false, [](double u, double v) { return Vec3(u, v, 0); }); };
  Shape shape = sheet();
  shape.add(sheet());
  Patch patch = patch_of(shape);
  expect_untangled(patch, 0.05, 1.1);
}

TEST(Flow, OpensFoldsAndOneVertexCrossings) {
  // A strip folded back flat onto itself.
  Patch fold =
      patch_of(grid(8, 4, false, false, [](double u, double v) { return Vec3(u < 0.5 ? u : 1 - u, 0.5 * v, 0); }));
  expect_untangled(fold, 0.1, 1.2);
  // One vertex of a flat fan pulled across its neighbours.
  Shape fan;
  fan.points.push_back(Vec3::Zero());
  for (int k = 0; k < 8; ++k) fan.points.emplace_back(std::cos(tau * k / 8), std::sin(tau * k / 8), 0.1 * (k % 3));
  fan.points[1] = Vec3(-0.3, 0.75, 0.05);
  for (Index k = 0; k < 8; ++k) fan.triangles.push_back({0, k + 1, (k + 1) % 8 + 1});
  Patch crossing = patch_of(fan);
  ASSERT_GT(count_pairs(crossing), 0u);
  const FlowResult result = try_all(crossing);
  EXPECT_TRUE(result.clean) << result.pairs_left;
  EXPECT_EQ(count_pairs(crossing), 0u);
}

TEST(Flow, LeavesCleanInputAlone) {
  Patch patch = patch_of(sphere(Vec3(0, 0, 0), 1, 8));
  const FlowResult result = flow(patch, flow_variants()[0]);
  EXPECT_TRUE(result.clean);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(patch.x, patch.rest);
}

TEST(Flow, DuplicateFacesAndToleratedPairsAreLetBe) {
  Shape shape = sphere(Vec3(0, 0, 0), 1, 8);
  shape.triangles.push_back({shape.triangles[5][1], shape.triangles[5][2], shape.triangles[5][0]});
  Patch patch = patch_of(shape);
  ASSERT_EQ(count_pairs(patch), 1u);
  EXPECT_TRUE(flow(patch, flow_variants()[0]).clean);

  Patch tangled = patch_of(limb_and_sheet());
  const std::vector<IntersectingPair> pairs = IntersectionFinder(tangled.triangles).find(tangled.x);
  const FlowResult result = flow(tangled, flow_variants()[0], {}, pairs);
  EXPECT_TRUE(result.clean);
  EXPECT_EQ(tangled.x, tangled.rest);
}

TEST(Flow, StopsWhenToldToAndKeepsTheBestState) {
  Patch patch = patch_of(figure_eight_torus());
  const std::size_t before = count_pairs(patch);
  int asked = 0;
  const FlowResult result = flow(patch, flow_variants()[0], [&] { return ++asked > 100; });
  EXPECT_FALSE(result.clean);
  EXPECT_GT(result.iterations, 0);
  EXPECT_LE(result.iterations, 100) << "it asks once an iteration at least";
  EXPECT_LE(asked, 110) << "told so, it goes on";
  EXPECT_EQ(count_pairs(patch), result.pairs_left);
  EXPECT_LE(result.pairs_left, before);
}

TEST(Flow, GivesTheSameBytesAtAnyThreadCount) {
  std::vector<Positions> results;
  for (const std::size_t threads : {1, 2, 4}) {
    const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    Patch patch = patch_of(thick_trefoil());
    flow(patch, flow_variants()[0]);
    results.push_back(patch.x);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST(FlowSamples, MeansAndSpreadAreTransposes) {
  const Patch patch = patch_of(limb_and_sheet());
  const FlowSamples samples(patch.triangles, patch.rest, patch.free_count, 0.5);
  ASSERT_GT(samples.size(), 20);
  EXPECT_LT(samples.size(), patch.free_count / 2);
  double area = 0;
  for (Index c = 0; c < samples.size(); ++c) area += samples.area(c);
  EXPECT_NEAR(area, total_area(patch.rest, patch.triangles), 1e-9);
  Positions points, spread = Positions::Zero(3, patch.rest.cols());
  samples.points(patch.rest, points);
  Positions force(3, samples.size());
  for (Index c = 0; c < samples.size(); ++c) force.col(c) = Vec3(std::sin(c), std::cos(2 * c), c % 5);
  samples.spread(force, spread);
  EXPECT_NEAR(spread.cwiseProduct(patch.rest).sum(), force.cwiseProduct(points).sum(), 1e-9);
}

TEST(FlowSamples, GeodesicsFollowTheSurface) {
  // A cylinder of radius 1: half-way round is pi along the surface and 2 through space. A sphere apart is out of reach.
  Shape shape =
      grid(12, 40, false, true, [](double u, double v) { return Vec3(std::cos(tau * v), std::sin(tau * v), 2 * u); });
  shape.add(sphere(Vec3(0, 0, 1), 0.2, 6));
  const Patch patch = patch_of(shape);
  FlowSamples samples(patch.triangles, patch.rest, patch.free_count, 0.3);
  Positions points;
  samples.points(patch.rest, points);
  for (Index i = 0; i < samples.size(); ++i) {
    for (Index j = 0; j < samples.size(); ++j) {
      const double d = samples.geodesic(i, j, 5);
      const bool same = (points.col(i).head<2>().norm() > 0.5) == (points.col(j).head<2>().norm() > 0.5);
      if (!same) {
        EXPECT_EQ(d, 5);
        EXPECT_FALSE(samples.adjacent(i, j));
        continue;
      }
      EXPECT_GE(d, 0.95 * (points.col(i) - points.col(j)).norm());
      if (points.col(i).head<2>().norm() < 0.5) continue;
      const double angle = std::acos(
          std::clamp(points.col(i).head<2>().normalized().dot(points.col(j).head<2>().normalized()), -1.0, 1.0));
      const double exact = std::hypot(angle, points(2, i) - points(2, j));
      EXPECT_LE(d, 1.5 * exact + 0.1);  // a third of the spacing
      if (samples.adjacent(i, j)) {
        EXPECT_NE(i, j);
      }
    }
  }
}

class PaperUntangleTest : public testing::TestWithParam<std::pair<PaperBandwidth, bool>> {};

TEST_P(PaperUntangleTest, PartsTwoSpheres) {
  Shape shape = sphere(Vec3(0, 0, 0), 1, 12);
  shape.add(sphere(Vec3(1.9, 0.05, 0.02), 1, 12));
  Patch patch = patch_of(shape);
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

TEST(PaperUntangle, DoesNotDependOnTheUnit) {
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

TEST(PaperUntangle, EveryEnergyCanBeLeftOut) {
  Shape shape = sphere(Vec3(0, 0, 0), 1, 12);
  shape.add(sphere(Vec3(1.9, 0.05, 0.02), 1, 12));
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

TEST(PaperUntangle, BandwidthsAreScaledAfterTheyAreFound) {
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

TEST(PaperUntangle, GoesOnWhereNoDirectionDescends) {
  // With the penalty alone the first line search ends at a kink.
  Patch patch = patch_of(figure_eight_torus());
  PaperOptions options;
  options.lambda_gaussian = 0;
  options.lambda_mesh = 1;
  options.max_iterations = 60;
  EXPECT_EQ(paper_untangle(patch, options).iterations, 60);
}

TEST(PaperUntangle, OptionsHaveRanges) {
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

TEST(PaperUntangle, FixedVerticesStay) {
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
