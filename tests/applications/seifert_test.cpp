#include "unsnarl/seifert.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "applications/seifert/link_diagram.h"
#include "applications/seifert/seifert_matrix.h"
#include "geometry/splitmix.h"
#include "unsnarl/document.h"
#include "unsnarl/intersections.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

std::string link_refusal(const std::string& text) {
  try {
    check_link(parse_link(text));
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

SeifertFindings spanned(const Link& link, SeifertOptions options = {}) {
  return check_seifert_surface(seifert_surface(link, options).surface, link);
}

TEST(KnotTable, polynomials_of_the_diagrams_have_the_determinants_of_tables) {
  ASSERT_EQ(knot_table().size(), 249U + 7U);
  for (const KnotEntry& entry : knot_table()) {
    SCOPED_TRACE(entry.name);
    const Link link = knot_of_table(entry.name);
    const auto diagram = diagram_of(link, Eigen::Matrix3d::Identity());
    ASSERT_TRUE(diagram);
    EXPECT_EQ(diagram->crossings.size(), entry.braid.size());
    const Polynomial p = alexander_polynomial(*diagram);
    EXPECT_EQ(abs(value_at(p, -1)), entry.determinant);
    EXPECT_EQ(abs(value_at(p, 1)), link.components.size() == 1 ? 1 : 0);
  }
  EXPECT_THROW(knot_of_table("3_2"), std::invalid_argument);
}

TEST(Polynomial, determinants_of_linear_matrices) {
  LinearMatrix m(2);  // (1 - t, 2; 3 t, 1)
  m.constant = {1, 2, 0, 1};
  m.slope = {-1, 0, 3, 0};
  EXPECT_EQ(to_text(determinant(m)), "1 - 7t");
  EXPECT_EQ(to_text(determinant(LinearMatrix(0))), "1");
  EXPECT_EQ(to_text(without_units({0, 0, 2, -3})), "-2 + 3t");
}

TEST(Polynomial, determinants_have_the_values_of_determinants_of_numbers) {
  std::mt19937_64 random(5);
  for (const Index n : {1, 2, 3, 5, 8, 13}) {
    for (const bool is_singular : {false, true}) {
      LinearMatrix m(n);
      for (std::size_t k = 0; k < m.constant.size(); ++k) {
        m.constant[k] = static_cast<std::int64_t>(random() % 2001) - 1000;
        m.slope[k] = random() % 3 == 0 ? static_cast<std::int64_t>(random() % 2000001) - 1000000 : 0;
      }
      for (Index j = 0; j < n && is_singular; ++j) {  // the last row is the first one, or zero
        m.constant[m.at(n - 1, j)] = n > 1 ? m.constant[m.at(0, j)] : 0;
        m.slope[m.at(n - 1, j)] = n > 1 ? m.slope[m.at(0, j)] : 0;
      }
      const Polynomial p = determinant(m);
      ASSERT_EQ(p.size(), static_cast<std::size_t>(n) + 1);
      for (const int t : {-7, -1, 0, 1, 2, 11}) {
        // Gauss's elimination with fractions.
        std::vector<boost::multiprecision::cpp_rational> a;
        for (std::size_t k = 0; k < m.constant.size(); ++k) a.emplace_back(m.constant[k] + t * m.slope[k]);
        boost::multiprecision::cpp_rational expected = 1;
        for (Index k = 0; k < n; ++k) {
          Index pivot = k;
          while (pivot + 1 < n && a[m.at(pivot, k)] == 0) ++pivot;
          if (pivot != k) expected = -expected;
          for (Index j = 0; j < n && pivot != k; ++j) std::swap(a[m.at(k, j)], a[m.at(pivot, j)]);
          expected *= a[m.at(k, k)];
          if (expected == 0) break;
          for (Index i = k + 1; i < n; ++i) {
            const boost::multiprecision::cpp_rational factor = a[m.at(i, k)] / a[m.at(k, k)];
            for (Index j = k; j < n; ++j) a[m.at(i, j)] -= factor * a[m.at(k, j)];
          }
        }
        EXPECT_EQ(boost::multiprecision::cpp_rational(value_at(p, t)), expected) << n << " at " << t;
      }
    }
  }
}

TEST(ParseLink, points_codes_and_braids) {
  const Link points = parse_link("# a triangle\n0 0 0\n1, 0, 0\n0\t1 0\n0 0 0\n\n\n0 0 1\n1 0 1\n0 1 1.5\n");
  ASSERT_EQ(points.components.size(), 2U);
  EXPECT_EQ(points.point_count(), 6U);  // the first point was repeated
  EXPECT_EQ(parse_link(link_text(points)).components, points.components);
  EXPECT_EQ(parse_link("braid 2: 1 1 1").components, braid_closure(2, std::vector<int>{1, 1, 1}).components);
  EXPECT_EQ(parse_link("PD[X[4,1,3,2], X[2,3,1,4]]").components.size(), 2U);
}

TEST(ParseLink, planar_diagrams_keep_their_handedness) {
  // The left-handed trefoil as tables give it: three negative crossings.
  const auto diagram = diagram_of(parse_link("X[1,4,2,5] X[3,6,4,1] X[5,2,6,3]"), Eigen::Matrix3d::Identity());
  ASSERT_TRUE(diagram);
  ASSERT_EQ(diagram->crossings.size(), 3U);
  for (const LinkDiagram::Crossing& c : diagram->crossings) EXPECT_EQ(c.sign, -1);
}

TEST(ParseLink, says_what_is_wrong_and_where) {
  EXPECT_NE(link_refusal("").find("nothing in it"), std::string::npos);
  EXPECT_EQ(link_refusal("0 0 0\n1 0\n"), "line 2: 2 numbers; a point has three, 'x y z'");
  EXPECT_NE(link_refusal("0 0 0\n1 x 0\n").find("line 2: 'x 0' is not a coordinate"), std::string::npos);
  EXPECT_NE(link_refusal("0 0 0\n1 0 0\n").find("component 0 has 2 points"), std::string::npos);
  EXPECT_NE(link_refusal("0 0 0\n1 0 0\n1 0 0\n0 1 0\n").find("points 1 and 2 of component 0 are one"),
            std::string::npos);
  EXPECT_NE(link_refusal("0 0 0\n2 2 0\n2 0 0\n0 2 0\n").find("touch"), std::string::npos);
  EXPECT_NE(link_refusal("0 0 0\n2 0 0\n1 0 0\n0 2 0\n").find("touch"), std::string::npos);
  EXPECT_NE(link_refusal("X[1,2,3]").find("four edges a crossing"), std::string::npos);
  EXPECT_NE(link_refusal("X[1,4,2,5] X[3,6,4,1] X[5,2,6,7]").find("has an edge 7"), std::string::npos);
  EXPECT_NE(link_refusal("braid 3: 1 3").find("generator 2 of the braid is 3"), std::string::npos);
  EXPECT_NE(link_refusal("braid 2: -2147483648").find("generator 1 of the braid is -2147483648"), std::string::npos);
  EXPECT_NE(link_refusal("braid three: 1").find("is not a whole number"), std::string::npos);
}

TEST(SeifertSurface, knots_and_links_are_spanned) {
  const std::vector<std::pair<const char*, int>> genus{
      {"unknot", 0}, {"3_1", 1}, {"4_1", 1}, {"hopf", 0}, {"whitehead", 1}, {"t_2_4", 1}, {"t_2_4_reversed", 0}};
  for (const auto& [name, g] : genus) {
    SCOPED_TRACE(name);
    const SeifertFindings found = spanned(knot_of_table(name));
    EXPECT_TRUE(found.hold()) << polynomial_text(found.alexander_of_surface);
    EXPECT_EQ(found.genus, g);
  }
}

TEST(SeifertSurface, determinants_signatures_and_least_genera) {
  struct Known {
    const char* text;
    const char* determinant;
    int signature;
  };
  for (const auto& [text, determinant, signature] :
       {Known{"braid 2: 1 1 1", "3", -2}, Known{"braid 2: -1 -1 -1", "3", 2}, Known{"braid 3: 1 -2 1 -2", "5", 0},
        Known{"braid 2: 1 1 1 1 1", "5", -4}, Known{"braid 3: 1 1 1 2 1 1 1 2", "3", -6},
        Known{"braid 2: 1 1", "2", -1}, Known{"braid 3: 1 -2 1 -2 1 -2", "16", 0}}) {
    SCOPED_TRACE(text);
    const SeifertFindings found = spanned(parse_link(text), {.fair = false});
    EXPECT_EQ(found.determinant, determinant);
    EXPECT_EQ(found.signature, signature);
    EXPECT_TRUE(found.genus_is_least);
  }
  const Link trefoil = parse_link("braid 2: 1 1 1");
  const Surface with_handle = seifert_surface(trefoil, {.handles = 1, .fair = false}).surface;
  const SeifertFindings found = check_seifert_surface(with_handle, trefoil, 60, 1);
  EXPECT_EQ(found.signature, -2);
  EXPECT_FALSE(found.genus_is_least);
  // Two right-handed trefoils apart from each other.
  Link both = trefoil;
  for (std::vector<double>& p : both.components)
    for (std::size_t k = 0; k < p.size(); k += 3) p[k] += 20;
  both.components.push_back(trefoil.components[0]);
  const SeifertFindings apart = spanned(both, {.fair = false});
  EXPECT_EQ(apart.signature, -4);
  EXPECT_EQ(apart.determinant, "0");
}

TEST(SeifertSurface, polygons_of_few_points_end_with_fairing) {
  for (const char* text : {"0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "0 0 0\n1 0 0\n0 1 0\n", "0 0 0\n1 0 0\n0.5 1e-4 0\n",
                           "1 5 -2\n0 -5 2\n-4 3 -2\n5 -1 3\n-4 -2 -2\n4 3 1\n"}) {
    SCOPED_TRACE(text);
    const Link link = parse_link(text);
    const SeifertResult made = seifert_surface(link);
    EXPECT_EQ(made.status, Status::embedded) << made.message;
    EXPECT_TRUE(made.message.empty()) << made.message;
    EXPECT_TRUE(check_seifert_surface(made.surface, link).hold());
    EXPECT_GT(made.surface.view().face_count(), 50U);
    EXPECT_LT(made.surface.view().face_count(), 2000U);
  }
}

TEST(SeifertSurface, random_polygons_are_spanned_with_fairing) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    std::uint64_t state = (seed + 7) << 32;
    Link link;
    std::vector<double>& points = link.components.emplace_back();
    for (std::uint64_t k = 0; k < 3 * (8 + seed); ++k) points.push_back(splitmix_number(state += splitmix_step));
    const SeifertResult made = seifert_surface(link);
    EXPECT_EQ(made.status, Status::embedded) << made.message;
    EXPECT_TRUE(check_seifert_surface(made.surface, link).hold());
  }
}

