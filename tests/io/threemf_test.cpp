#include "archives.h"
#include "document_checks.h"
#include "io/zip_archive.h"

namespace unsnarl::threemf_files {
namespace {

const std::string relations =
    "<?xml version=\"1.0\"?><Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" Target=\"/3D/my.model\" "
    "Id=\"a\"/>"
    "</Relationships>";
const std::string mesh =
    "<mesh><vertices>\n<vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"4.000\" y=\"0\" z=\"0\" />\n"
    "<vertex z=\"0\" y='4' x=\"0\"/><vertex x=\"0\" y=\"0\" z=\" 4.25 \"/></vertices>\n<triangles>"
    "<triangle v1=\"0\" v2=\"2\" v3=\"1\" pid=\"3\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
    "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"0\" v2=\"3\" v3=\"2\"/></triangles></mesh>";
const std::string before =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources>\n";
const std::string plain = before + "<object id=\"1\" type=\"model\" name=\"bolt\">" + mesh +
                          "</object></resources>\n<build><item objectid=\"1\"/></build></model>\n";
const std::string placed =
    before + "<object id=\"1\" name=\"bolt\">" + mesh + "</object>\n<object id=\"7\" name=\"nut\">" + mesh +
    "</object>\n<object id=\"8\">" + mesh +
    "</object>\n<object id=\"9\"><components><component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 10 0 0\"/>"
    "<component objectid=\"7\"/></components></object></resources>\n<build>"
    "<item objectid=\"9\" transform=\"0 2 0 -2 0 0 0 0 2 0 0 5\"/><item objectid=\"7\"/></build></model>\n";

std::string package(const std::string& model, bool is_compressed = true) {
  return zip_of({{"[Content_Types].xml", "<Types/>"},
                 {"_rels/.rels", relations},
                 {"3D/my.model", model},
                 {"Metadata/thumbnail.png", "\x89PNG"}},
                is_compressed);
}
std::string model_of(const std::string& bytes) {
  return *ZipArchive(bytes).content("3D/my.model");
}

TEST(Threemf, reads_the_objects_of_the_build) {
  const Document document = Document::parse(package(plain), Format::threemf);
  EXPECT_EQ(document.surface().positions, (std::vector<double>{0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4.25}));
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}));
  EXPECT_EQ(document.face_labels().at(0).kind, "object");
  EXPECT_EQ(document.face_labels().at(0).names, (std::vector<std::string>{"bolt"}));
  EXPECT_TRUE(document.notes().empty());
}

TEST(Threemf, objects_stand_where_the_build_shows_them) {
  const Document document = Document::parse(package(placed), Format::threemf);
  const std::vector<double>& x = document.surface().positions;
  ASSERT_EQ(x.size(), 24u);
  // (4, 0, 0) of the first, moved by the component and turned by the item.
  EXPECT_EQ((std::vector<double>{x[3], x[4], x[5]}), (std::vector<double>{0, 28, 5}));
  EXPECT_EQ((std::vector<double>{x[18], x[19], x[20]}), (std::vector<double>{-8, 0, 5}));
  EXPECT_EQ(document.notes().at(0), "Objects that the build does not show (1) stay as they are.");
  EXPECT_PRED2(message_contains, document.notes().at(1), "Objects that the build shows several times (1)");
}

TEST(Threemf, keeps_every_promise_of_patching) {
  for (const bool is_compressed : {false, true}) {
    check_patching(package(plain, is_compressed), Format::threemf);
    check_patching(package(placed, is_compressed), Format::threemf);
  }
}

TEST(Threemf, only_the_moved_coordinate_of_the_model_changes) {
  const std::string bytes = package(plain);
  const Document document = Document::parse(bytes, Format::threemf);
  std::vector<double> moved = document.surface().positions;
  moved[11] = 0.1;
  const std::string patched = patched_bytes(document, moved);
  EXPECT_EQ(model_of(patched), replaced(plain, " 4.25 ", " 0.1 "));
  EXPECT_EQ(ZipArchive(patched).content("Metadata/thumbnail.png"), "\x89PNG");
  EXPECT_EQ(patched.substr(0, bytes.find("3D/my.model") - 30), bytes.substr(0, bytes.find("3D/my.model") - 30));
}

