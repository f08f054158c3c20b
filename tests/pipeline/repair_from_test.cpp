#include "pipeline/repair_from.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/judged.h"
#include "unsnarl/certify.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

TEST(RepairFrom, without_knowledge_it_is_repair) {
  const Surface tubes = make_sample("crossing_tubes", 16);
  const KnownSurface known(tubes, {});
  Finders finders(known.prepared.triangles(), known.prepared.scale);
  const RepairResult expected = repair(tubes), found = repair_from(tubes, known, finders, {}, nullptr);
  EXPECT_EQ(found.status, Status::embedded);
  EXPECT_TRUE(found.positions == expected.positions);
  EXPECT_EQ(found.report.before.by_class, expected.report.before.by_class);
  EXPECT_GT(found.report.before.total(), 0u);
}

TEST(RepairFrom, what_is_known_of_one_place_saves_nothing_where_vertices_move) {
  const Surface tubes = make_sample("crossing_tubes", 16);
  const RepairResult clean = repair(tubes);
  ASSERT_EQ(clean.status, Status::embedded);
  // Halfway back to the input they cross again.
  Surface between = tubes;
  for (std::size_t k = 0; k < between.positions.size(); ++k)
    between.positions[k] = 0.5 * (tubes.positions[k] + clean.positions[k]);
  const KnownSurface known(tubes, {});
  Finders anew(known.prepared.triangles(), known.prepared.scale),
      informed(known.prepared.triangles(), known.prepared.scale);
  informed.start_without_pairs(known.prepared.gather(clean.positions), clean.report.float32_embedded);
  const RepairResult expected = repair_from(between, known, anew, {}, nullptr);
  const RepairResult found = repair_from(between, known, informed, {}, nullptr);
  EXPECT_GT(found.report.before.total(), 0u);
  EXPECT_EQ(found.report.before.by_class, expected.report.before.by_class);
  EXPECT_EQ(found.status, Status::embedded);
  EXPECT_TRUE(found.positions == expected.positions);
  EXPECT_EQ(found.report.float32_embedded, expected.report.float32_embedded);
  EXPECT_TRUE(judged(tubes, found.positions).empty());
  EXPECT_TRUE(certify(tubes, found.positions).embedded());
}

// Of two squares a step apart, one is moved onto the other: that does not make them one.
TEST(RepairFrom, welding_stays_that_of_the_known_surface) {
  Surface surface;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      surface.positions.insert(surface.positions.end(), {static_cast<double>(x), static_cast<double>(y), z});
  surface.corners = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  const KnownSurface known(surface, {});
  Surface onto = surface;
  for (std::size_t v = 4; v < 8; ++v) onto.positions[3 * v + 2] = 0;
  Finders finders(known.prepared.triangles(), known.prepared.scale);
  finders.start_without_pairs(known.prepared.rest, true);
  const RepairResult found = repair_from(onto, known, finders, {}, nullptr);
  EXPECT_GT(found.report.before.total(), 0u);
  EXPECT_EQ(found.report.before[PairClass::duplicate], 0u);
  EXPECT_EQ(found.status, Status::embedded);
  EXPECT_TRUE(certify(surface, found.positions).embedded());
}

/// Returns the largest change of a coordinate, a length.
double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

TEST(RepairFrom, a_start_is_followed_and_left_toward_the_input) {
  const Surface tubes = make_sample("crossing_tubes", 16);
  const RepairResult before = repair(tubes);
  ASSERT_EQ(before.status, Status::embedded);
  const KnownSurface known(tubes, {});
  const Positions corrected = known.prepared.gather(before.positions);
  const auto repaired_from = [&](double share) {  // of the correction
    Finders finders(known.prepared.triangles(), known.prepared.scale);
    return repair_from(tubes, known, finders, {}, nullptr,
                       known.prepared.rest + share * (corrected - known.prepared.rest));
  };
  for (const double share : {1.0, 0.9, 3.0}) {
    const RepairResult found = repaired_from(share);
    EXPECT_EQ(found.status, Status::embedded) << share;
    EXPECT_TRUE(certify(tubes, found.positions).embedded()) << share;
    EXPECT_EQ(found.report.before.by_class, before.report.before.by_class) << share;
    EXPECT_LT(found.report.displacement_rms_rel, 1.1 * before.report.displacement_rms_rel) << share;
  }
  EXPECT_LT(largest_change(repaired_from(1).positions, before.positions),
            0.5 * largest_change(before.positions, tubes.positions));
}

TEST(RepairFrom, what_is_fixed_or_without_intersections_takes_nothing_from_a_start) {
  const Surface tubes = make_sample("crossing_tubes", 16);
  const KnownSurface known(tubes, {});
  const Positions elsewhere = known.prepared.rest.array() + 0.01;
  RepairOptions options;
  options.fixed.assign(tubes.positions.size() / 3, 0);
  for (std::size_t v = 0; v < options.fixed.size(); v += 7) options.fixed[v] = 1;
  Finders finders(known.prepared.triangles(), known.prepared.scale);
  const RepairResult found = repair_from(tubes, known, finders, options, nullptr, elsewhere);
  for (std::size_t v = 0; v < options.fixed.size(); ++v) {
    if (!options.fixed[v]) continue;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(found.positions[3 * v + k], tubes.positions[3 * v + k]);
  }

  const RepairResult clean = repair(tubes);
  const SurfaceView embedded = {clean.positions, tubes.corners, tubes.offsets};
  const KnownSurface known_clean(embedded, {});
  Finders of_clean(known_clean.prepared.triangles(), known_clean.prepared.scale);
  EXPECT_EQ(repair_from(embedded, known_clean, of_clean, {}, nullptr, elsewhere).positions, clean.positions);
}

}  // namespace
}  // namespace unsnarl
