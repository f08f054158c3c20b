#include "scene/topology.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"

namespace unsnarl {
namespace {

using namespace shapes;

TEST(Topology, of_a_soup_with_defects) {
  Surface s = exploded(cube());
  const Index a = add_vertex(s, 5, 5, 5), b = add_vertex(s, 6, 6, 6), c = add_vertex(s, 7, 7, 7);
  add_vertex(s, 9, 9, 9);  // unused
  add_face(s, {a, b, c});  // no area
  add_face(s, {c, b, a});  // and a duplicate
  const WeldMap id = weld(s);
  const Triangulation cut = triangulate(s, id.vertex_of);
  const EdgeTable edges = build_edges(cut.triangles);
  const Topology topology = describe_topology(s, id, cut, edges, find_components(s, id, cut.triangles, edges));
  EXPECT_EQ(topology.vertices, 12u);
  EXPECT_EQ(topology.faces, 8u);
  EXPECT_EQ(topology.triangles, 14u);
  EXPECT_EQ(topology.components, 2u);
  EXPECT_EQ(topology.boundary_edges, 0u);
  EXPECT_EQ(topology.non_manifold_edges, 0u);
  EXPECT_EQ(topology.duplicate_faces, 1u);
  EXPECT_EQ(topology.zero_area_faces, 2u);
  EXPECT_EQ(topology.duplicate_vertices, 16u);
  EXPECT_EQ(topology.unused_vertices, 1u);
  EXPECT_EQ(topology.closed_components, 2u);
  EXPECT_EQ(topology.non_orientable_components, 0u);
}

}  // namespace
}  // namespace unsnarl
