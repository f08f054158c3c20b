#include "document_checks.h"
#include "packed_numbers.h"

namespace unsnarl::msh_files {
namespace {

constexpr std::endian little = std::endian::little;
const std::vector<double> positions = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4.25, 7, 7, 7};
const std::vector<std::int32_t> corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4};
const std::vector<std::int32_t> offsets = {0, 3, 6, 9, 13};

const std::string ascii_2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nanything $Nodes\n$EndComments\n"
    "$PhysicalNames\n2\n1 5 \"edge\"\n2 7 \"left wall\"\n$EndPhysicalNames\n"
    "$Nodes\n5\n10 0 0 0\n20 4.000 0 0\n5 0 4 0\n7 0 0 4.25\n99 7 7 7\n$EndNodes\n"
    "$Elements\n7\n1 15 2 0 1 10\n2 1 2 5 1 10 20\n3 2 2 7 1 10 5 20\n4 2 2 7 1 10 20 7\n5 2 3 8 2 0 20 5 7\n"
    "6 3 2 8 2 10 7 5 99\n7 4 2 9 1 10 20 5 7\n$EndElements\n$NodeData\n1\n\"a\"\n$EndNodeData\n";

std::string binary_2(std::endian order) {
  const auto ints = [order](std::initializer_list<double> numbers) { return packed<std::int32_t>(numbers, order); };
  std::string nodes;
  const double tags[] = {10, 20, 5, 7, 99};
  for (std::size_t v = 0; v < 5; ++v)
    nodes += ints({tags[v]}) + packed<double>({positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]}, order);
  return "$MeshFormat\n2.2 1 8\n" + ints({1}) + "\n$EndMeshFormat\n$Nodes\n5\n" + nodes +
         "\n$EndNodes\n$Elements\n6\n" + ints({1, 1, 2, 2, 5, 1, 10, 20}) +
         ints({2, 3, 2, 3, 7, 1, 10, 5, 20, 4, 7, 1, 10, 20, 7, 5, 8, 2, 20, 5, 7}) +
         ints({3, 1, 2, 6, 8, 2, 10, 7, 5, 99}) + ints({4, 1, 0, 7, 10, 20, 5, 7}) + "\n$EndElements\n";
}

const std::string ascii_4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"left wall\"\n$EndPhysicalNames\n"
    "$Entities\n1 1 2 0\n1 0 0 0 1 3\n1 0 0 0 1 0 0 0 2 1 -1\n1 0 0 0 4 4 0 2 7 9 1 1\n2 0 0 0 4 4 4.25 1 8 "
    "0\n$EndEntities\n"
    "$Nodes\n2 5 5 99\n0 1 0 1\n10\n0 0 0\n2 1 1 4\n20\n5\n7\n99\n4.000 0 0 0.1 0.2\n0 4 0 0.1 0.2\n0 0 4.25 0 0\n7 7 "
    "7 1 1\n$EndNodes\n"
    "$Elements\n4 6 1 6\n1 1 1 1\n2 10 20\n2 1 2 2\n3 10 5 20\n4 10 20 7\n2 2 2 1\n5 20 5 7\n2 2 3 1\n6 10 7 5 "
    "99\n$EndElements\n";

std::string binary_4(std::endian order) {
  const auto ints = [order](std::initializer_list<double> numbers) { return packed<std::int32_t>(numbers, order); };
  const auto sizes = [order](std::initializer_list<double> numbers) { return packed<std::uint64_t>(numbers, order); };
  const auto doubles = [order](std::initializer_list<double> numbers) { return packed<double>(numbers, order); };
  return "$MeshFormat\n4.1 1 8\n" + ints({1}) +
         "\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"left wall\"\n$EndPhysicalNames\n" + "$Entities\n" +
         sizes({0, 0, 2, 0}) + ints({1}) + doubles({0, 0, 0, 4, 4, 0}) + sizes({1}) + ints({7}) + sizes({0}) +
         ints({2}) + doubles({0, 0, 0, 4, 4, 4}) + sizes({0}) + sizes({1}) + ints({-1}) + "\n$EndEntities\n" +
         "$Nodes\n" + sizes({2, 5, 5, 99}) + ints({0, 1, 0}) + sizes({1, 10}) + doubles({0, 0, 0}) + ints({1, 1, 1}) +
         sizes({4, 20, 5, 7, 99}) + doubles({4, 0, 0, 0.5, 0, 4, 0, 0.5, 0, 0, 4.25, 0.5, 7, 7, 7, 0.5}) +
         "\n$EndNodes\n" + "$Elements\n" + sizes({3, 5, 1, 5}) + ints({2, 1, 2}) +
         sizes({2, 3, 10, 5, 20, 4, 10, 20, 7}) + ints({2, 2, 2}) + sizes({1, 5, 20, 5, 7}) + ints({2, 2, 3}) +
         sizes({1, 6, 10, 7, 5, 99}) + "\n$EndElements\n";
}

std::vector<std::string> all_files() {
  return {ascii_2, binary_2(little), binary_2(std::endian::big), ascii_4, binary_4(little), binary_4(std::endian::big)};
}

TEST(Msh, reads_both_versions_in_text_and_binary) {
  for (const std::string& bytes : all_files()) {
    SCOPED_TRACE(bytes.substr(0, 20));
    const Document document = Document::parse(bytes, Format::msh);
    EXPECT_EQ(document.surface().positions, positions);
    EXPECT_EQ(document.surface().corners, corners);
    EXPECT_EQ(document.surface().offsets, offsets);
    EXPECT_FALSE(document.stores_float32());
  }
}

