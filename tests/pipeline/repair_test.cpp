// The whole of repair() on surfaces of the built-in generators, judged by a detector that shares no code with it. What
// must hold on any mesh (fixed vertices, distant components, obstructions, limits): tests/property.
#include "unsnarl/repair.h"
#include "geometry/jitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <thread>

#include "mesh/triangulation.h"
#include "oracle/intersections_oracle.h"
#include "pipeline/judged.h"
#include "scene/shapes.h"
#include "unsnarl/certify.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

using shapes::Shape;

std::vector<double> as_float32(std::vector<double> positions) {
  for (double& value : positions) value = static_cast<float>(value);
  return positions;
}

struct Expected {
  const char* sample;
  int resolution;
};

void PrintTo(const Expected& expected, std::ostream* out) {
  *out << expected.sample;
}

// One for each kind of trouble: double curves from boundary to boundary, closed ones, nested ones; closed components,
// boundaries, non-manifold edges, noise, quads, many components.
class Samples : public testing::TestWithParam<Expected> {};

TEST_P(Samples, are_embedded_afterwards_says_cgal) {
  const Surface surface = make_sample(GetParam().sample, GetParam().resolution);
  ASSERT_FALSE(judged(surface, surface.positions).empty()) << "the sample tests nothing";
  const RepairResult result = repair(surface);
  ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(judged(surface, result.positions).empty());
  EXPECT_TRUE(result.report.float32_embedded);
  EXPECT_TRUE(judged(surface, as_float32(result.positions)).empty());
  EXPECT_EQ(result.report.after.total(), 0u);
  EXPECT_TRUE(certify(surface, result.positions).embedded());
  // Nothing was thrown across the scene to get there, and the shape is still there.
  EXPECT_LT(result.report.displacement_max_rel, 0.35);
  EXPECT_LT(std::abs(result.report.area_change_rel), 0.3);
  // Recovery leaves hardly more of a separation than it was, also of one that went on from another.
  for (const RegionReport& region : result.report.regions)
    EXPECT_LE(region.displacement_rel, 1.5 * region.depth_rel) << region.strategy;

  // What is embedded is left alone.
  Surface repaired = surface;
  repaired.positions = result.positions;
  const RepairResult again = repair(repaired);
  EXPECT_EQ(again.status, Status::embedded);
  EXPECT_TRUE(again.positions == repaired.positions);
  EXPECT_EQ(again.report.untouched_share, 1);
  EXPECT_TRUE(again.report.regions.empty());
}

INSTANTIATE_TEST_SUITE_P(Repair, Samples,
                         testing::Values(Expected{"folded_sheet", 24}, Expected{"crossing_tubes", 20},
                                         Expected{"linked_rings", 20}, Expected{"crumpled_sheet", 40},
                                         Expected{"book", 16}, Expected{"posed_limb", 30},
                                         Expected{"helicoid_overlapping", 40}, Expected{"perforated_fold", 30}),
                         [](const auto& info) { return std::string(info.param.sample); });

TEST(Repair, strategies_to_do_without_must_exist) {
  RepairOptions options;
  options.without_strategies = {"slide_apart", "contour-3"};
  EXPECT_THROW(repair(shapes::crossing_bumps(8, 0.3).surface(), options), std::invalid_argument);
}

// Contours alone resolve it too, but carry parts of it 26 % of the diagonal away.
TEST(Repair, a_nearer_way_is_taken_where_the_first_goes_far) {
  const RepairResult result = repair(make_sample("spiral_sheet"));
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_LT(result.report.displacement_max_rel, 0.05);
}