/// As Bambu Studio writes them: meshes in parts of their own, which the root model refers to, and names beside them.
const std::string production_model =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" "
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
    "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" requiredextensions=\"p\">\n"
    " <metadata name=\"Application\">BambuStudio-01.09.00.00</metadata>\n <resources>\n"
    "  <object id=\"4\" p:UUID=\"00000004-61cb-4c03-9d28-80fed5dfa1dc\" type=\"model\">\n   <components>\n"
    "    <component p:path=\"/3D/Objects/object_1.model\" objectid=\"1\" p:UUID=\"a\" "
    "transform=\"1 0 0 0 1 0 0 0 1 0 0 0\"/>\n"
    "    <component p:path=\"/3D/Objects/object_1.model\" objectid=\"2\" p:UUID=\"b\" "
    "transform=\"1 0 0 0 1 0 0 0 1 10 0 0\"/>\n"
    "    <component p:path=\"/3D/Objects/object_1.model\" objectid=\"3\" p:UUID=\"c\"/>\n"
    "   </components>\n  </object>\n"
    "  <object id=\"6\" type=\"model\"><components>\n"
    "    <component p:path=\"/3d/objects/object_2.model\" objectid=\"1\"/></components></object>\n </resources>\n"
    " <build p:UUID=\"d\">\n  <item objectid=\"4\" p:UUID=\"e\" transform=\"1 0 0 0 1 0 0 0 1 128 128 5\" "
    "printable=\"1\"/>\n  <item objectid=\"6\"/><item objectid=\"6\" transform=\"1 0 0 0 1 0 0 0 1 9 9 9\"/>\n"
    " </build>\n</model>\n";
const std::string object_1 =
    before + "<object id=\"1\" type=\"model\">" + mesh + "</object><object id=\"2\" type=\"model\">" + mesh +
    "</object><object id=\"3\" type=\"other\">" + mesh + "</object></resources>\n<build/></model>\n";
const std::string object_2 =
    before + "<object id=\"1\" type=\"model\">" + mesh + "</object></resources><build/></model>";
const std::string settings =
    "<?xml version=\"1.0\"?>\n<config><object id=\"4\"><metadata key=\"name\" value=\"lamp\"/>"
    "<part id=\"1\" subtype=\"normal_part\"><metadata key=\"name\" value=\"foot\"/></part>"
    "<part id=\"2\" subtype=\"normal_part\"><metadata key=\"name\" value=\"shade &amp; "
    "arm\"/></part></object></config>";

std::string production_package(const std::string& model = production_model, const std::string& first = object_1) {
  return zip_of({{"_rels/.rels", relations},
                 {"3D/my.model", model},
                 {"3D/Objects/object_1.model", first},
                 {"3D/Objects/object_2.model", object_2},
                 {"Metadata/model_settings.config", settings},
                 {"Metadata/plate_1.png", "\x89PNG"}},
                true);
}

TEST(Threemf, reads_objects_in_other_parts_of_the_archive) {
  const Document document = Document::parse(production_package(), Format::threemf);
  const std::vector<double>& x = document.surface().positions;
  ASSERT_EQ(x.size(), 36u) << "the modifier is left out";
  EXPECT_EQ((std::vector<double>{x[3], x[4], x[5]}), (std::vector<double>{132, 128, 5}));
  EXPECT_EQ((std::vector<double>{x[15], x[16], x[17]}), (std::vector<double>{142, 128, 5}));
  EXPECT_EQ((std::vector<double>{x[27], x[28], x[29]}), (std::vector<double>{4, 0, 0}));
  EXPECT_EQ(document.face_labels().at(0).names, (std::vector<std::string>{"foot", "shade & arm", "object 1"}));
  ASSERT_EQ(document.notes().size(), 2u);
  EXPECT_PRED2(message_contains, document.notes()[0], "Objects that are not printed (modifiers, supports: 1)");
  EXPECT_PRED2(message_contains, document.notes()[1], "Objects that the build shows several times (1)");
}

TEST(Threemf, patches_every_part_of_the_archive_and_nothing_else) {
  check_patching(production_package(), Format::threemf);
  const Document document = Document::parse(production_package(), Format::threemf);
  std::vector<double> moved = document.surface().positions;
  moved[11] = 5.5;
  moved[35] = 0.5;
  const std::string patched = patched_bytes(document, moved);
  const ZipArchive archive(patched);
  EXPECT_EQ(archive.content("3D/my.model"), production_model);
  std::string first = object_1;
  EXPECT_EQ(archive.content("3D/Objects/object_1.model"), first.replace(first.find(" 4.25 "), 6, " 0.5 "));
  EXPECT_EQ(archive.content("3D/Objects/object_2.model"), replaced(object_2, " 4.25 ", " 0.5 "));
  EXPECT_EQ(archive.content("Metadata/model_settings.config"), settings);
}

