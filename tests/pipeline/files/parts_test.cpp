#include "unsnarl/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace unsnarl {
namespace {

using Flags = std::vector<std::uint8_t>;

/// Two squares of two triangles each, joined along a side that is written twice (vertices 1, 2 and 4, 5), and a
/// triangle by itself.
Document two_squares() {
  return Document::parse(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
      "v 1 0 0\nv 1 1 0\nv 2 1 0\nv 2 0 0\n"
      "v 9 0 0\nv 9 1 0\nv 8 0 0\n"
      "o body\ng left skin\nusemtl red\nf 1 2 3\nf 1 3 4\ng right skin\nusemtl blue\nf 5 8 7\nf 5 7 6\n"
      "o hat\ng hat\nf 9 10 11\n",
      Format::obj);
}

Flags faces(const Document& document, const Parts& parts) {
  return faces_in_parts(document.surface(), document.face_labels(), parts);
}

std::string complaint(const Document& document, const Parts& parts) {
  try {
    faces(document, parts);
  } catch (const UnknownPart& e) {
    return e.what();
  }
  return {};
}

TEST(Parts, names_mean_faces) {
  const Document document = two_squares();
  EXPECT_EQ(faces(document, {.groups = {"left skin"}}), (Flags{1, 1, 0, 0, 0}));
  EXPECT_EQ(faces(document, {.groups = {"right"}}), (Flags{0, 0, 1, 1, 0}));
  EXPECT_EQ(faces(document, {.groups = {"skin"}}), (Flags{1, 1, 1, 1, 0}));
  EXPECT_EQ(faces(document, {.objects = {"hat"}}), (Flags{0, 0, 0, 0, 1}));
  EXPECT_EQ(faces(document, {.materials = {"blue"}}), (Flags{0, 0, 1, 1, 1}));
  EXPECT_EQ(faces(document, {.groups = {"left", "hat"}}), (Flags{1, 1, 0, 0, 1}));
  EXPECT_EQ(faces(document, {.groups = {"left"}, .components = {1}}), (Flags{1, 1, 0, 0, 1}));
  EXPECT_EQ(faces(document, {}), Flags(5, 0));
}

TEST(Parts, all_names_are_listed_with_what_they_name) {
  const Document document = two_squares();
  std::vector<std::string> found;
  for (const NamedPart& part : named_parts(document.surface(), document.face_labels())) {
    found.push_back(std::string(to_string(part.kind)) + " " + part.name + " " + std::to_string(part.faces) + " " +
                    std::to_string(part.vertices));
  }
  EXPECT_EQ(found, (std::vector<std::string>{"object body 4 8", "object hat 1 3", "group left skin 2 4",
                                             "group right skin 2 4", "group hat 1 3", "material red 2 4",
                                             "material blue 3 7"}));
  // Nodes and meshes of a glTF are called what the options call them; a name without faces is there all the same.
  const Surface surface{std::vector<double>(9), {0, 1, 2, 0, 2, 1}, {}};
  const std::vector<FaceLabels> labels = {{"mesh", {"seat", "none"}, {-1, 0}}, {"node", {"chair"}, {0, 0}}};
  const std::vector<NamedPart> parts = named_parts(surface, labels);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].kind, NamedPart::Kind::object);
  EXPECT_EQ(parts[0].vertices, 3u);
  EXPECT_EQ(parts[1].kind, NamedPart::Kind::group);
  EXPECT_EQ(parts[2].faces, 0u);
}

