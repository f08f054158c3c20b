#include "render/page_appearance.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

/// Two quads and a triangle; vertices 0 to 5.
const Surface two_quads = {std::vector<double>(18), {0, 1, 2, 3, 1, 4, 5, 2, 0, 1, 4}, {0, 4, 8, 11}};
const PageTriangles quad_triangles = {{0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2, 0, 1, 4}, {0, 0, 1, 1, 2}};

Appearance painted() {
  Appearance appearance;
  appearance.images = {{"a", "image/png", "\x01\x02", 3, 4}};
  appearance.materials = {{.colour = {1, 1, 1}, .image = 0, .wrap_v = Appearance::Wrap::clamp}, {.colour = {1, 0, 0}}};
  appearance.material_of_face = {0, 0, 1};
  // Vertex 1 has another place in the second face, vertex 2 the same.
  appearance.uv_of_corner = {0, 0, 0.5f, 0, 0.5f, 1, 0, 1, 0.25f, 0, 1, 0, 1, 1, 0.5f, 1, 9, 9, 9, 9, 9, 9};
  return appearance;
}

TEST(PageAppearance, vertices_with_several_places_are_copied) {
  const TextureVertices vertices = texture_vertices(painted(), two_quads, quad_triangles);
  EXPECT_EQ(vertices.copies, std::vector<Index>{1});
  EXPECT_EQ(vertices.triangles, (std::vector<Index>{0, 1, 2, 0, 2, 3, 6, 4, 5, 6, 5, 2, 0, 1, 4}));
  EXPECT_EQ(vertices.uv, (std::vector<float>{0, 0, 0.5f, 0, 0.5f, 1, 0, 1, 1, 0, 1, 1, 0.25f, 0}));
}

TEST(PageAppearance, puts_images_materials_and_coordinates_into_the_page) {
  PageElements elements;
  const Json described = add_appearance(painted(), two_quads, quad_triangles, elements);
  EXPECT_EQ(described["images"], Json({{{"name", "a"}, {"media_type", "image/png"}, {"width", 3}, {"height", 4}}}));
  EXPECT_EQ(described["materials"][0]["wrap"], Json({"repeat", "clamp"}));
  EXPECT_EQ(described["materials"][1]["colour"], Json({1.0, 0.0, 0.0}));
  EXPECT_NE(elements.html().find("id=\"image_0\">AQI=</script>"), std::string::npos);
  for (const char* id : {"face_materials", "texture_uv", "texture_copies", "texture_triangles"})
    EXPECT_NE(elements.html().find('"' + std::string(id) + '"'), std::string::npos) << id;
}

TEST(PageAppearance, without_seams_the_triangles_are_those_of_the_page) {
  Appearance appearance = painted();
  appearance.uv_of_corner[8] = 0.5f;
  PageElements elements;
  add_appearance(appearance, two_quads, quad_triangles, elements);
  EXPECT_EQ(elements.html().find("texture_triangles"), std::string::npos);
  EXPECT_EQ(elements.html().find("texture_copies"), std::string::npos);
}

TEST(PageAppearance, what_is_not_worth_showing_leaves_its_notes) {
  Appearance appearance;
  appearance.notes = {"Image x is left out."};
  PageElements elements;
  const Json described = add_appearance(appearance, two_quads, quad_triangles, elements);
  EXPECT_EQ(described,
            Json({{"images", Json::array()}, {"materials", Json::array()}, {"notes", {"Image x is left out."}}}));
  EXPECT_EQ(elements.html(), "");
}

}  // namespace
}  // namespace unsnarl