/// A strip of straight ways between the points of a circle and those of another that runs through its middle, which are
/// a quarter further on; the strip runs through itself.
Surface naive_strip() {
  constexpr int around = 48, across = 12;
  Surface s;
  for (int r = 0; r <= across; ++r)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around, t = static_cast<double>(r) / across;
      const double other = angle + std::numbers::pi / 2;
      const std::array<double, 3> p{std::cos(angle), std::sin(angle), 0}, q{1 + std::cos(other), 0, std::sin(other)};
      for (int i = 0; i < 3; ++i) s.positions.push_back((1 - t) * p[i] + t * q[i]);
    }
  for (int r = 0; r < across; ++r)
    for (int k = 0; k < around; ++k) {
      const int next = (k + 1) % around, a = r * around + k, b = r * around + next;
      s.corners.insert(s.corners.end(), {a, b, b + around, a, b + around, a + around});
    }
  return s;
}

TEST(UntangledSeifertSurface, the_papers_hopf_link) {
  const Surface start = naive_strip();
  ASSERT_FALSE(find_intersections(start).empty());
  const SpanningBoundary boundary = spanning_boundary(start);
  ASSERT_EQ(boundary.link.components.size(), 2U);
  EXPECT_EQ(boundary.euler_characteristic, 0);
  const SeifertResult made = untangled_seifert_surface(start);
  ASSERT_EQ(made.status, Status::embedded) << made.message;
  const SeifertFindings found = check_seifert_surface(made.surface, boundary.link, 60, 0, 0);
  EXPECT_TRUE(found.hold()) << seifert_faults(found);
  EXPECT_EQ(polynomial_text(found.alexander_of_surface), "-1 + t");
  EXPECT_TRUE(find_intersections(made.surface).empty());
}

