#include "render/page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "render/packed_words.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

const std::string page_template = "<body>$&<!--unsnarl-data--></body>";

/// A quad and a triangle, around (11, 21, 31) with a diagonal of 2.
const Surface surface = {
    {10, 20, 31, 12, 20, 31, 12, 22, 31, 10, 22, 31, 11, 21, 31}, {0, 1, 2, 3, 0, 1, 4}, {0, 4, 7}};

PageContent content_of(const Surface& surface) {
  PageContent content;
  content.faces = surface;
  content.before.positions = surface.positions;
  return content;
}

/// What stands between the tags of the element with this id; empty: there is none.
std::string text_of(const std::string& page, const std::string& id) {
  const std::size_t at = page.find(" id=\"" + id + '"');
  if (at == std::string::npos) return {};
  const std::size_t begin = page.find('>', at) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

template <class Word>
std::string packed(const std::vector<Word>& words, std::size_t stride) {
  return pack_words(std::span<const Word>(words), {.stride = stride, .like = {}});
}

TEST(Page, is_the_template_with_the_data_in_its_place) {
  const std::string page = make_page(page_template, content_of(surface));
  EXPECT_EQ(page.rfind("<body>$&<script", 0), 0u);
  EXPECT_EQ(page.substr(page.size() - 17), "</script>\n</body>");
  EXPECT_EQ(page.find("<!--unsnarl-data-->"), std::string::npos);
  EXPECT_THROW(make_page("<body></body>", content_of(surface)), std::invalid_argument);
}

TEST(Page, names_cannot_leave_their_element) {
  PageContent content = content_of(surface);
  content.input_name = "</script><script>alert(1)</script><!-- \xff\xfe \" \\ \n";
  content.report = {{"note", "</SCRIPT>"}};
  const std::string page = make_page(page_template, content);
  const std::string text = text_of(page, "scene");
  EXPECT_EQ(text.find('<'), std::string::npos);
  const Json scene = Json::parse(text);
  EXPECT_EQ(scene["input"].get<std::string>().rfind("</script><script>alert(1)</script><!-- ", 0), 0u);
  EXPECT_EQ(scene["report"]["note"], "</SCRIPT>");
}

TEST(Page, positions_are_relative_to_the_middle_in_units_of_the_diagonal) {
  const std::string page = make_page(page_template, content_of(surface));
  const float a = static_cast<float>(-1 / std::sqrt(8.0));
  EXPECT_EQ(text_of(page, "positions_before"), packed<float>({a, a, 0, -a, a, 0, -a, -a, 0, a, -a, 0, 0, 0, 0}, 3));
  const Json scene = Json::parse(text_of(page, "scene"));
  EXPECT_EQ(scene["diagonal"], std::sqrt(8.0));
  EXPECT_EQ(scene["centre"], Json({11, 21, 31}));
}

TEST(Page, is_the_same_at_any_power_of_two) {
  Surface moved = surface;
  moved.positions[0] -= 0.25;
  const auto page_at = [&](int exponent) {
    Surface before = surface, after = moved;
    for (Surface* s : {&before, &after})
      for (double& x : s->positions) x = std::ldexp(x, exponent);
    PageContent content = content_of(before);
    content.before.curves = {{Vec3(before.positions[0], before.positions[1], before.positions[2]), Vec3::Zero()}};
    content.after.emplace().positions = after.positions;
    return make_page(page_template, content);
  };
  const std::string usual = page_at(0);
  for (const int exponent : {-900, -300, 300, 900}) {
    const std::string page = page_at(exponent);
    for (const char* list : {"positions_before", "positions_after", "displacement", "curves_before"})
      EXPECT_EQ(text_of(page, list), text_of(usual, list)) << list << " at 2^" << exponent;
    EXPECT_EQ(Json::parse(text_of(page, "scene"))["diagonal"], std::ldexp(std::sqrt(8.0), exponent));
  }
}

TEST(Page, polygons_come_with_the_triangles_that_draw_them) {
  const std::string page = make_page(page_template, content_of(surface));
  EXPECT_EQ(text_of(page, "corners"), packed<Index>({0, 1, 2, 3, 0, 1, 4}, 4));
  EXPECT_EQ(text_of(page, "sizes"), packed<Index>({4, 3}, 1));
  EXPECT_EQ(text_of(page, "triangles"), packed<Index>({0, 1, 2, 0, 2, 3, 0, 1, 4}, 6));
  EXPECT_EQ(text_of(page, "triangle_faces"), packed<Index>({0, 0, 1}, 1));
  const std::string plain = make_page(page_template, content_of({surface.positions, {0, 1, 2}, {}}));
  EXPECT_EQ(text_of(plain, "sizes"), "");
  EXPECT_EQ(text_of(plain, "triangles"), "");
}

TEST(Page, displacement_comes_from_doubles) {
  PageContent content = content_of(surface);
  std::vector<double> moved = surface.positions;
  moved[0] += 1e-12;  // far below what a float of the position holds
  content.after = PageState{moved, {}, {}};
  const std::string page = make_page(page_template, content);
  EXPECT_EQ(text_of(page, "displacement"),
            packed<float>({static_cast<float>((moved[0] - 10) / std::sqrt(8.0)), 0, 0, 0, 0}, 1));
  EXPECT_NE(text_of(page, "positions_after"), "");
  EXPECT_EQ(text_of(make_page(page_template, content_of(surface)), "positions_after"), "");
}

TEST(Page, pairs_and_curves_of_both_states) {
  PageContent content = content_of(surface);
  const std::vector<IntersectingPair> pairs = {{0, 1, PairClass::one_vertex}};
  content.before.pairs = pairs;
  content.before.curves = {{Vec3(11, 21, 31), Vec3(11, 21, 31 + std::sqrt(8.0))}};
  const std::string page = make_page(page_template, content);
  EXPECT_EQ(text_of(page, "pairs_before"), packed<Index>({0, 1, 1}, 3));
  EXPECT_EQ(text_of(page, "curves_before"), packed<float>({0, 0, 0, 0, 0, 1}, 3));
}

TEST(Page, parts_of_each_face) {
  PageContent content = content_of(surface);
  content.parts = {{"component", {}, {0, 0}}, {"object", {"</b>", "hat"}, {1, -1}}};
  const std::string page = make_page(page_template, content);
  EXPECT_EQ(Json::parse(text_of(page, "scene"))["parts"], Json({{{"kind", "component"}, {"names", Json::array()}},
                                                                {{"kind", "object"}, {"names", {"</b>", "hat"}}}}));
  EXPECT_EQ(text_of(page, "part_faces_0"), packed<Index>({0, 0}, 1));
  EXPECT_EQ(text_of(page, "part_faces_1"), packed<Index>({1, -1}, 1));
}

TEST(Page, recorded_frames_end_to_end) {
  PageContent content = content_of(surface);
  std::vector<RecordedFrame> frames(2);
  frames[0] = {"input", "", 0, 7, 0, {0, 1}, {}, {}};
  frames[1] = {"untangle", "slide", 3, 2, 4, {1}, {2, 4}, {std::sqrt(8.0), 0, 0, 0, 0, -std::sqrt(2.0)}};
  content.frames = frames;
  const std::string page = make_page(page_template, content);
  EXPECT_EQ(Json::parse(text_of(page, "scene"))["frames"][1], Json({{"phase", "untangle"},
                                                                    {"strategy", "slide"},
                                                                    {"iteration", 3},
                                                                    {"pairs", 2},
                                                                    {"allowed", 4},
                                                                    {"moved", 2},
                                                                    {"faces", 1}}));
  EXPECT_EQ(text_of(page, "frame_vertices"), packed<Index>({2, 4}, 1));
  EXPECT_EQ(text_of(page, "frame_displacements"), packed<float>({1, 0, 0, 0, 0, -0.5}, 3));
  EXPECT_EQ(text_of(page, "frame_faces"), packed<Index>({0, 1, 1}, 1));
}

TEST(Page, an_empty_mesh_has_a_page) {
  EXPECT_NE(make_page(page_template, content_of({})).find("\"vertices\":0"), std::string::npos);
}

}  // namespace
}  // namespace unsnarl