// Two open tubes, one around the other, whose waves run through each other by a few edge lengths. Curves that go around
// them part along the tubes' normals; along one direction, the rim of one is dragged 15 % of the diagonal away.
TEST(Repair, layers_part_by_their_overlap) {
  struct Waves {
    double bottom, height;
    std::array<double, 3> counts, phases, heights;
  };
  const auto tube = [](double gap, const Waves& waves) {
    return shapes::grid(22, 44, true, [=](double i, double j) {
      const double z = waves.bottom + waves.height * i / 22, angle = 6.283185307179586 * j / 44;
      double r = 0.3 + 0.12 * std::cos(3 * z + 0.5) + gap;
      for (std::size_t k = 0; k < 3; ++k)
        r += 0.028 * waves.heights[k] *
             std::sin(waves.counts[k] * angle + (9 + 6 * static_cast<double>(k)) * z + waves.phases[k]);
      return Vec3(r * std::cos(angle), 0.7 * r * std::sin(angle), z);
    });
  };
  shapes::Shape layers = tube(0, {0.1, 0.8, {4, 5, 4}, {4.5, 4, 5.9}, {0.3, 1.1, 0.7}});
  layers.add(tube(0.028, {-0.1, 0.85, {4, 7, 5}, {3, 0.8, 0.5}, {1, 0.9, 0.7}}));
  const RepairResult result = repair(layers.surface());
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_LT(result.report.displacement_max_rel, 0.045);
  EXPECT_LT(result.report.displacement_mean_rel, 0.0025);
}

TEST(Repair, few_faces_end_turned_over) {
  std::size_t flipped = 0, triangles = 0;
  for (const Expected& sample : {Expected{"cross_cap_punctured", 22},
                                 {"cross_cap_punctured", 30},
                                 {"roman_punctured", 18},
                                 {"roman_punctured", 30}}) {
    const RepairResult result = repair(make_sample(sample.sample, sample.resolution));
    EXPECT_EQ(result.status, Status::embedded);
    flipped += result.report.flipped_triangles;
    triangles += result.report.topology.triangles;
  }
  EXPECT_LT(100 * flipped, triangles) << "one in a hundred";
}

TEST(Repair, what_has_no_conflict_does_not_move) {
  // A crossing in the middle of large sheets: far from it nothing may move.
  const Surface surface = shapes::crossing_bumps(30, 0.3).surface();
  const RepairResult result = repair(surface);
  ASSERT_EQ(result.status, Status::embedded);
  EXPECT_GT(result.report.untouched_share, 0.7);
  std::size_t moved_far_away = 0;
  for (std::size_t v = 0; v < surface.view().vertex_count(); ++v) {
    const double *p = &surface.positions[3 * v], *q = &result.positions[3 * v];
    if (std::max(std::abs(p[0]), std::abs(p[1])) > 12) moved_far_away += !std::equal(p, p + 3, q);
  }
  EXPECT_EQ(moved_far_away, 0u);
  // Both bumps give way, by about half the depth each.
  EXPECT_LT(result.report.displacement_max_rel * result.report.diagonal, 0.4);
  EXPECT_GT(result.report.displacement_max_rel * result.report.diagonal, 0.1);
}

TEST(Repair, embedded_input_comes_back) {
  Shape shape = shapes::bumpy_sheet(8, 1);
  shape.add(shapes::tube(6, 8, 0.5), {0, 0, 5}).add(shapes::bumpy_sheet(4, 0), {0, 0, 1.001});
  const Surface surface = shape.surface();
  ASSERT_TRUE(judged(surface, surface.positions).empty());
  const RepairResult result = repair(surface);
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_TRUE(result.positions == surface.positions);
  EXPECT_EQ(result.report.displacement_max_rel, 0);
}

TEST(Repair, same_bytes_on_one_two_and_four_threads) {
  // Several regions at once, some near each other.
  Shape shape;
  for (int k = 0; k < 4; ++k) shape.add(shapes::crossing_bumps(9, 0.2 + 0.1 * k), {9.5 * k, 0.3 * k, 0});
  const Surface surface = shape.surface();
  RepairOptions options;
  options.find.threads = 1;
  const RepairResult expected = repair(surface, options);
  EXPECT_EQ(expected.status, Status::embedded);
  for (const int threads : {2, 4}) {
    options.find.threads = threads;
    EXPECT_TRUE(repair(surface, options).positions == expected.positions) << threads << " threads";
  }
}