TEST(UntangledSeifertSurface, refuses_what_spans_no_link) {
  EXPECT_THROW(spanning_boundary(make_sample("mobius_extended", 12)), std::invalid_argument);
  EXPECT_THROW(untangled_seifert_surface(make_sample("spindle_torus", 12)), std::invalid_argument);
  EXPECT_THROW(untangled_seifert_surface(naive_strip(), {.handles = 1}), std::invalid_argument);
}

/// Two flat rings one above the other, whose middles cross at two places when seen from above. At one of them,
/// triangles are so large that push-offs of the two sides would pass each other.
TEST(SeifertMatrix, push_offs_of_sheets_that_face_each_other_keep_their_order) {
  constexpr int fine = 40, coarse = 4, n = fine + coarse;
  std::vector<Vec3> x;
  std::vector<Triangle> faces;
  for (const Vec3& middle : {Vec3(0, 0, 0), Vec3(0.3, 0, 5e-4)}) {
    const auto first = static_cast<Index>(x.size());
    for (int k = 0; k < n; ++k) {
      const double part = k < fine ? static_cast<double>(k) / fine : 1 + static_cast<double>(k - fine) / coarse;
      const double angle = std::numbers::pi * part;
      for (const double radius : {1.0, 2.0}) x.push_back(middle + radius * Vec3(std::cos(angle), std::sin(angle), 0));
      const Index a = first + 2 * k, b = first + 2 * ((k + 1) % n);
      faces.push_back({a, a + 1, b + 1});
      faces.push_back({a, b + 1, b});
    }
  }
  const SeifertMatrix matrix = seifert_matrix(x, faces);
  EXPECT_EQ(matrix.size, 2);
  EXPECT_EQ(matrix.entries, std::vector<std::int64_t>(4, 0));
}