TEST(Parts, each_face_knows_its_parts_as_options_name_them) {
  const Document document = two_squares();
  const std::vector<FaceLabels> parts = parts_of_faces(document.surface(), document.face_labels());
  ASSERT_EQ(parts.size(), 4u);
  const auto is = [](const FaceLabels& labels, const std::string& kind, const std::vector<std::string>& names,
                     const std::vector<std::int32_t>& of_face) {
    return labels.kind == kind && labels.names == names && labels.of_face == of_face;
  };
  EXPECT_TRUE(is(parts[0], "component", {}, {0, 0, 0, 0, 1}));
  EXPECT_TRUE(is(parts[1], "object", {"body", "hat"}, {0, 0, 0, 0, 1}));
  EXPECT_TRUE(is(parts[2], "group", {"left skin", "right skin", "hat"}, {0, 0, 1, 1, 2}));
  EXPECT_TRUE(is(parts[3], "material", {"red", "blue"}, {0, 0, 1, 1, 1}));
  const std::vector<FaceLabels> of_gltf = {{"node", {"chair"}, {0, 0, -1, -1, 0}},
                                           {"file", {"a.glb"}, {0, 0, 0, 0, 0}}};
  const std::vector<FaceLabels> renamed = parts_of_faces(document.surface(), of_gltf);
  ASSERT_EQ(renamed.size(), 2u);
  EXPECT_TRUE(is(renamed[1], "object", {"chair"}, {0, 0, -1, -1, 0}));
}

TEST(Parts, components_are_counted_after_welding) {
  const Document document = two_squares();
  EXPECT_EQ(component_of_faces(document.surface()), (std::vector<std::int32_t>{0, 0, 0, 0, 1}));
  EXPECT_EQ(component_of_faces(document.surface(), {.weld = Weld::none}), (std::vector<std::int32_t>{0, 0, 1, 1, 2}));
}