TEST(Repair, quads_and_concave_polygons) {
  // Sheets of quads, and an L of six corners that is pierced by both ends of the other sheet.
  Surface surface;
  const auto sheet = [&](int n, const auto& point) {
    const auto first = static_cast<std::int32_t>(surface.view().vertex_count());
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const Vec3 p = point(static_cast<double>(i), static_cast<double>(j));
        surface.positions.insert(surface.positions.end(), {p[0], p[1], p[2]});
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const std::int32_t a = first + i * (n + 1) + j;
        surface.corners.insert(surface.corners.end(), {a, a + n + 1, a + n + 2, a + 1});
        surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
      }
  };
  surface.offsets = {0};
  sheet(8, [](double i, double j) {
    return Vec3(i - 4, j - 4, 0.7 * std::exp(-0.3 * ((i - 4) * (i - 4) + (j - 4) * (j - 4))));
  });
  const auto first = static_cast<std::int32_t>(surface.view().vertex_count());
  for (const Vec3& p : {Vec3(-1.2, -1.1, 0.5), Vec3(2.3, -1.1, 0.5), Vec3(2.3, 0.2, 0.5), Vec3(0.4, 0.2, 0.5),
                        Vec3(0.4, 2.1, 0.5), Vec3(-1.2, 2.1, 0.5)})
    surface.positions.insert(surface.positions.end(), {p[0], p[1], p[2]});
  for (std::int32_t k = 0; k < 6; ++k) surface.corners.push_back(first + k);
  surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));

  ASSERT_FALSE(judged(surface, surface.positions).empty());
  const std::vector<Triangle> cut = triangulate(surface).triangles;
  const RepairResult result = repair(surface);
  ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
  // The cut is the input's, whatever one of the result would be.
  EXPECT_TRUE(oracle::intersections_by_cgal(result.positions, cut).empty());
  EXPECT_TRUE(find_intersections({surface.positions, surface.corners, surface.offsets}).size() ==
              result.report.before.total());
}

TEST(Repair, duplicate_faces_are_named_and_the_rest_is_repaired) {
  Surface surface = shapes::crossing_bumps(8, 0.3).surface();
  const auto count = static_cast<std::int32_t>(surface.view().face_count());
  surface.corners.insert(surface.corners.end(), {surface.corners[3], surface.corners[5], surface.corners[4]});
  const RepairResult result = repair(surface);
  EXPECT_EQ(result.status, Status::obstructed);
  ASSERT_EQ(result.report.obstructions.size(), 1u);
  EXPECT_EQ(result.report.obstructions[0].faces, (std::vector<std::int32_t>{1, count}));
  const std::vector<IntersectingPair> left = judged(surface, result.positions);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].kind, PairClass::duplicate);
}

TEST(Repair, what_no_motion_can_embed_is_refused_untouched) {
  for (const char* name : {"klein_bottle", "boy_surface"}) {
    const Surface surface = make_sample(name, 16);
    const RepairResult result = repair(surface);
    EXPECT_EQ(result.status, Status::obstructed) << name;
    EXPECT_TRUE(result.positions == surface.positions);
    EXPECT_EQ(result.report.after.by_class, result.report.before.by_class);
    ASSERT_EQ(result.report.obstructions.size(), 1u);
    EXPECT_EQ(result.report.obstructions[0].kind, Obstruction::Kind::closed_non_orientable);
  }
}

TEST(Repair, the_paper_s_method_says_how_far_it_untangled_before_it_recovered) {
  const Surface surface = shapes::crossing_bumps(8, 0.3).surface();
  RepairOptions options;
  options.goal = Goal::disjoint;
  options.paper.emplace();
  options.recover = false;
  const RepairResult untangled = repair(surface, options);
  ASSERT_TRUE(untangled.report.before_recovery);
  EXPECT_TRUE(untangled.report.before_recovery->is_clean);
  EXPECT_NEAR(untangled.report.before_recovery->displacement_mean_rel, untangled.report.displacement_mean_rel, 1e-6);
  EXPECT_NEAR(untangled.report.before_recovery->displacement_max_rel, untangled.report.displacement_max_rel, 1e-6);
  options.recover = true;
  const RepairResult recovered = repair(surface, options);
  EXPECT_EQ(recovered.report.before_recovery->displacement_mean_rel,
            untangled.report.before_recovery->displacement_mean_rel);
  EXPECT_LT(recovered.report.displacement_mean_rel, 0.5 * recovered.report.before_recovery->displacement_mean_rel);
  options.paper->max_iterations = 0;
  EXPECT_FALSE(repair(surface, options).report.before_recovery->is_clean);
  EXPECT_FALSE(repair(surface).report.before_recovery);
}