TEST(SeifertSurface, as_built_it_is_embedded_whatever_the_knot) {
  for (const char* name : {"5_2", "8_19", "10_139", "10_165", "borromean", "t_3_7"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(spanned(knot_of_table(name), {.fair = false}).hold());
  }
}

TEST(SeifertSurface, sticks_lattices_and_split_links) {
  // A trefoil of six sticks, one on a lattice whose edges lie in line, two triangles apart.
  EXPECT_EQ(
      polynomial_text(
          spanned(parse_link("1 5 -2\n0 -5 2\n-4 3 -2\n5 -1 3\n-4 -2 -2\n4 3 1\n"), {.fair = false}).alexander_of_link)
          .substr(0, 1),
      "1");
  const Link split = parse_link("0 0 0\n1 0 0\n0 1 0\n\n5 0 0\n6 0 0\n5 1 0\n");
  const SeifertFindings found = spanned(split, {.fair = false});
  EXPECT_EQ(found.components, 2);
  EXPECT_TRUE(found.alexander_of_surface.empty());
  EXPECT_EQ(found.determinant, "0");
  EXPECT_EQ(found.signature, 0);
  EXPECT_FALSE(found.genus_is_least);
  EXPECT_TRUE(found.hold());
}

TEST(SeifertSurface, random_polygons_of_few_points_are_spanned) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::uint64_t state = seed << 32;
    Link link;
    std::vector<double>& points = link.components.emplace_back();
    for (std::uint64_t k = 0; k < 3 * (6 + seed % 7); ++k) points.push_back(splitmix_number(state += splitmix_step));
    EXPECT_TRUE(spanned(link, {.fair = false}).hold());
  }
}

TEST(SeifertSurface, flat_and_steep_knots_and_planar_diagrams_are_spanned) {
  for (const double height : {1e-6, 1e-3, 1e3}) {
    SCOPED_TRACE(height);
    Link link = knot_of_table("4_1");
    for (std::size_t k = 2; k < link.components[0].size(); k += 3) link.components[0][k] *= height;
    EXPECT_TRUE(spanned(link, {.fair = false}).hold());
  }
  EXPECT_TRUE(spanned(parse_link("X[1,4,2,5] X[3,6,4,1] X[5,2,6,3]"), {.fair = false}).hold());
  Link flat = knot_of_table("4_1");
  for (std::size_t k = 2; k < flat.components[0].size(); k += 3) flat.components[0][k] *= 1e-14;
  EXPECT_THROW(spanned(flat, {.fair = false}), std::invalid_argument);
}

