#include "unsnarl/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "geometry/box.h"
#include "geometry/predicates.h"
#include "mesh/adjacency.h"
#include "mesh/components.h"
#include "mesh/triangulation.h"
#include "mesh/validity.h"

namespace unsnarl {
namespace {

struct Shape {
  std::size_t components = 0, boundary_loops = 0, non_manifold_edges = 0;
  bool orientable = true;
  Index euler_characteristic = 0;
  friend bool operator==(const Shape&, const Shape&) = default;
};

std::ostream& operator<<(std::ostream& out, const Shape& s) {
  return out << s.components << " components, " << s.boundary_loops << " boundary loops, " << s.non_manifold_edges
             << " non-manifold edges, orientable " << s.orientable << ", Euler characteristic "
             << s.euler_characteristic;
}

/// Boundary edges joined at their vertices.
std::size_t count_loops(const EdgeTable& table) {
  std::map<Index, std::vector<Index>> next;
  for (Index e = 0; e < static_cast<Index>(table.edges.size()); ++e) {
    if (table.triangles_of_edge[e].size() != 1) continue;
    next[table.edges[e][0]].push_back(table.edges[e][1]);
    next[table.edges[e][1]].push_back(table.edges[e][0]);
  }
  std::set<Index> seen;
  std::size_t loops = 0;
  for (const auto& [start, unused] : next) {
    if (!seen.insert(start).second) continue;
    ++loops;
    std::vector<Index> open = {start};
    while (!open.empty()) {
      const Index v = open.back();
      open.pop_back();
      for (Index w : next[v])
        if (seen.insert(w).second) open.push_back(w);
    }
  }
  return loops;
}

Shape shape_of(const Surface& surface) {
  const auto triangles = triangulate(surface).triangles;
  const EdgeTable edges = build_edges(triangles);
  const Components components = find_components(surface, weld(surface, Weld::none), triangles, edges);
  Shape shape;
  shape.components = components.list.size();
  shape.boundary_loops = count_loops(edges);
  for (const Component& c : components.list) {
    shape.non_manifold_edges += static_cast<std::size_t>(c.non_manifold_edges);
    shape.orientable &= c.orientable;
    shape.euler_characteristic += c.euler_characteristic();
  }
  return shape;
}

/// What each sample is, as its description says.
const std::map<std::string, Shape>& shapes() {
  constexpr bool orientable = true, non_orientable = false;
  static const std::map<std::string, Shape> known = {
      {"mobius_extended", {1, 1, 0, non_orientable, 0}},
      {"lemniscate_band", {1, 1, 0, non_orientable, 0}},
      {"twisted_annulus", {1, 2, 0, orientable, 0}},
      {"cylinder_wrapped", {1, 2, 0, orientable, 0}},
      {"cylinder_inverted", {1, 2, 0, orientable, 0}},
      {"star_prism", {1, 2, 0, orientable, 0}},
      {"whitney_umbrella", {1, 1, 0, orientable, 1}},
      {"crumpled_sheet", {1, 1, 0, orientable, 1}},
      {"book", {1, 1, 20, orientable, 1}},
      {"folded_sheet", {1, 1, 0, orientable, 1}},
      {"perforated_fold", {1, 4, 0, orientable, -2}},
      {"spiral_sheet", {1, 1, 0, orientable, 1}},
      {"helicoid_overlapping", {1, 1, 0, orientable, 1}},
      {"swallowtail", {1, 1, 0, orientable, 1}},
      {"enneper", {1, 1, 0, orientable, 1}},
      {"henneberg", {1, 1, 0, non_orientable, 0}},
      {"catalan", {1, 1, 0, orientable, 1}},
      {"boy_punctured", {1, 1, 0, non_orientable, 0}},
      {"cross_cap_punctured", {1, 1, 0, non_orientable, 0}},
      {"roman_punctured", {1, 1, 0, non_orientable, 0}},
      {"klein_bottle_punctured", {1, 1, 0, non_orientable, -1}},
      {"klein_figure8_punctured", {1, 1, 0, non_orientable, -1}},
      {"trefoil_tube", {1, 0, 0, orientable, 0}},
      {"figure_eight_knot_tube", {1, 0, 0, orientable, 0}},
      {"crossing_tubes", {2, 4, 0, orientable, 0}},
      {"flying_saucer", {1, 0, 0, orientable, 2}},
      {"figure8_torus", {1, 0, 0, orientable, 0}},
      {"spindle_torus", {1, 0, 0, orientable, 0}},
      {"pretzel", {1, 0, 0, orientable, -2}},
      {"intersecting_spheres", {3, 0, 0, orientable, 6}},
      {"linked_rings", {3, 0, 0, orientable, 0}},
      {"jellyfish", {12, 24, 0, orientable, 0}},
      {"anchored_balls", {6, 0, 0, orientable, 12}},
      {"stool", {7, 0, 0, orientable, 14}},
      {"crossing_shells", {3, 0, 0, orientable, 6}},
      {"anchor_scene", {7, 1, 0, orientable, 5}},
      {"dressed_figure", {2, 4, 0, orientable, 0}},
      {"medusa", {61, 0, 0, orientable, 122}},
      {"posed_limb", {1, 0, 0, orientable, 2}},
      {"overlapping_quads", {3, 1, 0, orientable, 5}},
      {"hair_cards", {61, 60, 0, orientable, 62}},
      {"klein_map", {1, 0, 0, orientable, -4}},
      {"dyck_map", {1, 0, 0, orientable, -4}},
      {"klein_bottle", {1, 0, 0, non_orientable, 0}},
      {"boy_surface", {1, 0, 0, non_orientable, 1}},
  };
  return known;
}

bool share_vertex(const Triangle& a, const Triangle& b) {
  return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

/// Two triangles without a common vertex cross: an edge of one passes through the inside of the other, by exact signs.
bool edge_pierces(const Positions& x, const Triangle& a, const Triangle& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = x.col(a[k]), q = x.col(a[(k + 1) % 3]), u = x.col(b[0]), v = x.col(b[1]), w = x.col(b[2]);
    if (orient3d(u, v, w, p) * orient3d(u, v, w, q) >= 0) continue;
    const Sign s = orient3d(p, q, u, v), t = orient3d(p, q, v, w), r = orient3d(p, q, w, u);
    if (s == t && t == r && s != 0) return true;
  }
  return false;
}

/// At least one pair, by a sweep along x.
bool runs_through_itself(const Surface& surface) {
  const auto triangles = triangulate(surface).triangles;
  const Positions x =
      Eigen::Map<const Positions>(surface.positions.data(), 3, static_cast<Index>(surface.view().vertex_count()));
  std::vector<std::pair<double, Index>> order;
  std::vector<Box> boxes;
  for (const Triangle& t : triangles) {
    boxes.push_back(box_of(x, t));
    order.emplace_back(boxes.back().lo[0], static_cast<Index>(boxes.size()) - 1);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && order[j].first <= boxes[order[i].second].hi[0]; ++j) {
      const Index a = order[i].second, b = order[j].second;
      if (!boxes[a].overlaps(boxes[b]) || share_vertex(triangles[a], triangles[b])) continue;
      if (edge_pierces(x, triangles[a], triangles[b]) || edge_pierces(x, triangles[b], triangles[a])) return true;
    }
  return false;
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

class EverySample : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Samples, EverySample, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Sample& sample : all_samples()) names.push_back(sample.name);
                           return names;
                         }()),
                         [](const auto& info) { return info.param; });

