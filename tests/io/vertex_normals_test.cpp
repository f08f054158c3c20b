#include "io/vertex_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "unsnarl/document.h"

namespace unsnarl {
namespace {

/// A strip of two squares in the plane z = 0; the second one can be folded up along their common side.
const Surface strip = {{0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0}, {0, 1, 4, 3, 1, 2, 5, 4}, {0, 4, 8}};

std::vector<double> folded_up() {
  std::vector<double> x = strip.positions;
  for (const std::size_t v : {2, 5}) {
    x[3 * v] = 1;
    x[3 * v + 2] = 1;
  }
  return x;
}

TEST(VertexNormals, smooth_ones_turn_half_as_far_and_flat_ones_all_the_way) {
  const std::vector<double> normals = {0, 0, 1, 0, 0, 2, 0, 0, -1};
  // The common side is smooth, the ends have normals of their own; the one of length 2 keeps it.
  const std::vector<double> turned = turned_normals(strip, folded_up(), normals, std::vector{0, 1, 1, 0, 1, 2, 2, 1});
  const double half = std::sqrt(2.0);
  for (const auto& [i, wanted] : {std::pair{0, 0.0},
                                  {1, 0.0},
                                  {2, 1.0},  // nothing moved
                                  {6, 1.0},
                                  {7, 0.0},
                                  {8, 0.0}})  // reversed, and stays so
    EXPECT_NEAR(turned[static_cast<std::size_t>(i)], wanted, 1e-15) << i;
  EXPECT_EQ(turned[3], 0) << "used by two vertices, and by the face that did not move: left as it is";
  const std::vector<double> smooth = turned_normals(strip, folded_up(), normals, std::vector{0, 1, -1, 0, 1, 2, 2, -1});
  EXPECT_NEAR(smooth[3], -half, 1e-15);
  EXPECT_NEAR(smooth[5], half, 1e-15);
}

TEST(VertexNormals, nothing_moves_nothing_turns) {
  const std::vector<double> normals = {0.1, 0.2, 0.7, NAN, 0, 0};
  const std::vector<double> same = turned_normals(strip, strip.positions, normals, std::vector{0, 1, 0, 1, 0, 1, 0, 1});
  EXPECT_EQ(std::memcmp(same.data(), normals.data(), 6 * sizeof(double)), 0);
  // A face that loses its area says nothing.
  std::vector<double> collapsed = strip.positions;
  for (const std::size_t v : {1, 2, 4, 5}) collapsed[3 * v] = 0;
  EXPECT_EQ(turned_normals(strip, collapsed, std::vector{0.0, 0.0, 1.0}, std::vector(8, 0)),
            (std::vector{0.0, 0.0, 1.0}));
}

std::string patched(const std::string& text, Format format, bool recompute) {
  Document document = Document::parse(text, format);
  if (recompute) {
    EXPECT_TRUE(document.recompute_normals());
  }
  std::vector<double> x = document.surface().positions;
  x[8] = 1;  // the third vertex is lifted
  return document.patched(x, true)[0].bytes;
}

TEST(VertexNormals, obj_tokens_change_only_where_asked_and_where_something_moved) {
  const std::string head = "v 0 0 0\nv 1 0 0\n",
                    tail = "v 5 0 0\nv 6 0 0\nv 5 1 0\nvn 0 0 1\nvn 0  0 1.0 # far\nvn x\n";
  const std::string faces = "f 1//1 2//1 3/7/1\nf 4//2 5//-2 6//3\n";
  const std::string text = head + "v 0 1 0\n" + tail + faces;
  EXPECT_EQ(patched(text, Format::obj, false), head + "v 0 1 1\n" + tail + faces);
  const std::string turned = patched(text, Format::obj, true);
  EXPECT_EQ(
      turned,
      head + "v 0 1 1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nvn 0 -0.70710677 0.70710677\nvn 0  0 1.0 # far\nvn x\n" + faces);
}

TEST(VertexNormals, ply_properties_of_vertices) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string text = header + "0 0 0 0 0 1 7\n1 0 0 0 0 1 7\n0 1 0 0 0 1 7\n9 9 9 0 0 1 7\n3 0 1 2\n";
  EXPECT_EQ(patched(text, Format::ply, false),
            header + "0 0 0 0 0 1 7\n1 0 0 0 0 1 7\n0 1 1 0 0 1 7\n9 9 9 0 0 1 7\n3 0 1 2\n");
  const std::string n = "0 -0.70710677 0.70710677 7\n";
  EXPECT_EQ(patched(text, Format::ply, true),
            header + "0 0 0 " + n + "1 0 0 " + n + "0 1 1 " + n + "9 9 9 0 0 1 7\n3 0 1 2\n");
}

TEST(VertexNormals, files_without_them_say_so) {
  EXPECT_FALSE(Document::parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Format::obj).recompute_normals());
  EXPECT_FALSE(Document::parse("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", Format::off).recompute_normals());
}

}  // namespace
}  // namespace unsnarl