/// In its simplest view, three strands of the first polygon cross in nearly one place. That of the second one is along
/// an axis, so that discs lie in a plane of coordinates, and some look to either side of it.
TEST(SeifertSurface, views_with_hardly_any_room_and_discs_in_one_plane) {
  const char* const narrow =
      "0.079 0.3751 0.4632\n0.4696 0.3638 0.2488\n0.8365 0.0654 0.5435\n0.0736 0.6108 0.4492\n"
      "0.6419 0.0955 0.7244\n0.1861 0.5414 0.2741\n0.4044 0.9466 0.3314\n0.0732 0.3075 0.1709\n"
      "0.3371 0.8289 0.9036\n0.0412 0.3892 0.743\n0.9884 0.3171 0.4345\n0.2653 0.6549 0.2571\n"
      "0.1804 0.7665 0.6691\n0.6113 0.2233 0.1244\n0.9999 0.9705 0.2714\n0.9763 0.8184 0.8327\n"
      "0.9135 0.0357 0.196\n0.8878 0.684 0.3722\n0.6284 0.3222 0.4356\n0.4498 0.4647 0.9781\n"
      "0.891 0.027 0.2004\n0.1163 0.2701 0.6535\n0.245 0.9584 0.43\n0.7965 0.0572 0.9983\n"
      "0.5377 0.2768 0.2226\n0.2394 0.7096 0.0301\n0.261 0.6357 0.2707\n0.4838 0.2416 0.7205\n";
  const char* const level =
      "0.915 0.853 0.669\n0.324 0.722 0.94\n0.913 0.568 0.89\n0.892 0.303 0.561\n0.643 0.451 0.354\n"
      "0.038 0.206 0.467\n0.003 0.631 0.166\n0.447 0.592 0.786\n0.235 0.011 0.375\n0.357 0.811 0.314\n"
      "0.062 0.532 0.375\n0.429 0.159 0.575\n0.464 0.05 0.999\n0.241 0.131 0.604\n0.164 0.961 0.15\n"
      "0.556 0.035 0.604\n0.841 0.42 0.006\n0.965 0.14 0.219\n0.201 0.889 0.876\n0.454 0.281 0.329\n"
      "0.45 0.137 0.667\n0.291 0.383 0.463\n0.882 0.407 0.182\n0.213 0.748 0.599\n0.269 0.825 0.767\n"
      "0.212 0.016 0.411\n0.423 0.88 0.567\n0.396 0.106 0.832\n0.59 0.42 0.252\n0.54 0.406 0.621\n"
      "0.192 0.818 0.726\n0.055 0.221 0.96\n0.223 0.036 0.639\n0.782 0.958 0.921\n0.869 0.393 0.766\n"
      "0.579 0.612 0.239\n0.43 0.983 0.686\n0.234 0.061 0.239\n0.646 0.019 0.535\n0.061 0.82 0.06\n"
      "0.191 0.147 0.813\n0.156 0.047 0.517\n0.265 0.363 0.586\n0.067 0.397 0.075\n";
  for (const char* polygon : {narrow, level}) {
    const Link link = parse_link(polygon);
    EXPECT_TRUE(spanned(link, {.fair = false}).hold());
    const std::optional<LinkDiagram> best = best_diagram(link, 60);
    ASSERT_TRUE(best);
    const LinkDiagram roomier = roomier_diagram(link, *best);
    EXPECT_EQ(roomier.euler_characteristic(), best->euler_characteristic());
    EXPECT_GT(narrowest_nesting(roomier), 2 * narrowest_nesting(*best));
  }
}