TEST_P(EverySample, is_a_valid_mesh_at_many_resolutions) {
  for (int resolution : {8, 13, 40, 81}) {
    const Surface surface = make_sample(GetParam(), resolution);
    EXPECT_NO_THROW(require_valid(surface));
    EXPECT_GT(surface.view().face_count(), 0U);
    std::vector<bool> used(surface.view().vertex_count(), false);
    for (Index v : surface.corners) used[static_cast<std::size_t>(v)] = true;
    EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool b) { return b; })) << "vertices without faces";
    for (std::size_t f = 0; f < surface.view().face_count(); ++f) {
      const auto face = surface.view().face(f);
      EXPECT_EQ(std::set<Index>(face.begin(), face.end()).size(), face.size()) << "face " << f << " repeats a vertex";
    }
  }
}

TEST_P(EverySample, has_the_size_that_the_header_promises) {
  if (GetParam().ends_with("_map")) return;  // regular maps have one size: see RegularMaps
  const std::size_t faces = make_sample(GetParam()).view().face_count();
  EXPECT_GE(faces, 1000U);
  EXPECT_LE(faces, 8000U);
}

TEST_P(EverySample, has_the_declared_topology) {
  ASSERT_TRUE(shapes().contains(GetParam())) << "say here what the new sample is";
  EXPECT_EQ(shape_of(make_sample(GetParam())), shapes().at(GetParam()));
}

