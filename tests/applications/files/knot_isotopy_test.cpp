#include "unsnarl/knot_isotopy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unsnarl/document.h"

namespace unsnarl {
namespace {

Link mirrored(Link link) {
  for (std::vector<double>& p : link.components)
    for (std::size_t k = 0; k < p.size(); k += 3) p[k] = -p[k];
  return link;
}

/// Bent by waves that are too long and low to pass the knot through itself, turned, and made three times as large.
Link deformed(Link link) {
  for (std::vector<double>& p : link.components)
    for (std::size_t k = 0; k < p.size(); k += 3) {
      const double x = p[k] + 0.3 * std::sin(p[k + 1]), y = p[k + 1] + 0.3 * std::cos(p[k] + 1);
      p[k] = 3 * y + 5, p[k + 1] = -3 * x, p[k + 2] = 3 * p[k + 2] + 0.4 * x;
    }
  return link;
}

/// Everything that is promised, and what follows from it, found out here anew: a few hundred cuts are simple.
void expect_isotopy(const KnotIsotopy& made, const Link& start, const Link& end) {
  ASSERT_EQ(made.status, Status::embedded) << made.found;
  EXPECT_TRUE(check_knot_isotopy(made, start, end).hold());
  EXPECT_EQ(made.rings.front().points, start.components[0]);
  EXPECT_EQ(made.rings.front().time, 0);
  EXPECT_EQ(made.rings.back().time, 1);
  constexpr int cuts = 100;
  for (int k = 0; k <= cuts; ++k)
    EXPECT_NO_THROW(check_link(knot_isotopy_slice(made, static_cast<double>(k) / cuts))) << k;
}

TEST(KnotIsotopy, unknots_become_a_circle) {
  const Link circle = knot_of_table("circle");
  for (const char* name : {"kinks_1", "kinks_2", "kinks_3", "kinks_4", "kinks_5", "kinks_6", "goeritz", "ochiai"}) {
    SCOPED_TRACE(name);
    const Link knot = knot_of_table(name);
    expect_isotopy(knot_isotopy(knot, circle), knot, circle);
  }
}

TEST(KnotIsotopy, a_trefoil_becomes_itself_deformed) {
  const Link trefoil = knot_of_table("3_1"), other = deformed(parse_link("braid 3: -1 -1 -1 -2"));
  const KnotIsotopy made = knot_isotopy(trefoil, other);
  expect_isotopy(made, trefoil, other);
  expect_isotopy(knot_isotopy(other, trefoil), other, trefoil);
}

TEST(KnotIsotopy, a_figure_eight_becomes_its_mirror_image) {
  const Link knot = knot_of_table("4_1"), mirror = mirrored(knot);
  const KnotIsotopy made = knot_isotopy(knot, mirror);
  expect_isotopy(made, knot, mirror);
  EXPECT_NEAR(made.start_energy, made.end_energy, 0.01 * made.start_energy);
}

TEST(KnotIsotopy, different_knots_never_do) {
  const Link left = knot_of_table("3_1"), right = mirrored(left), circle = knot_of_table("circle");
  const Link eight = knot_of_table("4_1");
  for (const auto& [start, end] :
       {std::pair(left, right), std::pair(left, circle), std::pair(circle, right), std::pair(left, eight)})
    for (const KnotMethod method : {KnotMethod::relax, KnotMethod::automatic}) {
      if (method == KnotMethod::automatic && end.components == circle.components) continue;  // takes seconds
      KnotIsotopyOptions options;
      options.method = method;
      const KnotIsotopy made = knot_isotopy(start, end, options);
      EXPECT_EQ(made.status, Status::no_progress);
      EXPECT_TRUE(made.rings.empty());
      EXPECT_FALSE(made.found.empty());
      ASSERT_FALSE(made.straight_double_points.empty());
      EXPECT_EQ(made.left_double_points.empty(), method == KnotMethod::relax);
      for (const KnotDoublePoint& p : made.straight_double_points) {
        EXPECT_GE(p.time, 0);
        EXPECT_LE(p.time, 1);
        EXPECT_LE(std::abs(p.sign), 1);
      }
    }
}

TEST(KnotIsotopy, one_strand_through_another_is_one_double_point) {
  // A loop whose strand across another one goes down through it, or up.
  const auto loop = [](double height) {
    Link link;
    link.components.push_back({-4, 0, 0, 4, 0.013, 0, 4, 4, 0, 0.31, 4, height, -0.17, -4, height, -4, -4, 0});
    return link;
  };
  KnotIsotopyOptions options;
  options.method = KnotMethod::relax;
  const KnotIsotopy down = knot_isotopy(loop(1), loop(-1), options), up = knot_isotopy(loop(-1), loop(1), options);
  ASSERT_EQ(down.straight_double_points.size(), 1U);
  ASSERT_EQ(up.straight_double_points.size(), 1U);
  EXPECT_NEAR(down.straight_double_points[0].time, 0.5, 1e-6);
  EXPECT_LT(std::abs(down.straight_double_points[0].place[2]), 1e-6);
  EXPECT_LT(std::hypot(down.straight_double_points[0].place[0], down.straight_double_points[0].place[1]), 0.2);
  EXPECT_EQ(down.straight_double_points[0].sign * up.straight_double_points[0].sign, -1);
}

TEST(KnotIsotopy, double_points_of_opposite_signs_annihilate_each_other) {
  const Link knot = knot_of_table("kinks_2"), circle = knot_of_table("circle");
  KnotIsotopyOptions options;
  options.method = KnotMethod::direct;
  const KnotIsotopy made = knot_isotopy(knot, circle, options);
  EXPECT_FALSE(made.straight_double_points.empty());
  EXPECT_FALSE(made.relaxed);
  expect_isotopy(made, knot, circle);
}

TEST(KnotIsotopy, the_same_input_gives_the_same_bytes) {
  const Link knot = knot_of_table("kinks_2"), circle = knot_of_table("circle");
  KnotIsotopy a = knot_isotopy(knot, circle), b = knot_isotopy(knot, circle);
  a.seconds = b.seconds = 0;
  EXPECT_EQ(knot_isotopy_json(a, {}), knot_isotopy_json(b, {}));
}

TEST(KnotIsotopy, size_and_place_do_not_matter) {
  Link knot = knot_of_table("kinks_2");
  Link circle = knot_of_table("circle");
  for (double& c : knot.components[0]) c = c * 1e-20 + 3e-19;
  for (double& c : circle.components[0]) c = c * 1e-14 - 5e-14;
  expect_isotopy(knot_isotopy(knot, circle), knot, circle);
}

TEST(KnotIsotopy, stops_when_told_to) {
  const Link knot = knot_of_table("goeritz"), circle = knot_of_table("circle");
  Context context;
  context.cancel();
  KnotIsotopy made = knot_isotopy(knot, circle, {}, &context);
  EXPECT_EQ(made.status, Status::cancelled);
  EXPECT_TRUE(made.rings.empty());
  KnotIsotopyOptions options;
  options.time_limit_s = 1e-3;
  made = knot_isotopy(knot, circle, options);
  EXPECT_EQ(made.status, Status::time_limit);
  EXPECT_TRUE(made.rings.empty());
  double last = 0;
  Context watched;
  watched.on_progress = [&](const Context::Progress& p) {
    EXPECT_GE(p.fraction, last);
    EXPECT_LE(p.fraction, 1);
    last = p.fraction;
  };
  EXPECT_EQ(knot_isotopy(knot_of_table("kinks_1"), circle, {}, &watched).status, Status::embedded);
  EXPECT_GT(last, 0.9);
}

std::string refusal_of(const Link& start, const Link& end, const KnotIsotopyOptions& options = {}) {
  try {
    knot_isotopy(start, end, options);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(KnotIsotopy, bad_input_is_named) {
  const Link circle = knot_of_table("circle");
  EXPECT_NE(refusal_of(parse_link("0 0 0\n2 2 0\n2 0 0\n0 2 0\n"), circle).find("the start: edge 0"),
            std::string::npos);
  EXPECT_NE(refusal_of(circle, parse_link("0 0 0\n1 0 0\n1 0 0\n0 2 0\n")).find("the end: points 1 and 2"),
            std::string::npos);
  EXPECT_NE(refusal_of(parse_link("0 0 0\n1 0 0\n"), circle).find("has 2 points"), std::string::npos);
  EXPECT_NE(refusal_of(circle, knot_of_table("hopf")).find("the end has 2 components"), std::string::npos);
  Link bad = circle;
  bad.components[0][7] = std::nan("");
  EXPECT_NE(refusal_of(bad, circle).find("the start: point 2"), std::string::npos);
  // Strands at a distance that coordinates can tell, but not what is computed from them.
  EXPECT_NE(
      refusal_of(parse_link("0 0 0\n1 0.1 0\n1 1 0\n0.5 0.5 1\n0 0 1e-17\n-1 0.3 1\n"), circle).find("the start:"),
      std::string::npos);
  KnotIsotopyOptions options;
  options.points = 50;
  EXPECT_NE(refusal_of(circle, circle, options).find("points is 50, but a knot has 100"), std::string::npos);
  options.points = 5;
  EXPECT_NE(refusal_of(circle, circle, options).find("points is 5;"), std::string::npos);
}

TEST(CheckKnotIsotopy, finds_what_is_wrong) {
  const Link knot = knot_of_table("3_1"), other = deformed(knot);
  const KnotIsotopy made = knot_isotopy(knot, other);
  ASSERT_EQ(made.status, Status::embedded);
  const KnotIsotopy read = parse_knot_isotopy(knot_isotopy_json(made, {}));
  EXPECT_TRUE(check_knot_isotopy(read, knot, other).hold());
  EXPECT_FALSE(check_knot_isotopy(read, other, knot).ends_kept);
  EXPECT_FALSE(check_knot_isotopy(read, knot, mirrored(other)).ends_kept);
  EXPECT_FALSE(check_knot_isotopy(read, knot, knot_of_table("circle")).ends_kept);

  KnotIsotopy moved = made;
  moved.rings[0].points[4] = std::nextafter(moved.rings[0].points[4], 9.0);
  EXPECT_FALSE(check_knot_isotopy(moved, knot, other).ends_kept);

  // A ring in the mirror: on the way the knot passes through itself. Both ways to look find that.
  KnotIsotopy through = made;
  std::vector<double>& ring = through.rings[through.rings.size() / 2].points;
  for (std::size_t k = 0; k < ring.size(); k += 3) ring[k] = -ring[k];
  const KnotIsotopyFindings found = check_knot_isotopy(through, knot, other);
  EXPECT_TRUE(found.ends_kept);
  EXPECT_GT(found.meeting_triangles, 0U);
  EXPECT_GT(found.unproven_motions, 0U);

  KnotIsotopy shorter = made;
  shorter.rings[1].points.resize(12);
  EXPECT_THROW(check_knot_isotopy(shorter, knot, other), std::invalid_argument);
  KnotIsotopy pieces = made;
  pieces.start_pieces[0] += 1;
  EXPECT_THROW(check_knot_isotopy(pieces, knot, other), std::invalid_argument);
  EXPECT_THROW(parse_knot_isotopy("{"), FileError);
  EXPECT_THROW(parse_knot_isotopy("{\"rings\": [{\"time\": 0, \"points\": [[1, 2]]}]}"), FileError);
  EXPECT_THROW(parse_knot_isotopy("{\"rings\": []}"), FileError);
}

TEST(KnotIsotopyPictures, have_their_formats) {
  const Link knot = knot_of_table("kinks_1"), circle = knot_of_table("circle");
  const KnotIsotopy made = knot_isotopy(knot, circle);
  EXPECT_TRUE(knot_isotopy_gif(made, 3).starts_with("GIF89a"));
  EXPECT_TRUE(knot_isotopy_png(made, 2).starts_with("\x89PNG"));
  EXPECT_THROW(knot_isotopy_gif(made, 1), std::invalid_argument);
  EXPECT_THROW(knot_isotopy_png(KnotIsotopy{}, 2), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