TEST(Threemf, errors_in_other_parts_name_them) {
  const auto error = [](const std::string& model, const std::string& first) {
    return parse_error(production_package(model, first), Format::threemf);
  };
  EXPECT_PRED2(message_contains, error(production_model, "<model"),
               "3D/Objects/object_1.model, line 1: this is not XML");
  EXPECT_PRED2(message_contains, error(production_model, replaced(object_2, "4.25", "x")),
               "3D/Objects/object_1.model, line 6: coordinate 'x' of vertex 3 is not a number");
  EXPECT_PRED2(message_contains, error(replaced(production_model, "object_2", "object_9"), object_1),
               "3D/my.model, line 13: the archive has no part '3d/objects/object_9.model'");
  EXPECT_PRED2(message_contains, error(production_model, object_2), "3D/my.model, line 8: there is no object 2");
  const std::string refers =
      before + "<object id=\"1\"><components><component p:path=\"/3D/Objects/object_2.model\" objectid=\"1\"/>" +
      "</components></object></resources><build/></model>";
  EXPECT_PRED2(message_contains, error(production_model, refers),
               "3D/Objects/object_1.model, line 4: only the root model may refer to other parts");
}

TEST(Threemf, errors_say_what_and_where) {
  const auto error = [](const std::string& model) { return parse_error(package(model), Format::threemf); };
  EXPECT_PARSE_ERROR("", Format::threemf, "empty");
  EXPECT_PARSE_ERROR("v 0 0 0\n", Format::threemf, "this is not a ZIP archive");
  EXPECT_PARSE_ERROR(package(plain).substr(0, 300), Format::threemf, "this is not a ZIP archive");
  EXPECT_PARSE_ERROR(zip_of({{"a", "b"}}, true), Format::threemf, "the archive has no '3D/3dmodel.model'");
  EXPECT_PRED2(message_contains, error("<model"), "3D/my.model, line 1: this is not XML");
  EXPECT_PRED2(message_contains, error(replaced(plain, "4.25", "x")),
               "3D/my.model, line 6: coordinate 'x' of vertex 3 is not a number");
  EXPECT_PRED2(message_contains, error(replaced(plain, " 4.25 ", "1 2")), "more than a number as 'z'");
  EXPECT_PRED2(message_contains, error(replaced(plain, " z=\" 4.25 \"", "")),
               "vertex 3 has fewer than three coordinates");
  EXPECT_PRED2(message_contains, error(replaced(plain, "v3=\"2\"", "v3=\"4\"")),
               "triangle 3 of 'bolt' uses vertex '4', but there are 4");
  EXPECT_PRED2(message_contains, error(replaced(plain, "objectid=\"1\"", "objectid=\"2\"")), "there is no object 2");
  EXPECT_PRED2(message_contains, error(replaced(plain, "<item objectid=\"1\"/>", "")), "the build shows no object");
  EXPECT_PRED2(message_contains, error(replaced(plain, "<item ", "<item p:path=\"/3D/other.model\" ")),
               "the archive has no part '3D/other.model'");
  EXPECT_PRED2(message_contains, error(replaced(plain, "<item ", "<item transform=\"1 2\" ")),
               "a transform should be 12 numbers");
  EXPECT_PRED2(message_contains, error(replaced(placed, "0 2 0 -2 0 0", "0 2 0 0 2 0")), "makes the object flat");
  EXPECT_PRED2(message_contains, error(replaced(placed, "<component objectid=\"7\"/>", "<component objectid=\"9\"/>")),
               "within themselves");
}

TEST(Threemf, components_that_double_end_soon) {
  std::string objects = "<object id=\"0\">" + mesh + "</object>";
  for (int i = 1; i <= 60; ++i) {
    const std::string component = "<component objectid=\"" + std::to_string(i - 1) + "\"/>";
    objects +=
        "<object id=\"" + std::to_string(i) + "\"><components>" + component + component + "</components></object>";
  }
  const std::string bomb = before + objects + "</resources><build><item objectid=\"60\"/></build></model>";
  EXPECT_PARSE_ERROR(package(bomb), Format::threemf, "show more objects than can be read");
}

TEST(Threemf, what_unpacks_to_a_thousand_times_its_size_is_refused) {
  const std::string padded = replaced(plain, "</model>", std::string(65'000'000, ' ') + "</model>");
  EXPECT_PARSE_ERROR(package(padded), Format::threemf, "it would unpack to 65 MB");
  const std::string less = replaced(plain, "</model>", std::string(1'000'000, ' ') + "</model>");
  EXPECT_EQ(Document::parse(package(less), Format::threemf).surface().positions.size(), 12u);
}

TEST(Threemf, survives_damage) {
  check_damage(package(plain), Format::threemf);
  check_damage(package(placed, false), Format::threemf);
  check_damage(production_package(), Format::threemf);
}

}  // namespace
}  // namespace unsnarl::threemf_files