TEST_P(EverySample, keeps_its_topology_when_refined) {
  Shape fine = shape_of(make_sample(GetParam(), 151)), expected = shapes().at(GetParam());
  if (expected.non_manifold_edges > 0) {  // the spine has as many edges as there are steps
    EXPECT_EQ(fine.non_manifold_edges, 151U);
    fine.non_manifold_edges = expected.non_manifold_edges;
  }
  EXPECT_EQ(fine, expected);
}

TEST_P(EverySample, runs_through_itself) {
  if (GetParam() == "cylinder_inverted")
    return;  // it only touches itself: see TheInvertedCylinderCollapsesToExactlyOnePoint
  EXPECT_TRUE(runs_through_itself(make_sample(GetParam())));
}

TEST_P(EverySample, is_the_same_on_every_call) {
  const Surface a = make_sample(GetParam()), b = make_sample(GetParam());
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.offsets, b.offsets);
}

TEST_P(EverySample, takes_its_parameters_to_their_bounds) {
  const auto sample =
      std::find_if(all_samples().begin(), all_samples().end(), [](const Sample& s) { return s.name == GetParam(); });
  for (const SampleParameter& p : sample->parameters) {
    EXPECT_LE(p.minimum, p.value) << p.name;
    EXPECT_LE(p.value, p.maximum) << p.name;
    EXPECT_FALSE(p.description.empty()) << p.name;
    for (double value : {p.minimum, p.maximum}) {
      const Surface surface = make_sample(GetParam(), 16, {{p.name, value}});
      EXPECT_NO_THROW(require_valid(surface)) << p.name << " = " << value;
    }
    const double beyond = p.maximum + 1;
    EXPECT_THROW(make_sample(GetParam(), 16, {{p.name, beyond}}), std::invalid_argument) << p.name;
    EXPECT_THROW(make_sample(GetParam(), 16, {{p.name, std::nan("")}}), std::invalid_argument) << p.name;
  }
}

TEST_P(EverySample, says_truthfully_whether_it_can_be_embedded) {
  const auto sample =
      std::find_if(all_samples().begin(), all_samples().end(), [](const Sample& s) { return s.name == GetParam(); });
  const Surface surface = make_sample(GetParam());
  const auto triangles = triangulate(surface).triangles;
  const Components components = find_components(surface, weld(surface, Weld::none), triangles, build_edges(triangles));
  const bool obstructed =
      std::any_of(components.list.begin(), components.list.end(), [](const Component& c) { return c.obstructed(); });
  EXPECT_EQ(sample->embeddable, !obstructed);
}

TEST_P(EverySample, has_no_accidental_coincidences) {
  const Surface surface = make_sample(GetParam());
  std::set<std::array<double, 3>> places;
  std::size_t coincident = 0;
  for (std::size_t v = 0; v < surface.view().vertex_count(); ++v) {
    const std::array<double, 3> p = {surface.positions[3 * v], surface.positions[3 * v + 1],
                                     surface.positions[3 * v + 2]};
    coincident += places.insert(p).second ? 0 : 1;
  }
  // The one ring of the inverted cylinder is one point by its nature.
  EXPECT_EQ(coincident, GetParam() == "cylinder_inverted" ? 47U : 0U);
}

