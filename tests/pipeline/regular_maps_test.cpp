#include <gtest/gtest.h>

#include "unsnarl/intersections.h"
#include "unsnarl/repair.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

class RegularMaps : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(OfGenus3, RegularMaps, testing::Values("klein_map", "dyck_map"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(RegularMaps, are_embedded_without_noise) {
  EXPECT_TRUE(find_intersections(make_sample(GetParam(), 0, {{"noise", 0}})).empty());
}

TEST_P(RegularMaps, are_recovered_when_shaken) {
  for (const double seed : {1, 2, 3}) {
    const Surface shaken = make_sample(GetParam(), 0, {{"seed", seed}});
    EXPECT_FALSE(find_intersections(shaken).empty()) << seed;
    Surface result = shaken;
    const RepairResult repaired = repair(shaken);
    EXPECT_EQ(repaired.status, Status::embedded) << seed;
    result.positions = repaired.positions;
    EXPECT_TRUE(find_intersections(result).empty()) << seed;
  }
}

TEST_P(RegularMaps, are_embedded_from_some_random_positions) {
  int embedded = 0;
  for (double seed = 1; seed <= 12; ++seed) {
    const Surface random = make_sample(GetParam(), 0, {{"seed", seed}, {"random", 1}});
    EXPECT_GT(find_intersections(random).size(), 50U);
    embedded += repair(random).status == Status::embedded ? 1 : 0;
  }
  EXPECT_GE(embedded, 1);
}

}  // namespace
}  // namespace unsnarl