TEST(SeifertSurface, nearly_flat_polygons_are_spanned_though_the_best_view_is_from_their_side) {
  std::uint64_t state = 0;
  const auto random = [&] { return splitmix_number(++state * splitmix_step) - 0.5; };
  for (int k = 0; k < 60; ++k) {
    Link link;
    std::vector<double>& points = link.components.emplace_back();
    for (int p = 0; p < 4 + k % 4; ++p) points.insert(points.end(), {random(), random(), 1e-6 * random()});
    SeifertOptions as_built;
    as_built.fair = false;
    const SeifertResult made = seifert_surface(link, as_built);
    EXPECT_EQ(made.status, Status::embedded) << k << ": " << made.message;
    EXPECT_TRUE(check_seifert_surface(made.surface, link).hold()) << k;
  }
}

TEST(SeifertSurface, handles_raise_the_genus_and_keep_the_polynomial) {
  // The last link has two lowest discs, side by side.
  for (const char* text : {"braid 2: 1 1 1", "braid 3: 1 -2 1 -2 1 -2", "0 0 0\n1 0 0\n0 1 0\n\n5 0 0\n6 0 0\n5 1 0\n"})
    for (const bool fair : {false, true})
      for (const int handles : {1, 4}) {
        SCOPED_TRACE(text);
        const Link link = parse_link(text);
        const int genus = spanned(link, {.fair = false}).genus;
        const Surface surface = seifert_surface(link, {.handles = handles, .fair = fair}).surface;
        const SeifertFindings found = check_seifert_surface(surface, link, 60, handles);
        EXPECT_TRUE(found.hold());
        EXPECT_EQ(found.genus, genus + handles);
        EXPECT_FALSE(check_seifert_surface(surface, link).hold());
      }
  const Link trefoil = knot_of_table("3_1");
  const Surface most = seifert_surface(trefoil, {.handles = 20, .fair = false}).surface;
  EXPECT_TRUE(check_seifert_surface(most, trefoil, 60, 20).hold());
  EXPECT_THROW(seifert_surface(trefoil, {.handles = 101}), std::invalid_argument);
}

TEST(SeifertSurface, the_time_limit_holds_while_triangles_are_split) {
  const Link link = knot_of_table("3_1");
  const SeifertResult made = seifert_surface(link, {.edge_rel = 0.002, .time_limit_s = 0.05});
  EXPECT_EQ(made.status, Status::time_limit);
  EXPECT_LT(made.surface.view().face_count(), 100000U);  // the first split alone would make more
  EXPECT_THROW(seifert_surface(link, {.edge_rel = 1e-4}), std::invalid_argument);
}

/// Of a knot with thousands of points, the surface as it is built has hardly more triangles than edges at the boundary.
TEST(SeifertSurface, fine_boundaries_are_spanned_with_few_triangles) {
  constexpr int n = 1500;
  Link link;
  std::vector<double>& p = link.components.emplace_back();
  for (int k = 0; k < n; ++k) {
    const double t = 2 * std::numbers::pi * k / n;
    p.insert(p.end(), {std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)});
  }
  const Surface built = seifert_surface(link, {.fair = false}).surface;
  EXPECT_LT(built.view().face_count(), 2U * n);
  EXPECT_TRUE(check_seifert_surface(built, link).hold());
  const SeifertResult faired = seifert_surface(link);
  EXPECT_EQ(faired.status, Status::embedded);
  EXPECT_TRUE(faired.message.empty()) << faired.message;
  EXPECT_TRUE(check_seifert_surface(faired.surface, link).hold());
}

TEST(KnotTube, runs_beside_the_surface_or_is_refused) {
  const Link link = knot_of_table("borromean");
  const Surface surface = seifert_surface(link, {.fair = false}).surface;
  const KnotTube tube = knot_tube(link, surface);
  ASSERT_GT(tube.radius, 0);
  EXPECT_TRUE(is_clear_tube(tube.surface, surface));
  EXPECT_TRUE(find_intersections(tube.surface).empty());
  // A tube elsewhere, one with a hole, and one through itself.
  Surface wrong = tube.surface;
  for (std::size_t k = 2; k < wrong.positions.size(); k += 3) wrong.positions[k] += 100;
  EXPECT_FALSE(is_clear_tube(wrong, surface));
  wrong = tube.surface;
  wrong.corners.resize(wrong.corners.size() - 3);
  EXPECT_FALSE(is_clear_tube(wrong, surface));
  wrong = tube.surface;
  for (double& x : wrong.positions) x = std::round(x);
  EXPECT_FALSE(is_clear_tube(wrong, surface));
  // Another sheet of surface through the middle of the tube.
  Surface pierced = surface;
  const auto first = static_cast<Index>(pierced.positions.size() / 3);
  const std::vector<double>& p = link.components[0];
  for (const std::array<double, 3>& by : {std::array<double, 3>{9, 0, 0}, {0, 9, 0}, {0, 0, 9}})
    for (int i = 0; i < 3; ++i) pierced.positions.push_back(p[3 * 20 + i] + by[i]);
  pierced.corners.insert(pierced.corners.end(), {first, first + 1, first + 2});
  EXPECT_TRUE(is_clear_tube(tube.surface, pierced));  // far away
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) pierced.positions[3 * (first + k) + i] -= 3;  // its middle is at point 20
  EXPECT_FALSE(is_clear_tube(tube.surface, pierced));
}