TEST(Repair, the_goal_disjoint_leaves_faces_that_share_a_vertex) {
  // A fan whose faces cross beyond their common vertex, next to two sheets that cross.
  Shape shape = shapes::crossing_bumps(8, 0.3);
  Shape fan;
  fan.points = {Vec3(0, 0, 0), Vec3(2, -1, 0), Vec3(2, 1, 0), Vec3(2, 0, -1), Vec3(2.1, 0, 1)};
  fan.triangles = {{0, 1, 2}, {0, 3, 4}};
  shape.add(fan, {20, 0, 0});
  const Surface surface = shape.surface();
  RepairOptions options;
  options.goal = Goal::disjoint;
  const RepairResult paper = repair(surface, options);
  EXPECT_EQ(paper.status, Status::embedded);
  EXPECT_EQ(paper.report.after[PairClass::disjoint], 0u);
  EXPECT_EQ(paper.report.after[PairClass::one_vertex], 1u);
  EXPECT_TRUE(std::equal(surface.positions.end() - 15, surface.positions.end(), paper.positions.end() - 15));
  const RepairResult all = repair(surface);
  EXPECT_EQ(all.status, Status::embedded);
  EXPECT_TRUE(judged(surface, all.positions).empty());
}

TEST(Repair, a_time_limit_is_kept_and_leaves_nothing_worse) {
  const Surface surface = shapes::crossing_bumps(40, 3).surface();
  RepairOptions options;
  options.time_limit_s = 0.001;  // over before the first search is
  const auto begin = std::chrono::steady_clock::now();
  const RepairResult result = repair(surface, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(result.status, Status::time_limit) << to_string(result.status);
  EXPECT_LT(seconds, 3) << "the limit was 0.001 s";
  EXPECT_LE(judged(surface, result.positions).size(), judged(surface, surface.positions).size());
}

TEST(Repair, a_memory_limit_is_kept) {
  RepairOptions options;
  options.memory_limit_mb = 1;  // less than the program itself
  const Surface surface = shapes::crossing_bumps(10, 0.3).surface();
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::memory_limit) << to_string(result.status);
  EXPECT_LE(result.report.after.total(), result.report.before.total());
}

TEST(Repair, progress_goes_forward_through_the_phases) {
  Context context;
  std::vector<Context::Progress> seen;
  context.on_progress = [&](const Context::Progress& progress) { seen.push_back(progress); };
  const Surface surface = shapes::crossing_bumps(12, 0.4).surface();
  const RepairResult result = repair(surface, {}, &context);
  ASSERT_GE(seen.size(), 3u);
  for (std::size_t k = 1; k < seen.size(); ++k) EXPECT_GE(seen[k].fraction, seen[k - 1].fraction);
  EXPECT_EQ(seen.back().fraction, 1);
  EXPECT_EQ(seen.back().pairs_left, 0u);
  EXPECT_EQ(seen.back().phase, "certify");
  EXPECT_EQ(seen.front().phase, "untangle");
  EXPECT_GT(seen.front().pairs_left, 0u);
  EXPECT_EQ(seen.front().displacement_rel, 0);
  EXPECT_NEAR(seen.back().displacement_rel, result.report.displacement_max_rel, 1e-12);
  EXPECT_GT(seen.back().displacement_rel, 0);
}

