// Why a pair may stay: each reason where it alone holds, and their order where several do.
#include "scene/pair_policy.h"

#include <gtest/gtest.h>

#include <optional>

#include "scene/diagnose.h"
#include "scene/shapes.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

using shapes::Shape;

/// The reason of a pair of faces that intersect in a surface.
class PairPolicyTest : public ::testing::Test {
 protected:
  void take(const Surface& surface) {
    surface_ = surface;
    prepared_ = prepare(surface_, {});
    components_ = diagnose_topology(surface_, prepared_).components;
    IntersectionFinder finder(prepared_.triangles());
    pairs_ = finder.find(prepared_.rest);
    ASSERT_FALSE(pairs_.empty());
  }
  PairPolicy policy(Goal goal = Goal::all, bool each_component = false) const {
    return PairPolicy(components_, goal, each_component);
  }
  std::optional<LeftReason> reason(const PairPolicy& policy, const IntersectingPair& pair) const {
    return policy.reason_to_leave(prepared_.triangles()[pair.a], prepared_.triangles()[pair.b], pair.kind);
  }
  std::optional<LeftReason> reason(const PairPolicy& policy) const { return reason(policy, pairs_.front()); }
  std::vector<std::uint8_t> flags(std::uint8_t flag) const {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(prepared_.weld_map.count), flag);
  }
  RigidParts one_part(Index part) const {
    return {std::vector<Index>(static_cast<std::size_t>(prepared_.weld_map.count), part), 1, {"gear"}};
  }

  Surface surface_;
  PreparedSurface prepared_;
  Components components_;
  std::vector<IntersectingPair> pairs_;
};

TEST_F(PairPolicyTest, crossing_squares_have_to_be_parted) {
  take(shapes::crossed_squares().surface());
  EXPECT_EQ(reason(policy()), std::nullopt);
  EXPECT_EQ(reason(policy(Goal::disjoint)), std::nullopt);
}

TEST_F(PairPolicyTest, between_components_where_each_is_repaired_as_if_alone) {
  take(shapes::crossed_squares().surface());
  EXPECT_EQ(reason(policy(Goal::all, true)), LeftReason::between_components);
}

TEST_F(PairPolicyTest, what_is_held_of_both_meets) {
  take(shapes::crossed_squares().surface());
  PairPolicy all_fixed = policy();
  all_fixed.hold(flags(1), prepared_.rest);
  EXPECT_EQ(reason(all_fixed), LeftReason::fixed_faces);
  EXPECT_TRUE(is_obstruction(LeftReason::fixed_faces));

  PairPolicy one_fixed = policy();
  std::vector<std::uint8_t> fixed = flags(0);
  for (const Index v : prepared_.triangles()[pairs_.front().a]) fixed[v] = 1;
  one_fixed.hold(fixed, prepared_.rest);
  EXPECT_EQ(reason(one_fixed), std::nullopt);
}

TEST_F(PairPolicyTest, the_shape_of_one_rigid_part_meets_itself) {
  take(shapes::crossed_squares().surface());
  PairPolicy rigid = policy();
  rigid.hold_shape(one_part(0), prepared_.rest);
  EXPECT_EQ(reason(rigid), LeftReason::rigid_faces);
  const IntersectingPair& pair = pairs_.front();
  EXPECT_EQ(rigid.rigid_part_that_meets_itself(prepared_.triangles()[pair.a], prepared_.triangles()[pair.b]), 0);
  EXPECT_EQ(rigid.rigid_parts().name(0), "gear");
  EXPECT_EQ(rigid.rigid_parts().name(1), "1");

  RigidParts two = one_part(0);
  two.count = 2;
  for (const Index v : prepared_.triangles()[pair.a]) two.of_vertex[v] = 1;
  PairPolicy apart = policy();
  apart.hold_shape(two, prepared_.rest);
  EXPECT_EQ(reason(apart), std::nullopt) << "two parts move apart";
}

TEST_F(PairPolicyTest, a_class_that_the_goal_does_not_ask_for) {
  take(Shape{{{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {2, 0, -1}, {2.1, 0, 1}}, {{0, 1, 2}, {0, 3, 4}}}.surface());
  EXPECT_EQ(reason(policy(Goal::disjoint)), LeftReason::goal);
  EXPECT_FALSE(is_obstruction(LeftReason::goal));
}

TEST_F(PairPolicyTest, what_was_given_up_comes_last) {
  take(shapes::crossed_squares().surface());
  PairPolicy given_up = policy();
  given_up.give_up(0);
  EXPECT_TRUE(given_up.is_given_up(0));
  EXPECT_FALSE(given_up.is_given_up(1));
  EXPECT_EQ(reason(given_up), LeftReason::unresolved);
  given_up.hold(flags(1), prepared_.rest);
  EXPECT_EQ(reason(given_up), LeftReason::fixed_faces);
}

TEST_F(PairPolicyTest, what_has_no_embedding_comes_first) {
  take(make_sample("klein_bottle", 16));
  PairPolicy closed = policy(Goal::disjoint, true);
  closed.hold(flags(1), prepared_.rest);
  for (const IntersectingPair& pair : pairs_) {
    EXPECT_EQ(reason(closed, pair), LeftReason::closed_non_orientable);
    EXPECT_EQ(closed.reason_to_leave(Index{0}, Index{0}, pair.kind), LeftReason::closed_non_orientable);
  }
}

TEST_F(PairPolicyTest, duplicates_of_whatever_goal) {
  Surface doubled = shapes::crossed_squares().surface();
  const std::vector<std::int32_t> again(doubled.corners.begin(), doubled.corners.begin() + 3);
  doubled.corners.insert(doubled.corners.end(), again.begin(), again.end());
  take(doubled);
  bool any = false;
  for (const IntersectingPair& pair : pairs_) {
    if (pair.kind != PairClass::duplicate) continue;
    any = true;
    EXPECT_EQ(reason(policy(), pair), LeftReason::duplicate_faces);
    EXPECT_EQ(reason(policy(Goal::disjoint), pair), LeftReason::duplicate_faces);
  }
  EXPECT_TRUE(any);
}

}  // namespace
}  // namespace unsnarl
