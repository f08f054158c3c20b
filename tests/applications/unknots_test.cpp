#include <gtest/gtest.h>

#include "applications/seifert/link_diagram.h"
#include "unsnarl/link.h"

namespace unsnarl {
namespace {

TEST(Unknots, have_the_alexander_polynomial_and_the_crossings_of_theirs) {
  EXPECT_FALSE(unknot_of_table("3_1"));
  for (const UnknotEntry& entry : unknot_table()) {
    SCOPED_TRACE(entry.name);
    const Link link = knot_of_table(entry.name);
    EXPECT_NO_THROW(check_link(link));
    ASSERT_EQ(link.components.size(), 1U);
    const auto diagram = diagram_of(link, Eigen::Matrix3d::Identity());
    ASSERT_TRUE(diagram);
    EXPECT_EQ(alexander_polynomial(*diagram), Polynomial{1});
  }
  const auto crossings = [](std::string_view name) {
    return diagram_of(knot_of_table(name), Eigen::Matrix3d::Identity())->crossings.size();
  };
  EXPECT_EQ(crossings("circle"), 0U);
  EXPECT_EQ(crossings("kinks_4"), 4U);
  EXPECT_EQ(crossings("culprit"), 10U);
  EXPECT_EQ(crossings("goeritz"), 11U);
  EXPECT_EQ(crossings("thistlethwaite"), 15U);
  EXPECT_EQ(crossings("ochiai"), 16U);
  EXPECT_EQ(crossings("ochiai_2"), 45U);
}

}  // namespace
}  // namespace unsnarl
