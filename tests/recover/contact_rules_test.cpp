#include "recover/contact_rules.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

/// A fixed face in the plane z = 0 and a small free one above it, the nearest corner (vertex 0) at `height`; at rest at
/// `rest_height`.
Patch face_over_face(double height, double rest_height) {
  Patch patch;
  patch.free_count = 3;
  patch.active_count = 1;
  patch.triangles = {{0, 1, 2}, {3, 4, 5}};
  patch.x.resize(3, 6);
  patch.x << 0, 1, 0, -9, 9, 0,  //
      0, 0, 1, -9, -9, 9,        //
      height, 5, 5, 0, 0, 0;
  patch.rest = patch.x;
  patch.rest(2, 0) = rest_height;
  patch.edge_length = 1;
  return patch;
}

/// Every vertex may go so far from where it is.
MotionBounds anywhere_within(std::vector<double> around) {
  MotionBounds bounds;
  bounds.reset(static_cast<Index>(around.size()));
  bounds.around = std::move(around);
  return bounds;
}

ContactRule rule_of_vertex_0(const Patch& patch, const std::vector<IntersectingPair>& pairs) {
  ContactRuleOptions options;
  options.min_gap = 0.01;
  options.roundoff = 1e-13;
  ContactRules rules(patch, pairs, options);
  const std::vector<std::uint8_t> moves = {1, 1, 1, 0, 0, 0};
  BlockList<ContactRule> found;
  rules.gather(patch.x, 1, anywhere_within(std::vector<double>(6, 1)), moves, found);
  for (const ContactRule& rule : found) {
    if (rule.stencil.stencil == Stencil{StencilKind::vertex_face, {0, 3, 4, 5}}) return rule;
  }
  ADD_FAILURE() << "the vertex over the face has no rule";
  return {};
}

TEST(ContactRules, a_gap_keeps_the_wanted_one_and_no_more_than_half_of_itself) {
  const ContactRule wide = rule_of_vertex_0(face_over_face(0.03, 0.5), {});
  EXPECT_FALSE(wide.closed);
  EXPECT_EQ(wide.stencil.separation, 0.01);
  const ContactRule enough = rule_of_vertex_0(face_over_face(0.015, 0.5), {});
  EXPECT_FALSE(enough.closed);
  EXPECT_DOUBLE_EQ(enough.stencil.separation, 0.0075);
  const ContactRule closed = rule_of_vertex_0(face_over_face(0.004, 0.5), {});
  EXPECT_TRUE(closed.closed);
  EXPECT_DOUBLE_EQ(closed.stencil.separation, 0.002);
}

TEST(ContactRules, what_passes_through_each_other_has_none) {
  Patch patch = face_over_face(0.004, 0.5);
  patch.part_of = {0, 1};
  for (const bool pass : {true, false}) {
    const PassingParts parts(2, std::vector<std::array<Index, 2>>{{0, pass ? 1 : 0}});
    patch.parts = &parts;
    ContactRuleOptions options;
    options.min_gap = 0.01;
    options.roundoff = 1e-13;
    ContactRules rules(patch, {}, options);
    BlockList<ContactRule> found;
    rules.gather(patch.x, 1, anywhere_within(std::vector<double>(6, 1)), std::vector<std::uint8_t>{1, 1, 1, 0, 0, 0},
                 found);
    EXPECT_EQ(std::all_of(found.begin(), found.end(), [](const ContactRule& rule) { return rule.own_altitude; }), pass);
  }
}

TEST(ContactRules, the_barrier_leaves_a_rest_shape_without_conflict_alone) {
  const ContactRule thin = rule_of_vertex_0(face_over_face(0.2, 0.2), {});
  EXPECT_DOUBLE_EQ(thin.reach, 0.1);
  const ContactRule thinner = rule_of_vertex_0(face_over_face(0.2, 0.001), {});
  EXPECT_DOUBLE_EQ(thinner.reach, 0.03);  // the wanted gap comes first
  const ContactRule crossing = rule_of_vertex_0(face_over_face(0.2, 0.001), {{0, 1}});
  EXPECT_TRUE(std::isinf(crossing.reach));
}