TEST(SeifertSurface, repeats_itself_and_stops_when_asked) {
  const Link link = knot_of_table("3_1");
  EXPECT_EQ(seifert_surface(link).surface.positions, seifert_surface(link).surface.positions);
  Context context;
  context.cancel();
  const SeifertResult stopped = seifert_surface(link, {}, &context);
  EXPECT_EQ(stopped.status, Status::cancelled);
  EXPECT_TRUE(check_seifert_surface(stopped.surface, link).hold());
  EXPECT_THROW(seifert_surface(link, {.edge_rel = 0.6}), std::invalid_argument);
  EXPECT_THROW(seifert_surface(link, {.views = 2}), std::invalid_argument);
}

TEST(CheckSeifertSurface, finds_what_is_wrong) {
  const Link link = knot_of_table("3_1");
  const Surface good = seifert_surface(link, {.fair = false}).surface;
  EXPECT_TRUE(check_seifert_surface(good, link).hold());
  EXPECT_FALSE(check_seifert_surface(good, knot_of_table("5_1")).spans_link);
  Surface moved = good;
  moved.positions[0] = std::nextafter(moved.positions[0], 10);
  EXPECT_FALSE(check_seifert_surface(moved, link).spans_link);
  Surface flipped = good;
  std::swap(flipped.corners[0], flipped.corners[1]);
  EXPECT_FALSE(check_seifert_surface(flipped, link).oriented);
  Surface torn = good;
  torn.corners.resize(torn.corners.size() - 3);
  EXPECT_FALSE(check_seifert_surface(torn, link).hold());
  Surface pierced = good;
  for (int k = 0; k < 3; ++k) pierced.positions[pierced.positions.size() - 3 + k] = k == 2 ? 3 : 0;
  EXPECT_GT(check_seifert_surface(pierced, link).intersecting_pairs, 0U);
}

TEST(CheckSeifertSurface, a_closed_component_bounds_nothing) {
  const Link split = parse_link("0 0 0\n1 0 0\n0 1 0\n\n5 0 0\n6 0 0\n5 1 0\n");
  Surface surface;
  for (const auto& component : split.components)
    surface.positions.insert(surface.positions.end(), component.begin(), component.end());
  surface.corners = {0, 1, 2, 3, 4, 5};
  const int n = 4;  // a torus far away, which changes no Euler characteristic
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / n, r = 3 + std::cos(b);
      surface.positions.insert(surface.positions.end(), {50 + r * std::cos(a), r * std::sin(a), std::sin(b)});
      const auto at = [&](int k, int l) { return 6 + k % n * n + l % n; };
      const auto [p, q, s, t] = std::array{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      surface.corners.insert(surface.corners.end(), {p, q, s, p, s, t});
    }
  for (std::size_t k = 0; k <= surface.corners.size(); k += 3) surface.offsets.push_back(static_cast<Index>(k));
  SeifertFindings found = check_seifert_surface(surface, split);
  EXPECT_EQ(found.intersecting_pairs, 0U);
  EXPECT_TRUE(found.oriented);
  EXPECT_TRUE(found.spans_link);
  EXPECT_EQ(found.closed_components, 1);
  EXPECT_EQ(found.euler_characteristic, found.expected_euler_characteristic);
  EXPECT_FALSE(found.hold());
}

}  // namespace
}  // namespace unsnarl