TEST(Msh, groups_are_the_physical_ones_and_objects_the_entities) {
  for (const std::string& bytes : {ascii_2, ascii_4}) {
    const Document document = Document::parse(bytes, Format::msh);
    ASSERT_EQ(document.face_labels().size(), 2u);
    EXPECT_EQ(document.face_labels()[0].kind, "group");
    EXPECT_EQ(document.face_labels()[0].names, (std::vector<std::string>{"left wall", "8"}));
    EXPECT_EQ(document.face_labels()[0].of_face, (std::vector<std::int32_t>{0, 0, 1, 1}));
    EXPECT_EQ(document.face_labels()[1].kind, "object");
    EXPECT_EQ(document.face_labels()[1].names, (std::vector<std::string>{"1", "2"}));
  }
}

TEST(Msh, keeps_every_promise_of_patching) {
  for (const std::string& bytes : all_files()) check_patching(bytes, Format::msh);
}

TEST(Msh, only_the_moved_coordinate_changes) {
  std::vector<double> moved = positions;
  moved[11] = 0.1;
  EXPECT_EQ(patched_bytes(Document::parse(ascii_2, Format::msh), moved), replaced(ascii_2, "4.25", "0.1"));
  EXPECT_EQ(patched_bytes(Document::parse(binary_4(little), Format::msh), moved),
            replaced(binary_4(little), packed<double>({4.25}, little), packed<double>({0.1}, little)));
}

TEST(Msh, says_what_is_not_looked_at) {
  EXPECT_PRED2(message_contains, Document::parse(ascii_2, Format::msh).notes().at(0),
               "Volume elements (1) are not looked at");
  EXPECT_PRED2(message_contains, Document::parse(ascii_4, Format::msh).notes().at(0), "Parametric coordinates");
}

TEST(Msh, an_element_of_two_physical_groups_is_one_face) {
  const std::string repeated = "3 2 2 7 1 10 5 20\n", again = "8 2 2 6 1 10 5 20\n";
  const std::string bytes = replaced(replaced(ascii_2, "$Elements\n7", "$Elements\n8"), repeated, repeated + again);
  const Document document = Document::parse(bytes, Format::msh);
  EXPECT_EQ(document.surface().corners, corners);
  EXPECT_PRED2(message_contains, document.notes().at(0), "for another physical group (1) count once");
  check_patching(bytes, Format::msh);
  // Twice in one group is a doubled face.
  const std::string doubled = replaced(bytes, "8 2 2 6", "8 2 2 7");
  EXPECT_EQ(Document::parse(doubled, Format::msh).surface().offsets.size(), 6u);
}

TEST(Msh, errors_say_what_and_where) {
  EXPECT_PARSE_ERROR("", Format::msh, "empty");
  EXPECT_PARSE_ERROR("v 0 0 0\n", Format::msh, "line 1: '$MeshFormat' should be here");
  EXPECT_PARSE_ERROR("$NOD\n1\n1 0 0 0\n$ENDNOD\n", Format::msh, "gmsh IN -save -format msh22 -o OUT.msh");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "2.2", "4.0"), Format::msh,
                     "line 2: version '4.0', but only 2.2 and 4.1 are read");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "2.2 0 8", "2.2 0 4"), Format::msh, "numbers of 4 bytes");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "2.2 0 8", "2.2 2 8"), Format::msh, "file type 2");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "\n5\n10", "\n6\n10"), Format::msh,
                     "line 19: '$EndNodes' where the number of a node should be");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "\n5\n10", "\n500000\n10"), Format::msh, "500000 nodes cannot be in");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "\n5\n10", "\n4\n10"), Format::msh, "line 18: '99' where '$EndNodes' should be");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "99 7", "10 7"), Format::msh, "node 10 is there twice");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "4.25", "nan"), Format::msh,
                     "line 17: coordinate 'nan' of vertex 7 is not finite");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "10 5 20\n", "10 5 21\n"), Format::msh,
                     "line 24: element 3 uses node 21, but there is none");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "3 2 2 7 1 10 5 20", "3 9 2 7 1 10 5 20 7 99 5"), Format::msh,
                     "elements of type 9 are curved faces");
  EXPECT_PARSE_ERROR(replaced(ascii_2, "3 2 2 7 1 10 5 20", "3 99 2 7 1 10 5 20"), Format::msh,
                     "elements of type 99 are not known");
  EXPECT_PARSE_ERROR(ascii_2.substr(0, 190), Format::msh, "line 18: vertex 99 has fewer than three coordinates");
  EXPECT_PARSE_ERROR(binary_4(little).substr(0, 350), Format::msh, "byte ");
  EXPECT_PARSE_ERROR(replaced(ascii_4, "2 1 1 4\n", "5 1 1 4\n"), Format::msh, "an entity of dimension 5");
  EXPECT_PARSE_ERROR("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", Format::msh, "no $Nodes");
}

TEST(Msh, survives_damage) {
  for (const std::string& bytes : {ascii_2, binary_2(little), ascii_4, binary_4(little)})
    check_damage(bytes, Format::msh);
}

}  // namespace
}  // namespace unsnarl::msh_files
