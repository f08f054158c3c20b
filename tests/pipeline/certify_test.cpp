#include "unsnarl/certify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

TEST(Certify, the_input_itself) {
  const Surface sheet = shapes::bumpy_sheet(4, 0.5).surface();
  const Certificate good = certify(sheet, sheet.positions);
  EXPECT_TRUE(good.embedded());
  EXPECT_TRUE(good.float32_embedded());
  const Shape crossing = shapes::crossing_bumps(6, 0.4);
  const Certificate bad = certify(crossing.surface(), crossing.surface().positions);
  EXPECT_FALSE(bad.embedded());
  EXPECT_EQ(bad.pairs.total(), shapes::pairs_of(crossing).size());
}

// Parallel triangles a third of a float32 unit apart: apart in double, touching after rounding.
TEST(Certify, touching_after_rounding) {
  Surface surface;
  const double step = 0x1p-23 / 3;
  surface.positions = {0, 0, 1, 1, 0, 1, 0, 1, 1, 0, 0, 1 + step, 1, 0, 1 + step, 0, 1, 1 + step};
  surface.corners = {0, 1, 2, 3, 4, 5};
  const Certificate close = certify(surface, surface.positions);
  EXPECT_TRUE(close.embedded());
  EXPECT_FALSE(close.float32_embedded());
  EXPECT_EQ((*close.pairs_float32)[PairClass::disjoint], 1u);
  for (std::size_t k : {11, 14, 17}) surface.positions[k] = 1 + 0x1p-23;
  EXPECT_TRUE(certify(surface, surface.positions).float32_embedded());
}

// Vertices that come to lie in one place later were not one in the input: they touch, and touching is intersecting.
TEST(Certify, welding_is_decided_on_the_input) {
  Surface apart;
  apart.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0, -1, 1, -1, 0, 1};
  apart.corners = {0, 1, 2, 3, 4, 5};
  std::vector<double> touching = apart.positions;
  touching[3 * 3 + 2] = 0;  // vertex 3 onto vertex 0
  EXPECT_TRUE(certify(apart, apart.positions).embedded());
  const Certificate certificate = certify(apart, touching, {.weld = Weld::all});
  EXPECT_FALSE(certificate.embedded());
  EXPECT_EQ(certificate.pairs.total(), 1u);
  // Where they coincide in the input, they count as one, if all are welded.
  Surface welded = apart;
  welded.positions = touching;
  EXPECT_TRUE(certify(welded, touching, {.weld = Weld::all}).embedded());
  EXPECT_FALSE(certify(welded, touching, {.weld = Weld::none}).embedded());
}

TEST(Certify, opened_seams) {
  // Two triangles with an edge of their own each, at the same place.
  Surface surface;
  surface.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  surface.corners = {0, 1, 2, 3, 5, 4};
  EXPECT_TRUE(certify(surface, surface.positions).embedded());
  std::vector<double> opened = surface.positions;
  opened[3 * 3] += 1e-9;
  const Certificate certificate = certify(surface, opened);
  EXPECT_FALSE(certificate.seams_closed);
  EXPECT_FALSE(certificate.embedded());
  // Moved together it stays closed.
  opened[3 * 1] += 1e-9;
  EXPECT_TRUE(certify(surface, opened).seams_closed);
  // Within a tolerance the two differ already in the input; that is no opening.
  EXPECT_TRUE(certify(surface, surface.positions, {.weld_tolerance = 1e-3}).seams_closed);
}

TEST(Certify, lost_areas) {
  Surface surface = shapes::bumpy_sheet(2, 0).surface();
  surface.corners.insert(surface.corners.end(), {0, 0, 1});  // this one never had any
  EXPECT_EQ(certify(surface, surface.positions).new_zero_area_faces, 0u);
  std::vector<double> collapsed = surface.positions;
  // Vertex 0 onto the edge from 1 to 4.
  for (int k = 0; k < 3; ++k) collapsed[k] = 0.5 * (surface.positions[3 * 1 + k] + surface.positions[3 * 4 + k]);
  const Certificate certificate = certify(surface, collapsed);
  EXPECT_EQ(certificate.new_zero_area_faces, 1u);
  EXPECT_FALSE(certificate.embedded());
}

TEST(Certify, polygons_are_counted_once_but_cut_as_in_the_input) {
  // A needle through both triangles of a quad.
  Surface surface;
  surface.positions = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.5, 1.5, -1, 1.5, 0.5, -1, 1, 1, 2};
  surface.corners = {0, 1, 2, 3, 4, 5, 6};
  surface.offsets = {0, 4, 7};
  const Certificate certificate = certify(surface, surface.positions);
  EXPECT_EQ(certificate.pairs.total(), 1u);
}

TEST(Certify, senseless_positions_are_refused) {
  const Surface surface = shapes::bumpy_sheet(2, 0).surface();
  std::vector<double> positions = surface.positions;
  positions.pop_back();
  EXPECT_THROW(certify(surface, positions), std::invalid_argument);
  positions.push_back(std::nan(""));
  EXPECT_THROW(certify(surface, positions), std::invalid_argument);
}

TEST(Certify, same_answer_at_any_thread_count) {
  const Surface surface = shapes::crossing_bumps(30, 0.4).surface();
  const Certificate one = certify(surface, surface.positions, {.threads = 1});
  for (const int threads : {2, 4}) {
    const Certificate other = certify(surface, surface.positions, {.threads = threads});
    EXPECT_EQ(other.pairs.by_class, one.pairs.by_class);
    EXPECT_EQ(other.pairs_float32->by_class, one.pairs_float32->by_class);
  }
}

TEST(Certifier, does_search_by_search_what_certify_does) {
  const Surface crossing = shapes::crossing_bumps(6, 0.4).surface();
  std::vector<double> apart = crossing.positions;
  for (std::size_t k = crossing.positions.size() / 2 + 2; k < apart.size(); k += 3) apart[k] += 5;
  Certifier certifier(crossing);
  for (const std::vector<double>& positions : {apart, crossing.positions, apart}) {
    const Certificate expected = certify(crossing, positions);
    EXPECT_EQ(certifier.certify(positions).pairs.by_class, expected.pairs.by_class);
    EXPECT_EQ(certifier.pairs_in_float32(positions).by_class, expected.pairs_float32->by_class);
    EXPECT_EQ(certifier.find_intersections(positions).size(), expected.pairs.total());
  }
  EXPECT_EQ(certifier.find_intersections(crossing.positions), find_intersections(crossing));
  EXPECT_TRUE(certifier.find_intersections(apart).empty());
}

TEST(Certifier, refuses_positions_that_make_no_sense) {
  const Surface sheet = shapes::bumpy_sheet(4, 0.5).surface();
  Certifier certifier(sheet);
  std::vector<double> positions = sheet.positions;
  positions[3] = std::nan("");
  EXPECT_THROW(certifier.find_intersections(positions), std::invalid_argument);
  EXPECT_THROW(certifier.pairs_in_float32(positions), std::invalid_argument);
  positions.pop_back();
  EXPECT_THROW(certifier.certify(positions), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