/// Two faces over the edge (0, 1); vertex 3 folded back over the first, `height` above it at rest.
Patch folded_pair(double height) {
  Patch patch;
  patch.free_count = 4;
  patch.active_count = 2;
  patch.triangles = {{0, 1, 2}, {1, 0, 3}};
  patch.x.resize(3, 4);
  patch.x << 0, 1, 0.5, 0.5,  //
      0, 0, 1, 0.5,           //
      0, 0, 0, 0.2;
  patch.rest = patch.x;
  patch.rest(2, 3) = height;
  patch.edge_length = 1;
  return patch;
}

BlockList<ContactRule> rules_of(const Patch& patch, const std::vector<IntersectingPair>& pairs) {
  ContactRuleOptions options;
  options.min_gap = 0.01;
  options.roundoff = 1e-13;
  ContactRules rules(patch, pairs, options);
  BlockList<ContactRule> found;
  rules.gather(patch.x, 1, anywhere_within(std::vector<double>(4, 1)), std::vector<std::uint8_t>(4, 1), found);
  found.erase_if([](const ContactRule& rule) { return rule.stencil.stencil.kind != StencilKind::vertex_face; });
  return found;
}

TEST(ContactRules, neighbours_keep_a_share_of_their_rest_distance) {
  const Patch patch = folded_pair(0.004);
  const BlockList<ContactRule> rules = rules_of(patch, {});
  ASSERT_EQ(rules.size(), 2u);
  for (const ContactRule& rule : rules) {
    EXPECT_LE(rule.stencil.separation, 0.01);
    EXPECT_DOUBLE_EQ(rule.reach, 0.5 * std::sqrt(squared_distance(rule.stencil.stencil, patch.rest)));
    if (rule.stencil.stencil.v[0] == 3) {
      EXPECT_NEAR(rule.stencil.separation, 0.001, 1e-12);
    }
  }
}

TEST(ContactRules, near_along_a_sheet_are_neighbours) {
  // Two strips of a flat sheet with one between: 0.1 apart, and along the edges.
  Patch patch;
  patch.free_count = 8;
  patch.active_count = 6;
  patch.x.resize(3, 8);
  for (Index v = 0; v < 8; ++v) patch.x.col(v) = Vec3(0.1 * (v / 2), v % 2, 0);
  for (Index k = 0; k < 3; ++k) {
    patch.triangles.push_back({2 * k, 2 * k + 2, 2 * k + 1});
    patch.triangles.push_back({2 * k + 1, 2 * k + 2, 2 * k + 3});
  }
  patch.rest = patch.x;
  patch.edge_length = 1;
  const auto first_and_last = [&](double min_gap) {
    ContactRuleOptions options;
    options.min_gap = min_gap;
    ContactRules rules(patch, {}, options);
    BlockList<ContactRule> found;
    rules.gather(patch.x, 1, anywhere_within(std::vector<double>(8, 0.5)), std::vector<std::uint8_t>(8, 1), found);
    const Stencil wanted = {StencilKind::edge_edge, {0, 1, 6, 7}};
    const auto rule = std::find_if(found.begin(), found.end(), [&](const ContactRule& r) {
      return r.stencil.stencil.kind == wanted.kind && r.stencil.stencil.v == wanted.v;
    });
    return rule == found.end() ? ContactRule{} : *rule;
  };
  EXPECT_FALSE(first_and_last(0.1).neighbours);  // 0.3 along the edges
  EXPECT_EQ(first_and_last(0.1).stencil.separation, 0.1);
  EXPECT_TRUE(first_and_last(0.2).neighbours);
  EXPECT_NEAR(first_and_last(0.2).stencil.separation, 0.25 * 0.3, 1e-12);
}

TEST(ContactRules, flat_folds_want_a_gap_only_where_they_are_in_conflict) {
  const BlockList<ContactRule> in_conflict = rules_of(folded_pair(0), {{0, 1}});
  EXPECT_FALSE(in_conflict.empty());
  for (const ContactRule& rule : in_conflict) EXPECT_GT(rule.stencil.separation, 0.009);
  // Without an intersection at rest (zero-area faces) a distance of zero is legitimate: no rule.
  for (const ContactRule& rule : rules_of(folded_pair(0), {})) EXPECT_NE(rule.stencil.stencil.v[0], 3);
}