// Two tangles far apart are worked on in two threads, where there are two.
TEST(Repair, progress_is_told_in_the_thread_of_the_caller_alone) {
  Shape shape = shapes::crossing_bumps(12, 0.4);
  shape.add(shapes::crossing_bumps(12, 0.4), {100, 0, 0});
  const Surface surface = shape.surface();
  const std::thread::id here = std::this_thread::get_id();
  Context context;
  int reports = 0;
  context.on_progress = [&](const Context::Progress&) {
    ++reports;
    EXPECT_EQ(std::this_thread::get_id(), here);
  };
  RepairOptions options;
  options.find.threads = 2;
  const RepairResult result = repair(surface, options, &context);
  EXPECT_GE(reports, 3);
  EXPECT_EQ(result.positions, repair(surface, options).positions) << "who watches changes nothing";
  context.on_progress = [](const Context::Progress&) { throw std::out_of_range("caller"); };
  EXPECT_THROW(repair(surface, options, &context), std::out_of_range);
  EXPECT_THROW(context.on_progress({}), std::out_of_range) << "it is the caller's again";
}

TEST(Repair, the_stages_are_timed) {
  const RepairResult result = repair(shapes::crossing_bumps(8, 0.3).surface());
  ASSERT_GE(result.report.stages.size(), 4u);
  EXPECT_EQ(result.report.stages.front().name, "diagnose");
  EXPECT_EQ(result.report.stages.back().name, "certify");
  for (const StageReport& stage : result.report.stages) {
    EXPECT_GE(stage.seconds, 0);
    EXPECT_GE(stage.cpu_seconds, 0);
    EXPECT_GT(stage.peak_memory_mb, 1);
  }
}

TEST(Repair, holds_as_it_will_be_written) {
  // A reader who sees but three digits after the point.
  const auto three_digits = [](std::span<const double> positions, bool) {
    std::vector<double> written(positions.begin(), positions.end());
    for (double& c : written) c = std::round(c * 1000) / 1000;
    return written;
  };
  Surface surface = shapes::crossing_bumps(10, 0.3).surface();
  surface.positions = three_digits(surface.positions, true);
  RepairOptions options;
  int calls = 0;
  options.as_written = [&](std::span<const double> positions, bool float32) {
    ++calls;
    return three_digits(positions, float32);
  };
  options.min_gap_rel = 3e-3 / 20;  // one step of the digits is 1e-3, the diagonal some 15
  const RepairResult result = repair(surface, options);
  EXPECT_GT(calls, 0);
  ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(result.positions == three_digits(result.positions, true)) << "not what a reader will see";
  EXPECT_TRUE(judged(surface, result.positions).empty());
}

TEST(Repair, float32_is_made_to_hold_where_coordinates_allow_it) {
  const Shape near = shapes::crossing_bumps(10, 0.3);
  const RepairResult result = repair(near.surface());
  EXPECT_EQ(result.report.precision, Precision::float32);
  const std::vector<double> original = near.surface().positions;
  for (std::size_t k = 0; k < original.size(); ++k)
    EXPECT_TRUE(result.positions[k] == original[k] || result.positions[k] == static_cast<float>(result.positions[k]));
  // 1e7 away from the origin a float32 step is as long as an edge.
  Shape far;
  far.add(near, {1e7, 2e7, 0});
  const RepairResult there = repair(far.surface());
  EXPECT_EQ(there.report.precision, Precision::float64);
  EXPECT_EQ(there.status, Status::embedded);
  EXPECT_FALSE(there.report.float32_embedded);
  EXPECT_TRUE(judged(far.surface(), there.positions).empty());
  RepairOptions options;
  options.precision = Precision::float64;
  const RepairResult asked = repair(near.surface(), options);
  EXPECT_EQ(asked.report.precision, Precision::float64);
  EXPECT_TRUE(judged(near.surface(), asked.positions).empty());
}

