#include "untangle/push_into_nesting.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/prepared_surface.h"
#include "unsnarl/parts.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

/// The components of a sample, the first inside the second.
struct Nested {
  explicit Nested(const Surface& surface) : prepared(prepare(surface, {})) {
    const std::vector<Triangle> triangles(prepared.triangles().begin(), prepared.triangles().end());
    const std::vector<std::int32_t> component_of = component_of_faces(surface);
    nested.surface_of_vertex.assign(prepared.rest.cols(), -1);
    nested.triangles.resize(3);
    nested.vertices.resize(3);
    nested.closed = {1, 1, 1};
    nested.pairs = {{0, 1}};
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      nested.triangles[component_of[t]].push_back(triangles[t]);
      for (const Index v : triangles[t]) nested.surface_of_vertex[v] = component_of[t];
    }
    for (Index v = 0; v < prepared.rest.cols(); ++v) nested.vertices[nested.surface_of_vertex[v]].push_back(v);
    scene = make_scene(prepared.rest, triangles, std::vector<std::uint8_t>(prepared.rest.cols(), 0));
  }
  PushResult push() {
    SceneIndex index(scene);
    return push_into_nesting(scene, index, nested.surface_of_vertex, nested);
  }
  std::size_t wrong() const { return vertices_on_the_wrong_side(nested, {0, 1}, scene.x).size(); }

  PreparedSurface prepared;
  NestedSurfaces nested;
  Scene scene;
};

TEST(PushIntoNesting, both_surfaces_give_way_until_none_is_on_the_wrong_side) {
  Nested shells(make_sample("crossing_shells", 28, {{"waves", 0}}));
  EXPECT_GT(shells.wrong(), 200u);
  const PushResult result = shells.push();
  EXPECT_EQ(shells.wrong(), 0u);
  double inner = 0, outer = 0;
  for (const Index v : result.moved) {
    const double motion = (shells.scene.x.col(v) - shells.scene.rest.col(v)).norm();
    double& most = shells.nested.surface_of_vertex[v] == 0 ? inner : outer;
    most = std::max(most, motion);
    ASSERT_NE(shells.nested.surface_of_vertex[v], 2);
  }
  // 0.55 apart at the deepest place.
  EXPECT_GT(inner, 0.2);
  EXPECT_GT(outer, 0.2);
  EXPECT_LT(std::max(inner, outer), 0.45);
}

TEST(PushIntoNesting, what_is_fixed_stays) {
  Nested shells(make_sample("crossing_shells", 28, {{"waves", 0}}));
  for (const Index v : shells.nested.vertices[1]) shells.scene.fixed[v] = 1;
  const PushResult result = shells.push();
  EXPECT_EQ(shells.wrong(), 0u);
  for (const Index v : result.moved) ASSERT_EQ(shells.nested.surface_of_vertex[v], 0);
}

TEST(PushIntoNesting, what_crosses_nothing_stays_on_the_wrong_side) {
  Nested shells(make_sample("crossing_shells", 28, {{"waves", 0}, {"shift", 0}}));
  shells.nested.pairs = {{1, 0}};
  EXPECT_TRUE(shells.push().moved.empty());
  EXPECT_EQ(shells.scene.x, shells.scene.rest);
}

}  // namespace
}  // namespace unsnarl