TEST(ContactRules, list_what_may_come_near_by_moving_as_far_as_allowed) {
  // Vertex 0 is 0.2 over the face, as at rest: its reach is 0.1, so that with the face it must approach by 0.1.
  const Patch patch = face_over_face(0.2, 0.2);
  const std::vector<std::uint8_t> moves = {1, 1, 1, 0, 0, 0};
  const auto is_listed = [&](double room) {
    ContactRuleOptions options;
    options.min_gap = 0.01;
    ContactRules rules(patch, {}, options);
    BlockList<ContactRule> found;
    rules.gather(patch.x, 1, anywhere_within({room, 0, 0, 0, 0, 0}), moves, found);
    return std::any_of(found.begin(), found.end(), [](const ContactRule& rule) {
      return rule.stencil.stencil == Stencil{StencilKind::vertex_face, {0, 3, 4, 5}};
    });
  };
  EXPECT_FALSE(is_listed(0));
  EXPECT_FALSE(is_listed(0.09));
  EXPECT_TRUE(is_listed(0.11));
}

TEST(ContactRules, around_a_vertex_judge_closed_where_it_is_now) {
  // Vertex 0 started 0.2 over the face, whose bounds begin 0.195 below where it is now.
  Patch patch = face_over_face(0.2, 0.5);
  ContactRuleOptions options;
  options.min_gap = 0.01;
  options.roundoff = 1e-13;
  ContactRules rules(patch, {}, options);
  const std::vector<std::uint8_t> moves(6, 1);
  MotionBounds bounds = anywhere_within(std::vector<double>(6, 0.2));
  BlockList<ContactRule> found;
  const Positions from = patch.x;
  rules.gather(from, 0.1, bounds, moves, found);
  const std::size_t count = found.size();
  for (Index v : {3, 4, 5}) patch.x(2, v) += 0.195;
  rules.gather_around(std::vector<Index>{0}, from, patch.x, bounds, found);
  EXPECT_EQ(found.size(), count);
  const auto over_face = std::find_if(found.begin(), found.end(), [](const ContactRule& rule) {
    return rule.stencil.stencil == Stencil{StencilKind::vertex_face, {0, 3, 4, 5}};
  });
  ASSERT_NE(over_face, found.end());
  EXPECT_NEAR(over_face->distance, 0.2, 1e-12);
  EXPECT_TRUE(over_face->closed);
  EXPECT_NEAR(over_face->stencil.separation, 0.0025, 1e-12);
  // Where nothing may come any more there is no rule either.
  for (Index v = 0; v < 6; ++v) bounds.around[v] = 0;
  rules.gather_around(std::vector<Index>{0, 1, 2, 3, 4, 5}, from, from, bounds, found);
  EXPECT_TRUE(found.empty());
}

/// Rules per vertex of a fine tube that is shrunk to a point but for a hundredth, beside edges of length h.
double rules_a_vertex(Index cells, double h) {
  Patch patch = shapes::patch_of(shapes::tube(cells, cells, cells / 6.0));
  patch.x *= 0.01 / cells;
  ContactRuleOptions options;
  options.h = h;
  ContactRules rules(patch, {}, options);
  BlockList<ContactRule> found;
  const std::size_t count = static_cast<std::size_t>(patch.x.cols());
  rules.gather(patch.x, 0.1, anywhere_within(std::vector<double>(count, 0)), std::vector<std::uint8_t>(count, 1),
               found);
  return static_cast<double>(found.size()) / static_cast<double>(count);
}

TEST(ContactRules, of_what_is_shrunk_are_as_many_a_vertex_however_fine_it_is) {
  EXPECT_LT(rules_a_vertex(24, 1), 1.5 * rules_a_vertex(12, 1));
  EXPECT_GT(rules_a_vertex(24, 0), 3 * rules_a_vertex(12, 0)) << "without h, all pairs are near";
}

TEST(ContactRules, faces_guard_their_own_altitudes) {
  Patch patch = face_over_face(3, 3);
  patch.x.col(0) = 0.5 * (patch.x.col(1) + patch.x.col(2)) + Vec3(0, 0, 0.02);  // squeezed
  ContactRules rules(patch, {}, {});
  const std::vector<std::uint8_t> moves = {1, 1, 1, 0, 0, 0};
  BlockList<ContactRule> found;
  rules.gather(patch.x, 0.01, anywhere_within(std::vector<double>(6, 0)), moves, found);
  int altitudes = 0;
  for (const ContactRule& rule : found) altitudes += rule.own_altitude;
  EXPECT_GE(altitudes, 1);
}

}  // namespace
}  // namespace unsnarl