TEST(Repair, coordinates_beyond_float32_are_repaired_in_float64) {
  // Two tetrahedra, one with a corner in the other.
  Surface surface;
  surface.positions = {0,   0,   0,   4,   0,   0, 0,   4,   0,   0,   0,   4,  //
                       1.2, 1.2, 1.1, 2.6, 2.5, 2, 2.5, 2.6, 2.2, 2.4, 2.4, 2.7};
  surface.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4, 6, 5, 4, 5, 7, 5, 6, 7, 4, 7, 6};
  for (const int exponent : {140, 300, 600}) {
    Surface scaled = surface;
    for (double& value : scaled.positions) value = std::ldexp(value, exponent);
    for (const auto precision : {std::optional<Precision>(), std::optional(Precision::float32)}) {
      RepairOptions options;
      options.precision = precision;
      const RepairResult result = repair(scaled, options);
      EXPECT_GT(result.report.before.total(), 0u);
      if (exponent == 140) {
        EXPECT_EQ(result.status, precision ? Status::reduced : Status::embedded);  // not in float32, as asked for
      }
      EXPECT_TRUE(
          std::all_of(result.positions.begin(), result.positions.end(), [](double v) { return std::isfinite(v); }));
      EXPECT_EQ(result.report.precision, Precision::float64);
      EXPECT_FALSE(result.report.float32_embedded);
      const Certificate certificate = certify(scaled, result.positions);
      EXPECT_EQ(precision ? certificate.embedded() && certificate.float32_embedded() : certificate.embedded(),
                result.status == Status::embedded);
    }
  }
}

TEST(Repair, float32_that_is_asked_for_is_binding) {
  // Two triangles that only rounding brings together, and that may not move.
  Surface surface;
  surface.positions = {0, 0, 1, 1, 0, 1, 0, 1, 1, 0, 0, 1 + 1e-10, 1, 0, 1 + 1e-10, 0, 1, 1 + 1e-10};
  surface.corners = {0, 1, 2, 3, 4, 5};
  RepairOptions options;
  options.fixed.assign(6, 1);
  EXPECT_EQ(repair(surface, options).status, Status::embedded);
  options.precision = Precision::float32;
  const RepairResult fixed = repair(surface, options);
  EXPECT_EQ(fixed.status, Status::no_progress);
  EXPECT_EQ(fixed.report.after.total(), 0u);
  EXPECT_FALSE(fixed.report.float32_embedded);
  options.fixed.clear();
  const RepairResult free = repair(surface, options);
  EXPECT_EQ(free.status, Status::embedded);
  EXPECT_TRUE(free.report.float32_embedded);
}

TEST(Repair, a_part_far_away_does_not_change_the_precision) {
  const Shape tangle = shapes::crossing_bumps(10, 0.3);
  const RepairResult alone = repair(tangle.surface());
  const RepairResult together = repair(Shape(tangle).add(shapes::bumpy_sheet(3, 0), {1e6, 0, 0}).surface());
  EXPECT_EQ(together.report.precision, alone.report.precision);
  EXPECT_TRUE(std::equal(alone.positions.begin(), alone.positions.end(), together.positions.begin()));
}

// Embedded in double, touching in float32: opened unless float64 is all that is asked for.
TEST(Repair, sheets_that_only_rounding_brings_together_are_parted) {
  Shape shape = shapes::bumpy_sheet(4, 0);
  for (Vec3& p : shape.points) p[2] += 1;
  shape.add(shapes::bumpy_sheet(2, 0), {0.01, 0.02, 1 + 1e-8});
  const Surface surface = shape.surface();
  ASSERT_TRUE(judged(surface, surface.positions).empty());
  ASSERT_FALSE(judged(surface, as_float32(surface.positions)).empty());
  RepairOptions options;
  options.precision = Precision::float32;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(judged(surface, as_float32(result.positions)).empty());
  options.precision = Precision::float64;
  EXPECT_TRUE(repair(surface, options).positions == surface.positions);
  // Nobody asked for float32: what is embedded comes back, alone and beside something to repair.
  const RepairResult unasked = repair(surface);
  EXPECT_EQ(unasked.status, Status::embedded);
  EXPECT_TRUE(unasked.positions == surface.positions);
  EXPECT_FALSE(unasked.report.float32_embedded);
  const RepairResult beside = repair(Shape(shape).add(shapes::crossing_bumps(8, 0.3), {30, 0, 0}).surface());
  EXPECT_EQ(beside.status, Status::embedded);
  EXPECT_TRUE(std::equal(surface.positions.begin(), surface.positions.end(), beside.positions.begin()));
}

