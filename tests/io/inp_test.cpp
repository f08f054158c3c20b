#include "document_checks.h"

namespace unsnarl::inp_files {
namespace {

const std::vector<double> positions = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4.25, 7, 7, 7};
const std::vector<std::int32_t> corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4};

const std::string flat =
    "*Heading\n a title, with 1, 2, 3\n** a comment\n*NODE, NSET=all\n 10, 0., 0., 0.\n20, 4.000 ,0,0\n5,0,4.,0,\n"
    "7, 0, 0, 4.25, 1., 0., 0.\n99,7,7,7\n"
    "*Element, type=S3, elset=left\n1, 10, 5, 20\n2, 10, 20, 7\n*ELEMENT, TYPE=S3R,\n ELSET=right\n3, 20, 5,\n 7\n"
    "*Element,type = s4r , elset=right\n4, 10, 7, 5, 99\n*Element, type=C3D4\n5, 10, 20, 5, 7\n"
    "*Element, type=B31\n6, 10, 20\n*Nset, nset=a\n10, 20\n*STEP\n*NODE OUTPUT\nU, RF\n*End Step\n";

const std::string parts =
    "*Part, name=first\n*Element, type=S3, elset=e\n1, 1, 2, 3\n*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n*End Part\n"
    "*Part, name=second\n*Node\n1, 0, 0, 5\n2, 1, 0, 5\n3, 0, 1, 5\n*Element, type=S3\n1, 3, 2, 1\n*End Part\n"
    "*Assembly, name=a\n*Instance, name=i, part=first\n*End Instance\n*Instance, name=j, part=second\n*End Instance\n"
    "*Node\n1, 9, 9, 9\n*End Assembly\n";

TEST(Inp, reads_nodes_and_shells) {
  const Document document = Document::parse(flat, Format::inp);
  EXPECT_EQ(document.surface().positions, positions);
  EXPECT_EQ(document.surface().corners, corners);
  EXPECT_EQ(document.surface().offsets, (std::vector<std::int32_t>{0, 3, 6, 9, 13}));
  ASSERT_EQ(document.face_labels().size(), 1u);
  EXPECT_EQ(document.face_labels()[0].kind, "group");
  EXPECT_EQ(document.face_labels()[0].names, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(document.face_labels()[0].of_face, (std::vector<std::int32_t>{0, 0, 1, 1}));
  EXPECT_PRED2(message_contains, document.notes().at(0), "Volume elements (1) are not looked at");
}

TEST(Inp, numbers_belong_to_their_part) {
  const Document document = Document::parse(parts, Format::inp);
  EXPECT_EQ(document.surface().positions.size(), 21u);
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 1, 2, 5, 4, 3}));
  EXPECT_EQ(document.face_labels().at(1).names, (std::vector<std::string>{"first", "second"}));
}

TEST(Inp, keeps_every_promise_of_patching) {
  check_patching(flat, Format::inp);
  check_patching(parts, Format::inp);
}

TEST(Inp, only_the_moved_coordinate_changes) {
  std::vector<double> moved = positions;
  moved[3] = 0.1;
  moved[8] = -2;
  moved[11] = 1e-20;
  EXPECT_EQ(patched_bytes(Document::parse(flat, Format::inp), moved),
            replaced(replaced(replaced(flat, "4.000", "0.1"), "4.,0,", "4.,-2,"), "4.25", "1e-20"));
}

TEST(Inp, line_ends_do_not_matter) {
  std::string text;
  for (const char c : flat) text += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(Document::parse(text, Format::inp).surface().positions, positions);
  check_patching(text, Format::inp);
}

TEST(Inp, errors_say_what_and_where) {
  EXPECT_PARSE_ERROR("", Format::inp, "empty");
  EXPECT_PARSE_ERROR("v 0 0 0\n", Format::inp, "line 1: a keyword like '*NODE' should be before");
  EXPECT_PARSE_ERROR("*Heading\n", Format::inp, "no nodes");
  EXPECT_PARSE_ERROR(replaced(flat, "5,0,4.,0,", "5,0,4."), Format::inp,
                     "line 7: node 5 has fewer than three coordinates");
  EXPECT_PARSE_ERROR(replaced(flat, "4.25", "4.25D0"), Format::inp,
                     "line 8: coordinate '4.25D0' of vertex 7 is not a number");
  EXPECT_PARSE_ERROR(replaced(flat, "4.25", "1e999"), Format::inp,
                     "line 8: coordinate '1e999' of vertex 7 is not finite");
  EXPECT_PARSE_ERROR(replaced(flat, "99,7,7,7", "10,7,7,7"), Format::inp, "line 9: node 10 is there twice");
  EXPECT_PARSE_ERROR(replaced(flat, "10, 5, 20", "10, 5, 21"), Format::inp,
                     "line 11: element 1 uses node 21, but the file lists none");
  EXPECT_PARSE_ERROR(replaced(flat, "10, 5, 20", "10, x, 20"), Format::inp, "line 11: 'x' where a node of an element");
  EXPECT_PARSE_ERROR(replaced(flat, " 7\n*Element", "*Element"), Format::inp, "line 15: element 3 has 2 of 3 nodes");
  EXPECT_PARSE_ERROR(replaced(flat, "S3,", "STRI65,"), Format::inp, "line 10: elements STRI65 are curved");
  EXPECT_PARSE_ERROR(replaced(flat, "NSET=all", "SYSTEM=C"), Format::inp, "line 4: *NODE with cylindrical");
  EXPECT_PARSE_ERROR(replaced(flat, "NSET=all", "INPUT=nodes.txt"), Format::inp, "line 4: INPUT names another file");
  EXPECT_PARSE_ERROR(replaced(flat, "*STEP", "*NGEN"), Format::inp, "*NGEN makes or places nodes");
  EXPECT_PARSE_ERROR(replaced(parts, "part=first\n", "part=first\n0, 0, 1\n"), Format::inp,
                     "line 19: this instance is moved");
  EXPECT_PARSE_ERROR(replaced(parts, "part=second", "part=first"), Format::inp,
                     "line 20: part FIRST has a second instance");
  EXPECT_PARSE_ERROR(replaced(parts, "*End Part\n*Part", "*Part"), Format::inp, "begins within part first");
  EXPECT_PARSE_ERROR("*End Part\n", Format::inp, "without its beginning");
  EXPECT_PARSE_ERROR("*Part, name=p\n*Node\n1,0,0,0\n", Format::inp, "part p is not ended");
}

TEST(Inp, survives_damage) {
  check_damage(flat, Format::inp);
  check_damage(parts, Format::inp);
}

}  // namespace
}  // namespace unsnarl::inp_files