TEST(Samples, are_at_least_twenty_six_analytic_ones) {
  EXPECT_GE(analytic_sample_count, 26U);
  ASSERT_GE(all_samples().size(), analytic_sample_count);
  for (std::size_t k = 0; k < analytic_sample_count; ++k)
    EXPECT_TRUE(all_samples()[k].embeddable) << all_samples()[k].name;
  EXPECT_EQ(all_samples()[analytic_sample_count].name, "jellyfish") << "analytic ones come first";
  EXPECT_EQ(shapes().size(), all_samples().size());
}

TEST(Samples, the_snakes_of_medusa_are_thickened_around_spines_that_keep_apart) {
  EXPECT_FALSE(runs_through_itself(make_sample("medusa", 64, {{"thickness", 0.25}, {"push", 0}})));
  EXPECT_GT(make_sample("medusa", 240).view().face_count(), 430000U);
}

TEST(Samples, have_distinct_names_and_one_line_descriptions) {
  std::set<std::string> names;
  for (const Sample& sample : all_samples()) {
    EXPECT_TRUE(names.insert(sample.name).second) << sample.name;
    EXPECT_FALSE(sample.description.empty());
    EXPECT_EQ(sample.description.find('\n'), std::string::npos);
  }
}

TEST(Samples, name_the_valid_choices_when_refusing) {
  EXPECT_NE(message_of([] { make_sample("mobius"); }).find("mobius_extended"), std::string::npos);
  EXPECT_NE(message_of([] { make_sample("book", 0, {{"leaves", 3}}); }).find("pages"), std::string::npos);
  EXPECT_NE(message_of([] { make_sample("book", 0, {{"pages", 2.0}}); }).find("from 3 to 40"), std::string::npos);
  EXPECT_NE(message_of([] { make_sample("book", 0, {{"pages", 4.5}}); }).find("whole number"), std::string::npos);
  EXPECT_NE(message_of([] { make_sample("book", 7); }).find("from 8 to 2000"), std::string::npos);
  EXPECT_NE(message_of([] { make_sample("book", -1); }).find("from 8 to 2000"), std::string::npos);
  EXPECT_NE(message_of([] { make_sample("klein_bottle", 0, {{"x", 1}}); }).find("no parameters"), std::string::npos);
}

TEST(Samples, change_with_their_parameters) {
  EXPECT_EQ(shape_of(make_sample("pretzel", 40, {{"genus", 3}})).euler_characteristic, -4);
  EXPECT_EQ(shape_of(make_sample("perforated_fold", 90, {{"holes", 5}})).boundary_loops, 6U);
  EXPECT_TRUE(shape_of(make_sample("lemniscate_band", 0, {{"half_twists", 2}})).orientable);
  EXPECT_EQ(shape_of(make_sample("intersecting_spheres", 0, {{"count", 5}})).components, 5U);
  EXPECT_NE(make_sample("crumpled_sheet", 0, {{"seed", 2}}).positions, make_sample("crumpled_sheet").positions);
}

TEST(Samples, are_faced_outwards_where_they_are_closed_and_embedded) {
  // Far thinner than by default, so that the tube does not touch itself and its volume is known.
  const Surface tube = make_sample("figure_eight_knot_tube", 0, {{"radius", 0.1}});
  EXPECT_FALSE(runs_through_itself(tube));
  double volume = 0;
  for (const Triangle& t : triangulate(tube).triangles) {
    const auto p = [&](Index v) {
      return Vec3(tube.positions[3 * v], tube.positions[3 * v + 1], tube.positions[3 * v + 2]);
    };
    volume += p(t[0]).dot(p(t[1]).cross(p(t[2]))) / 6;
  }
  EXPECT_GT(volume, 0);
}

TEST(Samples, the_inverted_cylinder_collapses_to_exactly_one_point) {
  const Surface surface = make_sample("cylinder_inverted", 24);
  std::size_t at_origin = 0;
  for (std::size_t v = 0; v < surface.view().vertex_count(); ++v)
    at_origin +=
        surface.positions[3 * v] == 0 && surface.positions[3 * v + 1] == 0 && surface.positions[3 * v + 2] == 0 ? 1 : 0;
  EXPECT_EQ(at_origin, 24U);
}

}  // namespace
}  // namespace unsnarl