/// As a modeller leaves them: a strip whose upper border runs straight at a far vertex, but for the last digits, and
/// the needles between the border's edges and that vertex. They run over the strip for as much as the border is not
/// straight.
Shape fan_of_needles(double roughness, Index cells = 12) {
  Shape shape;
  shape.points.push_back({9000, 0, 0});
  for (Index i = 0; i <= cells; ++i) {
    shape.points.push_back({-10. * i, roughness * jitter(i, 0), roughness * jitter(i, 1)});
    shape.points.push_back({-10. * i + 3, 0.7, -0.7});
  }
  for (Index i = 0; i < cells; ++i) {
    const Index upper = 1 + 2 * i, lower = upper + 1;
    shape.triangles.push_back({upper, lower, upper + 2});
    shape.triangles.push_back({lower, lower + 2, upper + 2});
    shape.triangles.push_back({0, upper, upper + 2});
  }
  return shape;
}

TEST(Repair, needles_part_by_about_what_they_overlap) {
  constexpr double roughness = 3e-4;  // five orders of magnitude below the longest edges
  const Surface surface = fan_of_needles(roughness).surface();
  ASSERT_FALSE(judged(surface, surface.positions).empty());
  RepairOptions options;
  options.precision = Precision::float64;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(judged(surface, result.positions).empty());
  EXPECT_LT(result.report.displacement_max_rel * result.report.diagonal, 4 * roughness);
}

// By a writer whose short numbers are so short that no two sheets stay apart.
TEST(Repair, float32_is_given_up_where_no_way_is_found_to_hold_it) {
  const Surface surface = shapes::crossing_bumps(8, 0.3).surface();
  RepairOptions options;
  options.as_written = [](std::span<const double> positions, bool float32) {
    std::vector<double> written(positions.begin(), positions.end());
    if (float32)
      for (double& value : written) value = 2 * std::round(value / 2);
    return written;
  };
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(judged(surface, result.positions).empty());
  EXPECT_EQ(result.report.precision, Precision::float64);
  options.precision = Precision::float32;
  EXPECT_NE(repair(surface, options).status, Status::embedded);
}

// Least distance between vertices of one sheet and faces of the other, by brute force.
double gap_between(const Surface& surface, const std::vector<double>& positions, std::size_t first_vertices) {
  const auto at = [&](std::size_t v) { return Vec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]); };
  double least = INFINITY;
  for (std::size_t f = 0; f < surface.view().face_count(); ++f) {
    const auto face = surface.view().face(f);
    const bool face_first = static_cast<std::size_t>(face[0]) < first_vertices;
    const Vec3 a = at(face[0]), b = at(face[1]), c = at(face[2]), n = (b - a).cross(c - a).normalized();
    for (std::size_t v = face_first ? first_vertices : 0; v < (face_first ? positions.size() / 3 : first_vertices);
         ++v) {
      const Vec3 p = at(v);
      bool inside = true;
      for (const auto& [u, w] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        inside &= n.dot((w - u).cross(p - u)) >= 0;
      if (inside) least = std::min(least, std::abs(n.dot(p - a)));
    }
  }
  return least;
}

TEST(Repair, a_wanted_gap_is_opened) {
  const Shape shape = shapes::crossing_bumps(12, 0.3);
  const Surface surface = shape.surface();
  const std::size_t first = shape.points.size() / 2;
  double before = 0;
  for (const double gap : {0.0, 0.004, 0.01}) {
    RepairOptions options;
    options.min_gap_rel = gap;
    const RepairResult result = repair(surface, options);
    ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
    const double reached = gap_between(surface, result.positions, first);
    EXPECT_GE(reached, 0.99 * gap * result.report.diagonal);
    EXPECT_GE(result.report.min_gap_rel, 0.99 * gap);
    EXPECT_GT(reached, before);
    before = reached;
  }
}

TEST(Repair, stopping_after_untangling_is_embedded_too) {
  RepairOptions options;
  options.recover = false;
  const Surface surface = shapes::crossing_bumps(10, 0.4).surface();
  const RepairResult raw = repair(surface, options), recovered = repair(surface);
  EXPECT_EQ(raw.status, Status::embedded);
  EXPECT_TRUE(judged(surface, raw.positions).empty());
  // Recovery is there to come nearer to the input.
  EXPECT_LE(recovered.report.displacement_rms_rel, raw.report.displacement_rms_rel * 1.05);
}

