// What must be true of repair whatever the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "oracle/intersections_oracle.h"
#include "property/meshes.h"
#include "unsnarl/certify.h"
#include "unsnarl/intersections.h"
#include "unsnarl/repair.h"

namespace unsnarl {
namespace {

struct NamedMesh {
  const char* name;
  Surface surface;
};
/// Self-intersecting, without obstruction.
std::vector<NamedMesh> tangles() {
  return {{"touching_tori", meshes::touching_tori()},
          {"curled_strip", meshes::curled_strip()},
          {"dented_sheets", meshes::dented_sheets()}};
}

std::vector<IntersectingPair> judged(const Surface& surface, const std::vector<double>& positions) {
  std::vector<oracle::OracleTriangle> triangles;
  for (std::size_t f = 0; f < surface.view().face_count(); ++f) {
    const auto face = surface.view().face(f);
    triangles.push_back({face[0], face[1], face[2]});
  }
  return oracle::intersections_by_cgal(positions, triangles);
}

std::vector<double> as_float32(std::vector<double> positions) {
  for (double& value : positions) value = static_cast<float>(value);
  return positions;
}

double diagonal_of(const Surface& surface) {
  std::array<double, 3> lo, hi;
  lo.fill(1e300), hi.fill(-1e300);
  for (std::size_t k = 0; k < surface.positions.size(); ++k) {
    lo[k % 3] = std::min(lo[k % 3], surface.positions[k]);
    hi[k % 3] = std::max(hi[k % 3], surface.positions[k]);
  }
  return std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
}

TEST(RepairProperties, result_is_embedded_in_both_precisions_says_cgal) {
  for (const auto& [name, surface] : tangles()) {
    SCOPED_TRACE(name);
    ASSERT_FALSE(judged(surface, surface.positions).empty()) << "the mesh tests nothing";
    const RepairResult result = repair(surface);
    EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
    ASSERT_EQ(result.positions.size(), surface.positions.size());
    EXPECT_TRUE(judged(surface, result.positions).empty());
    EXPECT_TRUE(result.report.float32_embedded);
    EXPECT_TRUE(judged(surface, as_float32(result.positions)).empty());
    EXPECT_EQ(result.report.after.total(), 0u);
    EXPECT_EQ(result.report.before.total(), find_intersections(surface).size());
  }
}

TEST(RepairProperties, what_is_reported_is_what_happened) {
  for (const auto& [name, surface] : tangles()) {
    SCOPED_TRACE(name);
    const RepairResult result = repair(surface);
    const RepairReport& report = result.report;
    std::size_t untouched = 0;
    double largest = 0;
    for (std::size_t v = 0; v < surface.view().vertex_count(); ++v) {
      const double *p = &surface.positions[3 * v], *q = &result.positions[3 * v];
      untouched += std::equal(p, p + 3, q);
      largest = std::max(largest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
    EXPECT_NEAR(report.diagonal, diagonal_of(surface), 1e-12);
    EXPECT_NEAR(report.untouched_share, static_cast<double>(untouched) / surface.view().vertex_count(), 1e-12);
    EXPECT_NEAR(report.displacement_max_rel * report.diagonal, largest, 1e-12 + 1e-6 * largest);
    EXPECT_LE(report.displacement_mean_rel, report.displacement_rms_rel * (1 + 1e-12));
    EXPECT_LE(report.displacement_rms_rel, report.displacement_max_rel * (1 + 1e-12));
    EXPECT_GT(report.displacement_max_rel, 0);
    if (result.status == Status::embedded) {
      EXPECT_GE(report.displacement_max_rel, report.displacement_lower_bound_rel);
    }
    EXPECT_GE(report.edge_stretch_max, report.edge_stretch_p999);
    EXPECT_GE(report.edge_stretch_p999, 1);
    EXPECT_FALSE(report.regions.empty());
  }
}

TEST(RepairProperties, embedded_input_comes_back_bit_for_bit) {
  for (const Surface& surface : {meshes::torus(), meshes::tube(), Surface{}}) {
    const RepairResult result = repair(surface);
    EXPECT_EQ(result.status, Status::embedded);
    EXPECT_TRUE(result.positions == surface.positions);
    EXPECT_EQ(result.report.untouched_share, 1);
    EXPECT_EQ(result.report.displacement_max_rel, 0);
  }
}

TEST(RepairProperties, a_repaired_mesh_is_left_alone) {
  for (const auto& [name, surface] : tangles()) {
    SCOPED_TRACE(name);
    Surface repaired = surface;
    repaired.positions = repair(surface).positions;
    EXPECT_TRUE(repair(repaired).positions == repaired.positions);
  }
}

TEST(RepairProperties, same_bytes_at_any_thread_count) {
  for (const auto& [name, surface] : tangles()) {
    SCOPED_TRACE(name);
    RepairOptions options;
    options.find.threads = 1;
    const std::vector<double> expected = repair(surface, options).positions;
    for (const int threads : {2, 4, 8}) {
      options.find.threads = threads;
      EXPECT_TRUE(repair(surface, options).positions == expected) << threads << " threads";
    }
  }
}

TEST(RepairProperties, a_distant_component_changes_no_byte) {
  for (const auto& [name, surface] : tangles()) {
    SCOPED_TRACE(name);
    const std::vector<double> alone = repair(surface).positions;
    // Far away, and with a tangle of its own.
    for (const Surface& distant : {meshes::torus(), meshes::dented_sheets()}) {
      const Surface together = meshes::joined(surface, meshes::translated(distant, 50, -20, 30));
      const std::vector<double> positions = repair(together).positions;
      EXPECT_TRUE(std::equal(alone.begin(), alone.end(), positions.begin()));
      const Surface after_it = meshes::joined(meshes::translated(distant, 50, -20, 30), surface);
      const std::vector<double> shifted = repair(after_it).positions;
      EXPECT_TRUE(std::equal(alone.rbegin(), alone.rend(), shifted.rbegin())) << "behind the other in the file";
    }
  }
}

// Exactly, as long as nothing overflows or underflows: no length in the program is absolute.
TEST(RepairProperties, scaling_by_a_power_of_two_scales_the_result) {
  for (const auto& [name, surface] : tangles()) {
    SCOPED_TRACE(name);
    for (const std::optional<Precision> precision :
         {std::optional<Precision>(), std::optional(Precision::float32), std::optional(Precision::float64)}) {
      RepairOptions options;
      options.precision = precision;
      const RepairResult expected = repair(surface, options);
      for (const int exponent : {-20, -3, 1, 20}) {
        SCOPED_TRACE(exponent);
        const double scale = std::ldexp(1, exponent);
        const auto scaled = [=](double* p) { p[0] *= scale, p[1] *= scale, p[2] *= scale; };
        const RepairResult result = repair(meshes::mapped(surface, scaled), options);
        EXPECT_EQ(result.status, expected.status);
        std::size_t different = 0;
        for (std::size_t k = 0; k < result.positions.size(); ++k)
          different += result.positions[k] != scale * expected.positions[k];
        EXPECT_EQ(different, 0u);
        EXPECT_EQ(result.report.displacement_max_rel, expected.report.displacement_max_rel);
      }
    }
  }
}

// What it takes to repair a mesh does not depend on where it lies and how it is numbered. The paths there do, a little.
void expect_alike(const RepairResult& result, const RepairResult& expected) {
  EXPECT_EQ(result.status, expected.status);
  EXPECT_EQ(result.report.before.by_class, expected.report.before.by_class);
  EXPECT_EQ(result.report.after.by_class, expected.report.after.by_class);
  const auto within = [](double value, double reference, double factor) {
    return value <= factor * reference && reference <= factor * value;
  };
  EXPECT_TRUE(within(result.report.displacement_max_rel, expected.report.displacement_max_rel, 1.5))
      << result.report.displacement_max_rel << " against " << expected.report.displacement_max_rel;
  EXPECT_TRUE(within(result.report.displacement_rms_rel, expected.report.displacement_rms_rel, 1.5))
      << result.report.displacement_rms_rel << " against " << expected.report.displacement_rms_rel;
}

TEST(RepairProperties, translation_and_rotation_change_little) {
  for (const auto& [name, surface] : tangles()) {
    SCOPED_TRACE(name);
    const RepairResult expected = repair(surface);
    expect_alike(repair(meshes::translated(surface, 3.7, -11.3, 5.1)), expected);
    expect_alike(repair(meshes::mapped(surface,
                                       [](double* p) {
                                         const double x = p[0], y = p[1], z = p[2];
                                         p[0] = y, p[1] = z, p[2] = x;
                                       })),
                 expected);
    // The box turns with it, so that lengths relative to its diagonal change; ask for the same angle in space instead.
    const RepairResult turned = repair(meshes::mapped(surface, [](double* p) {
      const double x = p[0], y = p[1], z = p[2], c = 0.8, s = 0.6;
      p[0] = c * x - s * y, p[1] = c * (s * x + c * y) - s * z, p[2] = s * (s * x + c * y) + c * z;
    }));
    EXPECT_EQ(turned.status, expected.status);
    EXPECT_LE(turned.report.displacement_max_rel * turned.report.diagonal,
              1.5 * expected.report.displacement_max_rel * expected.report.diagonal);
  }
}

TEST(RepairProperties, relabelling_changes_little) {
  for (const auto& [name, surface] : tangles()) {
    SCOPED_TRACE(name);
    // Vertices in another order, faces backwards, each from another corner.
    const auto n = static_cast<std::int32_t>(surface.view().vertex_count());
    const auto renamed = [n](std::int32_t v) { return (v * 13 + 3) % n; };
    ASSERT_NE(n % 13, 0);
    Surface other = surface;
    for (std::int32_t v = 0; v < n; ++v) std::copy_n(&surface.positions[3 * v], 3, &other.positions[3 * renamed(v)]);
    const std::size_t m = surface.view().face_count();
    for (std::size_t f = 0; f < m; ++f)
      for (std::size_t k = 0; k < 3; ++k)
        other.corners[3 * (m - 1 - f) + (k + f) % 3] = renamed(surface.corners[3 * f + k]);
    expect_alike(repair(other), repair(surface));
  }
}

// A program that reads the result cuts polygons by where their corners lie now. In the soups named, no way was found to
// a state in which that cut and the input's both hold.
TEST(RepairProperties, what_a_reader_of_polygons_finds_is_counted) {
  std::vector<unsigned> seeds = {303, 322, 328, 353, 376, 398, 553, 607, 869, 1015, 1075, 1448, 1484, 1651};
  for (unsigned seed = 0; seed < 300; ++seed) seeds.push_back(seed);
  for (const unsigned seed : seeds) {
    SCOPED_TRACE(seed);
    const Surface soup = meshes::polygon_soup(seed);
    const RepairResult result = repair(soup);
    Surface read = soup;
    read.positions = result.positions;
    const std::vector<IntersectingPair> found = find_intersections(read);
    EXPECT_LE(found.size(), result.report.before.total());
    EXPECT_EQ(certify(soup, result.positions).pairs.by_class, result.report.after.by_class);
    EXPECT_EQ(result.report.left.size(), result.report.after.total());
    for (const IntersectingPair& pair : found)
      EXPECT_TRUE(std::any_of(result.report.left.begin(), result.report.left.end(),
                              [&](const LeftPair& left) { return left.a == pair.a && left.b == pair.b; }))
          << pair.a << " and " << pair.b;
    if (result.status == Status::obstructed) {
      EXPECT_FALSE(result.report.obstructions.empty());
    }
  }
}

// A second run would cut polygons anew, by where their corners lie now.
TEST(RepairProperties, repaired_polygons_are_left_alone) {
  std::size_t repaired = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Surface soup = meshes::polygon_soup(seed);
    const RepairResult result = repair(soup);
    if (result.status != Status::embedded || result.report.before.total() == 0) continue;
    Surface again = soup;
    again.positions = result.positions;
    ++repaired;
    EXPECT_TRUE(repair(again).positions == again.positions);
  }
  EXPECT_GT(repaired, 150u);
}

TEST(RepairProperties, fixed_vertices_do_not_move) {
  for (const auto& [name, surface] : tangles()) {
    SCOPED_TRACE(name);
    RepairOptions options;
    options.fixed.assign(surface.view().vertex_count(), 0);
    for (std::size_t v = 0; v < options.fixed.size() / 2; ++v) options.fixed[v] = 1;
    const RepairResult result = repair(surface, options);
    EXPECT_TRUE(std::equal(surface.positions.begin(),
                           surface.positions.begin() + static_cast<std::ptrdiff_t>(3 * (options.fixed.size() / 2)),
                           result.positions.begin()));
    EXPECT_LE(judged(surface, result.positions).size(), judged(surface, surface.positions).size());
  }
}

TEST(RepairProperties, what_is_all_fixed_is_an_obstruction) {
  const Surface surface = meshes::touching_tori();
  RepairOptions options;
  options.fixed.assign(surface.view().vertex_count(), 1);
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::obstructed);
  EXPECT_TRUE(result.positions == surface.positions);
  ASSERT_FALSE(result.report.obstructions.empty());
  EXPECT_EQ(result.report.obstructions[0].kind, Obstruction::Kind::fixed_faces);
}

TEST(RepairProperties, duplicate_faces_are_named_and_all_else_repaired) {
  Surface surface = meshes::touching_tori();
  surface.corners.insert(surface.corners.end(), {surface.corners[1], surface.corners[2], surface.corners[0]});
  const auto last = static_cast<std::int32_t>(surface.view().face_count()) - 1;
  const RepairResult result = repair(surface);
  EXPECT_EQ(result.status, Status::obstructed);
  ASSERT_EQ(result.report.obstructions.size(), 1u);
  EXPECT_EQ(result.report.obstructions[0].kind, Obstruction::Kind::duplicate_faces);
  EXPECT_EQ(result.report.obstructions[0].faces, (std::vector<std::int32_t>{0, last}));
  const auto left = judged(surface, result.positions);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_TRUE((left[0] == IntersectingPair{0, last, PairClass::duplicate}));
}

TEST(RepairProperties, a_klein_bottle_is_refused_by_name) {
  const Surface surface = meshes::klein_bottle();
  ASSERT_FALSE(judged(surface, surface.positions).empty());
  const RepairResult result = repair(surface);
  EXPECT_EQ(result.status, Status::obstructed);
  EXPECT_TRUE(result.positions == surface.positions);
  ASSERT_FALSE(result.report.obstructions.empty());
  EXPECT_EQ(result.report.obstructions[0].kind, Obstruction::Kind::closed_non_orientable);
}

TEST(RepairProperties, a_klein_bottle_does_not_keep_others_from_repair) {
  const Surface tangle = meshes::dented_sheets();
  const Surface surface = meshes::joined(tangle, meshes::translated(meshes::klein_bottle(), 40, 0, 0));
  const RepairResult result = repair(surface);
  EXPECT_EQ(result.status, Status::obstructed);
  const std::vector<double> first_part(result.positions.begin(),
                                       result.positions.begin() + static_cast<std::ptrdiff_t>(tangle.positions.size()));
  EXPECT_TRUE(judged(tangle, first_part).empty());
}

TEST(RepairProperties, limits_are_kept) {
  const Surface surface = meshes::curled_strip();
  RepairOptions options;
  options.max_displacement_rel = 1e-9;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::displacement_exceeded) << to_string(result.status);
}

TEST(RepairProperties, cancelling_leaves_nothing_worse) {
  const Surface surface = meshes::curled_strip();
  const std::size_t before = judged(surface, surface.positions).size();
  Context at_once;
  at_once.cancel();
  EXPECT_EQ(repair(surface, {}, &at_once).status, Status::cancelled);

  Context soon;
  int calls = 0;
  double fraction = 0;
  soon.on_progress = [&](const Context::Progress& progress) {
    EXPECT_GE(progress.fraction, fraction);
    EXPECT_LE(progress.fraction, 1);
    fraction = progress.fraction;
    if (++calls == 2) soon.cancel();
  };
  const RepairResult result = repair(surface, {}, &soon);
  EXPECT_TRUE(result.status == Status::cancelled || calls < 2) << to_string(result.status);
  EXPECT_LE(judged(surface, result.positions).size(), before);
}

TEST(RepairProperties, senseless_options_are_refused) {
  const Surface surface = meshes::tube();
  RepairOptions options;
  options.fixed.assign(3, 1);
  EXPECT_THROW(repair(surface, options), std::invalid_argument) << "three flags for all vertices";
  options = {};
  options.max_displacement_rel = -1;
  EXPECT_THROW(repair(surface, options), std::invalid_argument);
  options = {};
  options.min_gap_rel = std::nan("");
  EXPECT_THROW(repair(surface, options), std::invalid_argument);
  options = {};
  options.find.threads = -1;
  EXPECT_THROW(repair(surface, options), std::invalid_argument);
  EXPECT_THROW(find_intersections(surface, options.find), std::invalid_argument);
  options = {};
  options.find.weld_tolerance = -1;
  EXPECT_THROW(repair(surface, options), std::invalid_argument);
  options.find.weld_tolerance = std::nan("");
  EXPECT_THROW(certify(surface, surface.positions, options.find), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