TEST(Parts, what_does_not_exist_is_refused_with_the_list_of_what_does) {
  const Document document = two_squares();
  const std::string group = complaint(document, {.groups = {"lefty"}});
  EXPECT_NE(group.find("no group 'lefty'"), std::string::npos) << group;
  EXPECT_NE(group.find("'left skin', 'right skin', 'hat'"), std::string::npos) << group;
  EXPECT_NE(complaint(document, {.objects = {"left"}}).find("'body', 'hat'"), std::string::npos);
  EXPECT_NE(complaint(document, {.materials = {""}}).find("'red', 'blue'"), std::string::npos);
  EXPECT_NE(complaint(document, {.components = {2}}).find("the mesh has 2"), std::string::npos);
  EXPECT_NE(complaint(document, {.components = {-1}}).find("-1"), std::string::npos);
  const Document bare = Document::parse("usemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Format::obj);
  EXPECT_EQ(complaint(bare, {.groups = {"x"}}), "there is no group 'x': the file names no groups, only materials");
}

TEST(Parts, gltf_nodes_are_objects_and_meshes_are_groups) {
  const std::vector<FaceLabels> labels = {
      {"node", {"chair"}, {0, -1}}, {"mesh", {"seat"}, {-1, 0}}, {"material", {"wood"}, {0, 0}}};
  const Surface surface{std::vector<double>(9), {0, 1, 2, 0, 2, 1}, {}};
  EXPECT_EQ(faces_in_parts(surface, labels, {.objects = {"chair"}}), (Flags{1, 0}));
  EXPECT_EQ(faces_in_parts(surface, labels, {.groups = {"seat"}}), (Flags{0, 1}));
  EXPECT_EQ(faces_in_parts(surface, labels, {.materials = {"wood"}}), (Flags{1, 1}));
  EXPECT_THROW(faces_in_parts(surface, labels, {.objects = {"seat"}}), UnknownPart);
}

TEST(Parts, vertices_of_faces) {
  const Document document = two_squares();
  EXPECT_EQ(vertices_of_faces(document.surface(), Flags{0, 1, 0, 0, 0}), (Flags{1, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Parts, seams_are_no_boundary) {
  // A square of four triangles around a middle, in two halves with corners of their own.
  const Document document = Document::parse(
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nv 0 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0\nv 5 5 5\n"
      "f 1 2 4\nf 2 3 4\nf 6 7 8\nf 7 5 8\n",
      Format::obj);
  EXPECT_EQ(boundary_vertices(document.surface()), (Flags{1, 1, 1, 0, 1, 1, 1, 0, 0}));
  EXPECT_EQ(boundary_vertices(document.surface(), {.weld = Weld::none}), (Flags{1, 1, 1, 1, 1, 1, 1, 1, 0}));
}

AllowedPairs allowed(const Document& document, const std::vector<std::string>& rules) {
  return allowed_pairs(document.surface(), document.face_labels(), rules);
}

/// For each two of the five faces, one row after another: whether they may pass through each other.
std::string passing_faces(const AllowedPairs& allowed) {
  std::string rows;
  for (std::size_t f = 0; f < allowed.part_of_face.size(); ++f, rows += ' ')
    for (std::size_t g = 0; g < allowed.part_of_face.size(); ++g) {
      const std::int32_t p = allowed.part_of_face[f], q = allowed.part_of_face[g];
      rows += std::any_of(
                  allowed.parts.begin(), allowed.parts.end(),
                  [&](const auto& pair) { return (pair[0] == p && pair[1] == q) || (pair[0] == q && pair[1] == p); })
                  ? '1'
                  : '0';
    }
  return rows;
}

TEST(AllowedPairs, rules_name_parts_of_any_kind) {
  const Document document = two_squares();
  EXPECT_TRUE(allowed(document, {}).empty());
  const std::string body_and_hat = "00001 00001 00001 00001 11110 ";
  for (const char* rule :
       {"body:hat", "hat:body", "object=body:hat", "body:group=hat", "0:1", "component=0:component=1"})
    EXPECT_EQ(passing_faces(allowed(document, {rule})), body_and_hat) << rule;
  EXPECT_EQ(passing_faces(allowed(document, {"red:blue"})), "00111 00111 11000 11000 11000 ");
  EXPECT_EQ(passing_faces(allowed(document, {"left"})), "11000 11000 00000 00000 00000 ");
  // Parts that have faces in common: each rule for itself, none more than it says.
  EXPECT_EQ(passing_faces(allowed(document, {"left:hat", "material=blue"})), "00001 00001 00111 00111 11111 ");
}

std::string complaint(const Document& document, const std::string& rule) {
  try {
    allowed(document, {rule});
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return {};
}

TEST(AllowedPairs, what_does_not_exist_or_has_two_meanings_is_refused) {
  const Document document = two_squares();
  EXPECT_NE(complaint(document, "body:head").find("there is no part 'head'; there are: objects 'body', 'hat'; groups "),
            std::string::npos)
      << complaint(document, "body:head");
  EXPECT_NE(complaint(document, "object=skin").find("there is no object 'skin'"), std::string::npos);
  EXPECT_NE(complaint(document, "component=5").find("there is no component 5"), std::string::npos);
  EXPECT_NE(complaint(document, "component=x").find("is not the number of a component"), std::string::npos);
  const Document twice = Document::parse(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\no a\nusemtl b\nf 1 2 3\no b\nusemtl a\nf 1 3 2\no a:b\nusemtl c\nf 2 1 3\n",
      Format::obj);
  EXPECT_NE(complaint(twice, "a").find("'a' is the name of several parts; say which, as in object=a or material=a"),
            std::string::npos)
      << complaint(twice, "a");
  EXPECT_EQ(complaint(twice, "object=a:material=b"), "");
  EXPECT_EQ(complaint(twice, "object=a:object=b"), "");
  const Document colon =
      Document::parse("v 0 0 0\nv 1 0 0\nv 1 1 0\no x\nf 1 2 3\no y\nf 1 3 2\no x:y\nf 2 1 3\n", Format::obj);
  EXPECT_NE(complaint(colon, "x:y").find("'x:y' can be read in 2 ways"), std::string::npos) << complaint(colon, "x:y");
  EXPECT_EQ(complaint(colon, "object=x:object=y"), "");
}

TEST(AllowedPairs, names_may_hold_colons) {
  const Document document = Document::parse(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\no rig:body\nf 1 2 3\no rig:coat\nf 1 3 2\no hat\nf 2 1 3\n", Format::obj);
  const auto passing = [&](const std::string& rule) { return passing_faces(allowed(document, {rule})); };
  EXPECT_EQ(passing("rig:body:rig:coat"), "010 100 000 ");
  EXPECT_EQ(passing("rig:body"), "100 000 000 ");
  EXPECT_EQ(passing("hat:rig:coat"), "000 001 010 ");
}

}  // namespace
}  // namespace unsnarl
