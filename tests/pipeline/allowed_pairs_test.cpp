// Repairs of surfaces whose parts may pass through each other, judged by a detector that knows nothing of parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <stdexcept>

#include "pipeline/judged.h"
#include "rigid/boxes.h"
#include "scene/shapes.h"
#include "unsnarl/certify.h"
#include "unsnarl/check.h"
#include "unsnarl/nesting.h"
#include "unsnarl/repair.h"
#include "unsnarl/sequence.h"

namespace unsnarl {
namespace {

using shapes::Shape;

/// Shapes in one surface; each is a part.
struct Assembly {
  Shape shape;
  std::vector<std::int32_t> part_of_face;
  std::vector<std::size_t> first_vertex = {0};

  Assembly& add(const Shape& other, const Vec3& offset) {
    const auto part = static_cast<std::int32_t>(first_vertex.size()) - 1;
    shape.add(other, offset);
    part_of_face.resize(shape.triangles.size(), part);
    first_vertex.push_back(shape.points.size());
    return *this;
  }
  Surface surface() const { return shape.surface(); }
  AllowedPairs allowing(std::vector<std::array<std::int32_t, 2>> pairs) const {
    return {part_of_face, std::move(pairs)};
  }
  /// The coordinates of one part.
  std::vector<double> part(std::size_t i, const std::vector<double>& positions) const {
    return {positions.begin() + 3 * static_cast<std::ptrdiff_t>(first_vertex[i]),
            positions.begin() + 3 * static_cast<std::ptrdiff_t>(first_vertex[i + 1])};
  }
};

struct Judged {
  std::size_t forbidden = 0, allowed = 0;
};

/// Pairs of faces at these positions, by CGAL and by the rules.
Judged judged_by(const AllowedPairs& allowed, const Surface& surface, const std::vector<double>& positions) {
  Judged count;
  for (const IntersectingPair& pair : judged(surface, positions)) {
    const std::int32_t p = allowed.part_of_face[pair.a], q = allowed.part_of_face[pair.b];
    const bool may = std::any_of(allowed.parts.begin(), allowed.parts.end(), [&](const auto& parts) {
      return (parts[0] == p && parts[1] == q) || (parts[0] == q && parts[1] == p);
    });
    ++(may ? count.allowed : count.forbidden);
  }
  return count;
}

/// What must hold of any result.
void expect_counted_apart(const AllowedPairs& allowed, const Surface& surface, const RepairResult& result) {
  const Judged before = judged_by(allowed, surface, surface.positions),
               after = judged_by(allowed, surface, result.positions);
  const RepairReport& report = result.report;
  EXPECT_EQ(report.before.total(), before.forbidden);
  EXPECT_EQ(report.after.total(), after.forbidden);
  EXPECT_EQ(report.allowed_before.total(), before.allowed);
  EXPECT_EQ(report.allowed_after.total(), after.allowed);
  EXPECT_LE(after.forbidden, before.forbidden);
  EXPECT_EQ(result.status == Status::embedded, after.forbidden + after.allowed == 0) << to_string(result.status);
  if (result.status == Status::allowed) {
    EXPECT_EQ(after.forbidden, 0u);
    EXPECT_GT(after.allowed, 0u);
  }
}

/// A large box, one that reaches into it, and one that reaches into it elsewhere.
Assembly three_boxes() {
  Assembly all;
  all.add(shapes::box({2, 2, 2}, 4), {0, 0, 0});
  all.add(shapes::box({1, 1, 1}, 3), {0.1, 0.2, 1.13});
  return all.add(shapes::box({1, 1, 1}, 3), {1.37, 0.17, -0.31});
}

RepairOptions allowing(AllowedPairs allowed) {
  RepairOptions options;
  options.find.allowed = std::move(allowed);
  return options;
}

TEST(AllowedPairs, alone_they_leave_the_input_bit_for_bit) {
  const Assembly all = three_boxes();
  const Surface surface = all.surface();
  const RepairOptions options = allowing(all.allowing({{0, 1}, {2, 0}}));
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::allowed);
  EXPECT_EQ(result.positions, surface.positions);
  expect_counted_apart(options.find.allowed, surface, result);
  EXPECT_TRUE(result.report.left.empty());
}

TEST(AllowedPairs, others_are_resolved_among_them) {
  const Assembly all = three_boxes();
  const Surface surface = all.surface();
  const RepairOptions options = allowing(all.allowing({{0, 1}}));
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::allowed);
  expect_counted_apart(options.find.allowed, surface, result);
  EXPECT_EQ(all.part(1, result.positions), all.part(1, surface.positions)) << "what may pass does not move by itself";
}

