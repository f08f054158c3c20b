#include "scene/allowed_parts.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

TEST(AllowedParts, faces_pass_as_the_pairs_of_their_parts_say) {
  const Surface surface = shapes::bumpy_sheet(2, 0).surface();  // eight faces
  const AllowedPairs allowed = {{7, 7, -1, 900, 3, -1, 7, 3}, {{900, 7}, {3, 3}}};
  const AllowedParts parts = allowed_parts(surface, allowed);
  ASSERT_TRUE(parts.any());
  const auto pass = [&](Index f, Index g) { return parts.passing.pass(parts.of_face[f], parts.of_face[g]); };
  for (Index f = 0; f < 8; ++f)
    for (Index g = 0; g < 8; ++g) {
      const std::int32_t p = allowed.part_of_face[f], q = allowed.part_of_face[g];
      EXPECT_EQ(pass(f, g), (p == 7 && q == 900) || (p == 900 && q == 7) || (p == 3 && q == 3)) << f << " " << g;
    }
  EXPECT_EQ(parts.of_triangles(std::vector<Index>{4, 4, 0}),
            (std::vector<Index>{parts.of_face[4], parts.of_face[4], parts.of_face[0]}));
}

TEST(AllowedParts, without_pairs_there_are_none) {
  const Surface surface = shapes::bumpy_sheet(2, 0).surface();
  EXPECT_FALSE(allowed_parts(surface, {}).any());
  EXPECT_FALSE(allowed_parts(surface, {std::vector<std::int32_t>(8, 0), {}}).any());
  EXPECT_TRUE(allowed_parts(surface, {}).of_triangles(std::vector<Index>{0, 1}).empty());
}

TEST(AllowedParts, what_makes_no_sense_is_refused) {
  const Surface surface = shapes::bumpy_sheet(2, 0).surface();
  EXPECT_THROW(allowed_parts(surface, {{0, 0}, {{0, 0}}}), std::invalid_argument);
  EXPECT_THROW(allowed_parts(surface, {{}, {{0, 0}}}), std::invalid_argument);
  EXPECT_THROW(allowed_parts(surface, {std::vector<std::int32_t>(8, 0), {{0, -1}}}), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
