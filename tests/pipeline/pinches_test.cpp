// Closed manifold surfaces whose vertices, edges and faces lie at one position: whoever reads the file by index sees
// sheets that touch, so they have to be separated. Judged by CGAL on the ids of the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "geometry/predicates.h"
#include "mesh/lens.h"
#include "oracle/intersections_oracle.h"
#include "scene/prepared_surface.h"
#include "unsnarl/certify.h"
#include "unsnarl/repair.h"

namespace unsnarl {
namespace {

using shapes::lens;
using shapes::LensPinch;

std::vector<Triangle> triangles_by_index(const Surface& surface) {
  return prepare(surface, {.weld = Weld::none}).triangulation.triangles;
}

std::size_t pairs_by_index(const Surface& surface, const std::vector<double>& positions) {
  return oracle::intersections_by_cgal(positions, triangles_by_index(surface)).size();
}

std::size_t faces_without_area(const Surface& surface, const std::vector<double>& positions) {
  const auto at = [&](Index v) { return Vec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]); };
  const std::vector<Triangle> triangles = triangles_by_index(surface);
  return static_cast<std::size_t>(std::count_if(
      triangles.begin(), triangles.end(), [&](const Triangle& t) { return collinear(at(t[0]), at(t[1]), at(t[2])); }));
}

std::vector<double> in_float32(std::vector<double> positions) {
  for (double& c : positions) c = static_cast<float>(c);
  return positions;
}

struct Pinched {
  const char* name;
  Surface surface;
};

void PrintTo(const Pinched& p, std::ostream* out) {
  *out << p.name;
}

class Pinches : public testing::TestWithParam<Pinched> {};

TEST_P(Pinches, are_opened_a_little_says_cgal_by_index) {
  const Surface& surface = GetParam().surface;
  ASSERT_GT(pairs_by_index(surface, surface.positions), 0u) << "it tests nothing";
  EXPECT_FALSE(certify(surface, surface.positions).embedded());
  const RepairResult result = repair(surface);
  ASSERT_EQ(result.status, Status::embedded) << result.report.before.total() << " -> " << result.report.after.total();
  const Certificate certificate = certify(surface, result.positions);
  EXPECT_TRUE(certificate.embedded());
  EXPECT_TRUE(certificate.float32_embedded());
  for (const std::vector<double>& positions : {result.positions, in_float32(result.positions)}) {
    EXPECT_EQ(pairs_by_index(surface, positions), 0u);
    EXPECT_EQ(faces_without_area(surface, positions), 0u);
  }
  // Nothing crosses, so next to nothing has to move: 2e-7 to 2e-6 measured, 2e-5 where edges have no length.
  EXPECT_LT(result.report.displacement_max_rel, 1e-4);
  Surface repaired = surface;
  repaired.positions = result.positions;
  EXPECT_EQ(repair(repaired).positions, repaired.positions);
}

/// Two to six sheets of one ball at its centre.
Surface ball_with_sheets_at_its_centre(int sheets) {
  Surface ball = lens(12, LensPinch::none);
  for (int k = 0; k < sheets; ++k) {
    const int inner_ring = 12 + 1 + 2 * k;  // vertices of the front, no two of them neighbours
    std::fill_n(&ball.positions[3 * inner_ring], 3, 0.0);
  }
  return ball;
}

INSTANTIATE_TEST_SUITE_P(Repair, Pinches,
                         testing::Values(Pinched{"two_vertices", lens(6, LensPinch::vertices)},
                                         Pinched{"two_edges", lens(6, LensPinch::edges)},
                                         Pinched{"two_fans", lens(6, LensPinch::fans)},
                                         Pinched{"two_sided_sheet", lens(6, LensPinch::all)},
                                         Pinched{"two_sided_sheet_cut_otherwise", lens(6, LensPinch::other_diagonals)},
                                         Pinched{"ends_of_an_edge", lens(6, LensPinch::ends_of_an_edge)},
                                         Pinched{"fan_in_a_point", lens(6, LensPinch::fan_in_a_point)},
                                         Pinched{"two_sheets", ball_with_sheets_at_its_centre(2)},
                                         Pinched{"six_sheets", ball_with_sheets_at_its_centre(6)}),
                         [](const auto& info) { return std::string(info.param.name); });

/// Four sheets of two faces each whose borders lie in one edge: which belong together is not said.
TEST(AmbiguousSeams, are_separated) {
  Surface pages;
  for (int k = 0; k < 4; ++k) {
    const double x = k < 2 ? 1 : -1, y = k % 2 ? 1 : -1;
    const Index a = 4 * k;
    pages.positions.insert(pages.positions.end(), {0, 0, 0, 0, 0, 1, x, y, 0.5, 2 * x, 2 * y, 1});
    if (k % 2)
      pages.corners.insert(pages.corners.end(), {a, a + 1, a + 2, a + 1, a + 3, a + 2});
    else
      pages.corners.insert(pages.corners.end(), {a + 1, a, a + 2, a + 3, a + 1, a + 2});
  }
  EXPECT_EQ(pairs_by_index(pages, pages.positions), 6u * 4u);
  const RepairResult result = repair(pages);
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_EQ(pairs_by_index(pages, result.positions), 0u);
  EXPECT_LT(result.report.displacement_max_rel, 1e-5);
}

}  // namespace
}  // namespace unsnarl