// What passes through all others is no obstacle: the others end where they end without it.
TEST(AllowedPairs, hold_nothing_up) {
  for (const double min_gap_rel : {0.0, 0.02}) {
    Assembly two, three;
    for (Assembly* all : {&two, &three}) {
      all->add(shapes::box({2, 2, 2}, 4), {0, 0, 0});
      all->add(shapes::box({1, 1, 1}, 3), {1.37, 0.17, -0.31});
    }
    three.add(shapes::box({0.7, 0.7, 0.7}, 3), {0.95, 0.21, -0.13});  // where they meet
    RepairOptions alone, together = allowing(three.allowing({{0, 2}, {1, 2}}));
    alone.min_gap_rel = together.min_gap_rel = min_gap_rel;
    const RepairResult expected = repair(two.surface(), alone), result = repair(three.surface(), together);
    ASSERT_EQ(expected.status, Status::embedded);
    EXPECT_EQ(result.status, Status::allowed);
    for (const std::size_t part : {0, 1})
      EXPECT_EQ(three.part(part, result.positions), two.part(part, expected.positions)) << part << " " << min_gap_rel;
    EXPECT_EQ(three.part(2, result.positions), three.part(2, three.surface().positions));
    expect_counted_apart(together.find.allowed, three.surface(), result);
  }
}

TEST(AllowedPairs, a_part_may_be_moved_into_what_it_may_pass) {
  Assembly all;
  all.add(shapes::box({1, 1, 1}, 3), {0, 0, 0});
  all.add(shapes::box({3, 3, 3}, 3), {1.9, 0.13, 0.07});    // 0.1 deep, must not move
  all.add(shapes::box({1, 1, 1}, 3), {-1.02, 0.11, 0.05});  // on the other side, hardly apart
  const Surface surface = all.surface();
  RepairOptions options = allowing(all.allowing({{0, 2}}));
  options.fixed.assign(surface.view().vertex_count(), 0);
  std::fill(options.fixed.begin() + static_cast<std::ptrdiff_t>(all.first_vertex[1]), options.fixed.end(), 1);
  const RepairResult result = repair(surface, options);
  expect_counted_apart(options.find.allowed, surface, result);
  EXPECT_EQ(result.report.after.total(), 0u);
  EXPECT_TRUE(is_resolved(result.status)) << to_string(result.status);
}

TEST(AllowedPairs, a_part_may_pass_through_itself) {
  Assembly all;
  all.add(shapes::crossing_bumps(10, 0.6), {0, 0, 0});  // of two sheets
  all.add(shapes::bumpy_sheet(6, 0), {0, 0, 1.05});     // between them, so that it crosses both
  const Surface surface = all.surface();
  for (const bool both : {true, false}) {
    const RepairOptions options = allowing(both ? all.allowing({{0, 0}, {0, 1}}) : all.allowing({{0, 0}}));
    const RepairResult result = repair(surface, options);
    expect_counted_apart(options.find.allowed, surface, result);
    EXPECT_TRUE(is_resolved(result.status)) << to_string(result.status);
    EXPECT_EQ(result.positions == surface.positions, both);
  }
}