TEST(Repair, one_free_vertex_may_not_be_enough) {
  // All corners of two squares through each other are fixed but one. Whether or not that one can part them: nothing
  // gets worse and nothing fixed moves.
  const Surface surface = shapes::crossed_squares().surface();
  RepairOptions options;
  options.fixed.assign(8, 1);
  options.fixed[7] = 0;
  const RepairResult result = repair(surface, options);
  EXPECT_LE(judged(surface, result.positions).size(), judged(surface, surface.positions).size());
  EXPECT_TRUE(std::equal(surface.positions.begin(), surface.positions.begin() + 21, result.positions.begin()));
  EXPECT_EQ(result.report.after.total(), judged(surface, result.positions).size());
}

TEST(Repair, too_large_a_displacement_is_said) {
  const Surface surface = shapes::crossing_bumps(10, 0.4).surface();
  RepairOptions options;
  options.max_displacement_rel = 1e-6;
  EXPECT_EQ(repair(surface, options).status, Status::displacement_exceeded);
  options.max_displacement_rel = 0.5;
  EXPECT_EQ(repair(surface, options).status, Status::embedded);
}

// Soups on lattices of tiny integers: zero-area faces, repeated corners, duplicates, faces in touch and in one plane.
TEST(Repair, soups_are_never_made_worse) {
  const auto disjoint = [](const std::vector<IntersectingPair>& pairs) {
    return std::count_if(pairs.begin(), pairs.end(), [](const auto& p) { return p.kind == PairClass::disjoint; });
  };
  std::map<Status, int> seen;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    Surface soup;
    const int vertices = 4 + below(20), faces = 2 + below(14), lattice = 2 + below(6);
    for (int k = 0; k < 3 * vertices; ++k)
      soup.positions.push_back(below(lattice) + (seed % 2 ? 0.001 * below(1000) : 0));
    for (int k = 0; k < 3 * faces; ++k) soup.corners.push_back(below(vertices));
    RepairOptions options;
    options.find.weld = Weld::none;
    if (seed % 3 == 0) {
      for (int v = 0; v < vertices; ++v) options.fixed.push_back(below(3) == 0);
    }
    const std::vector<Triangle> cut = triangulate(soup).triangles;
    const auto before = oracle::intersections_by_cgal(soup.positions, cut);
    const RepairResult result = repair(soup, options);
    const auto after = oracle::intersections_by_cgal(result.positions, cut);
    ++seen[result.status];
    EXPECT_LE(after.size(), before.size());
    EXPECT_LE(disjoint(after), disjoint(before));
    EXPECT_EQ(result.report.before.total(), before.size());
    EXPECT_EQ(result.report.after.total(), after.size());
    const Certificate certificate = certify(soup, result.positions, options.find);
    EXPECT_EQ(certificate.pairs.total(), after.size());
    if (result.status == Status::embedded) {
      EXPECT_TRUE(certificate.embedded());
    }
    if (result.status == Status::obstructed) {
      EXPECT_FALSE(result.report.obstructions.empty());
    }
    for (std::size_t v = 0; v < options.fixed.size(); ++v) {
      EXPECT_TRUE(!options.fixed[v] ||
                  std::equal(&soup.positions[3 * v], &soup.positions[3 * v] + 3, &result.positions[3 * v]));
    }
  }
  EXPECT_GT(seen[Status::embedded], 20);
  EXPECT_GT(seen[Status::obstructed], 3);
}

TEST(Repair, nothing_in_nothing_out) {
  const RepairResult result = repair(Surface{});
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_TRUE(result.positions.empty());
  Surface points;
  points.positions = {0, 0, 0, 0, 0, 0};
  EXPECT_EQ(repair(points).positions, points.positions);
}

TEST(Repair, names_of_what_comes_out) {
  EXPECT_EQ(to_string(Status::embedded), "embedded");
  EXPECT_EQ(to_string(Status::displacement_exceeded), "displacement_exceeded");
  EXPECT_EQ(to_string(Obstruction::Kind::closed_non_orientable), "closed_non_orientable");
}

}  // namespace
}  // namespace unsnarl