// Parts of one component have vertices in common: what the faces of each may do is told apart all the same.
TEST(AllowedPairs, parts_of_one_component_are_told_by_their_faces) {
  Assembly all;
  all.add(shapes::bumpy_sheet(12, 0), {0, 0, 0});
  // A blade through the sheet, across five of its rows.
  all.add(shapes::grid(2, 8, false, [](double i, double j) { return Vec3(0.13, 0.61 * j - 2.4, i - 1.03); }),
          {0, 0, 0});
  const Surface surface = all.surface();
  AllowedPairs allowed = all.allowing({{1, 2}});
  const auto make_belt = [&](double half_width) {
    for (std::size_t f = 0; f < 288; ++f) {
      Vec3 middle = Vec3::Zero();
      for (const Index v : all.shape.triangles[f]) middle += all.shape.points[v] / 3;
      allowed.part_of_face[f] = std::abs(middle[1]) < half_width ? 2 : 0;
    }
  };
  make_belt(4);  // all that the blade meets
  const RepairResult kept = repair(surface, allowing(allowed));
  EXPECT_EQ(kept.status, Status::allowed);
  EXPECT_EQ(kept.positions, surface.positions);
  make_belt(0.5);  // one row, all of whose vertices are of its neighbours too
  const RepairResult result = repair(surface, allowing(allowed));
  expect_counted_apart(allowed, surface, result);
  EXPECT_GT(result.report.before.total(), 0u);
  EXPECT_EQ(result.report.after.total(), 0u) << to_string(result.status);
}

TEST(AllowedPairs, rigid_parts_pass_too) {
  const Assembly all = three_boxes();
  const Surface surface = all.surface();
  RepairOptions options = allowing(all.allowing({{0, 1}}));
  for (std::size_t part = 0; part < 3; ++part)
    options.rigid.resize(all.first_vertex[part + 1], static_cast<Index>(part));
  const RepairResult result = repair(surface, options);
  expect_counted_apart(options.find.allowed, surface, result);
  EXPECT_EQ(result.status, Status::allowed);
  EXPECT_EQ(all.part(1, result.positions), all.part(1, surface.positions));
}

TEST(AllowedPairs, components_by_themselves_and_quads_along_either_diagonal) {
  const Assembly all = three_boxes();
  const Surface surface = all.surface();
  RepairOptions each = allowing(all.allowing({{0, 1}}));
  each.each_component = true;
  const RepairResult alone = repair(surface, each);
  EXPECT_EQ(alone.status, Status::obstructed) << "of what --each leaves the first is said";
  expect_counted_apart(each.find.allowed, surface, alone);
  each.find.allowed = all.allowing({{0, 1}, {0, 2}});
  EXPECT_EQ(repair(surface, each).status, Status::allowed);

  // Two sheets of quads that cross, and a third that may pass through the first.
  Surface quads;
  AllowedPairs allowed;
  for (const double height : {0.0, 0.9, 1.4}) {
    const auto first = static_cast<Index>(quads.positions.size() / 3);
    for (Index i = 0; i < 9; ++i)
      for (Index j = 0; j < 9; ++j) {
        const double r2 = (i - 4) * (i - 4) + (j - 4) * (j - 4), bump = std::exp(-r2 / 4) * (height == 0 ? 1.2 : -0.2);
        quads.positions.insert(quads.positions.end(), {i + 0.3 * height, j + 0.2 * height, height + bump});
      }
    for (Index i = 0; i < 8; ++i)
      for (Index j = 0; j < 8; ++j) {
        const Index v = first + 9 * i + j;
        if (quads.offsets.empty()) quads.offsets.push_back(0);
        quads.corners.insert(quads.corners.end(), {v, v + 9, v + 10, v + 1});
        quads.offsets.push_back(static_cast<Index>(quads.corners.size()));
        allowed.part_of_face.push_back(height == 0 ? 0 : height < 1 ? 1 : 2);
      }
  }
  allowed.parts = {{0, 2}, {1, 1}};
  RepairOptions options = allowing(allowed);
  options.find.both_diagonals = true;
  const RepairResult result = repair(quads, options);
  EXPECT_GT(result.report.before.total(), 0u);
  EXPECT_TRUE(is_resolved(result.status)) << to_string(result.status);
  const Certificate certificate = certify(quads, result.positions, options.find);
  EXPECT_TRUE(certificate.resolved());
  EXPECT_EQ(certificate.allowed.total(), result.report.allowed_after.total());
  // Without rules the same positions show the same pairs.
  FindOptions all_pairs = options.find;
  all_pairs.allowed = {};
  const PairCounts every = count_by_class(Certifier(quads, all_pairs).find_intersections(result.positions));
  EXPECT_EQ(every.total(), certificate.allowed.total());
}

TEST(AllowedPairs, random_assemblies_are_counted_apart_and_never_worse) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> place(-0.7, 0.7);
  for (int seed = 0; seed < 6; ++seed) {
    Assembly all;
    for (int part = 0; part < 5; ++part)
      all.add(shapes::turned(shapes::box({1, 0.8, 0.6}, 2), place(random)),
              {place(random), place(random), place(random)});
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (std::int32_t p = 0; p < 5; ++p)
      for (std::int32_t q = p; q < 5; ++q)
        if (random() % 2) pairs.push_back({p, q});
    const Surface surface = all.surface();
    const RepairOptions options = allowing(all.allowing(pairs));
    expect_counted_apart(options.find.allowed, surface, repair(surface, options));
  }
}

TEST(AllowedPairs, checks_and_certificates_count_them_apart) {
  const Assembly all = three_boxes();
  const Surface surface = all.surface();
  FindOptions find, none;
  find.allowed = all.allowing({{1, 0}});
  const Judged judged = judged_by(find.allowed, surface, surface.positions);
  ASSERT_GT(judged.allowed, 0u);
  const std::vector<IntersectingPair> forbidden = find_intersections(surface, find);
  EXPECT_EQ(forbidden.size(), judged.forbidden);
  const CheckReport found = check(surface, find);
  EXPECT_EQ(found.pairs, forbidden);
  EXPECT_EQ(found.allowed.total(), judged.allowed);
  Certifier certifier(surface, find);
  const Certificate certificate = certifier.certify(surface.positions);
  EXPECT_EQ(certificate.pairs.total(), judged.forbidden);
  EXPECT_EQ(certificate.allowed.total(), judged.allowed);
  std::vector<IntersectingPair> both = certifier.find_allowed_pairs(surface.positions);
  EXPECT_EQ(both, found.allowed_pairs);
  both.insert(both.end(), forbidden.begin(), forbidden.end());
  std::sort(both.begin(), both.end());
  EXPECT_EQ(both, find_intersections(surface, none));
}

TEST(AllowedPairs, frames_of_a_sequence) {
  const Assembly all = three_boxes();
  const Surface surface = all.surface();
  SequenceSource source;
  source.corners = surface.corners;
  source.frames = 3;
  source.positions = [&](std::size_t) { return surface.positions; };
  SequenceOptions options;
  options.repair.find.allowed = all.allowing({{0, 1}});
  std::vector<std::vector<double>> results;
  const auto reports =
      repair_sequence(source, options, [&](FrameResult&& frame) { results.push_back(std::move(frame.positions)); });
  ASSERT_EQ(results.size(), 3u);
  for (std::size_t t = 0; t < 3; ++t) {
    EXPECT_EQ(reports[t].status, Status::allowed);
    const Judged after = judged_by(options.repair.find.allowed, surface, results[t]);
    EXPECT_EQ(after.forbidden, 0u);
    EXPECT_EQ(reports[t].allowed_after.total(), after.allowed);
  }
}

TEST(AllowedPairs, what_knows_nothing_of_them_is_refused) {
  const Assembly all = three_boxes();
  const Surface surface = all.surface();
  RepairOptions options = allowing(all.allowing({{0, 1}}));
  options.paper.emplace();
  EXPECT_THROW(repair(surface, options), std::invalid_argument);
  options.paper.reset();
  Nesting nesting;
  for (std::size_t part = 0; part < 3; ++part)
    nesting.surface_of_vertex.resize(all.first_vertex[part + 1], static_cast<std::int32_t>(part));
  nesting.names = {"a", "b", "c"};
  nesting.chains = {{1, 0}};
  EXPECT_THROW(repair_nested(surface, nesting, options), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
