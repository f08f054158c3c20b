#include "document_checks.h"
#include "packed_numbers.h"

namespace unsnarl::vtk_files {
namespace {

constexpr std::endian big = std::endian::big;
const std::vector<double> positions = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4.25};

const std::string ascii =
    "# vtk DataFile Version 3.0\nvtk output POINTS 7\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n"
    "0 0 0 4.000 0 0\n0 4 0\n0 0 4.25 \n\nVERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\n"
    "POLYGONS 2 9\n3 0 2 1\n4 0 1 3 2\n\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"
    "CELL_DATA 3\nSCALARS a int\nLOOKUP_TABLE default\n1 2 3\nPOINT_DATA 4\nNORMALS n float\n";

std::string binary(const std::string& type, const std::string& points) {
  return "# vtk DataFile Version 4.2\nvtk output\nBINARY\nDATASET POLYDATA\nFIELD FieldData 2\na 1 2 double\n" +
         packed<double>({1, 2}, big) + "\nMETADATA\nINFORMATION 0\n\nb 2 1 unsigned_char\n\n\n\n" + "POINTS 4 " + type +
         "\n" + points +
         "\nMETADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 5.8\n\nPOLYGONS 2 9\n" +
         packed<std::int32_t>({3, 0, 2, 1, 4, 0, 1, 3, 2}, big) + "\nPOINT_DATA 4\nSCALARS x unsigned_char\n" + "abcd";
}
const std::string binary_float = binary("float", packed_all<float>(positions, big));
const std::string binary_double = binary("double", packed_all<double>(positions, big));

const std::string with_offsets = "# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET POLYDATA\nPOINTS 4 float\n" +
                                 packed_all<float>(positions, big) + "\nLINES 2 2\nOFFSETS vtktypeint64\n" +
                                 packed<std::int64_t>({0, 2}, big) + "\nCONNECTIVITY vtktypeint64\n" +
                                 packed<std::int64_t>({0, 1}, big) + "\nPOLYGONS 3 7\nOFFSETS vtktypeint64\n" +
                                 packed<std::int64_t>({0, 3, 7}, big) + "\nCONNECTIVITY vtktypeint64\n" +
                                 packed<std::int64_t>({0, 2, 1, 0, 1, 3, 2}, big) + "\n";
const std::string with_offsets_in_text =
    "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 0 4 0 0 0 4 0 0 0 4.25\n"
    "METADATA\nINFORMATION 0\n\nPOLYGONS 3 7\nOFFSETS vtktypeint64\n0 3 7 \nCONNECTIVITY vtktypeint64\n0 2 1\n0 1 3 "
    "2\n";

/// A triangle, a quad, a line, a point, a pixel and a strip.
const std::string grid =
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 4.000 0 0\n0 4 0\n0 0 "
    "4.25\n"
    "CELLS 6 24\n3 0 2 1\n4 0 1 3 2\n2 0 1\n1 3\n4 0 1 2 3\n4 0 1 2 3\nCELL_TYPES 6\n5\n9\n3\n1\n8\n6\n"
    "POINT_DATA 4\nSCALARS a int\n";
const std::string grid_with_offsets =
    "# vtk DataFile Version 5.1\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n" +
    packed_all<double>(positions, big) + "\nCELLS 3 7\nOFFSETS vtktypeint64\n" + packed<std::int64_t>({0, 3, 7}, big) +
    "\nCONNECTIVITY vtktypeint64\n" + packed<std::int64_t>({0, 2, 1, 0, 1, 3, 2}, big) + "\nCELL_TYPES 2\n" +
    packed<std::int32_t>({5, 7}, big) + "\n";

TEST(Vtk, faces_of_unstructured_grids_are_the_surface) {
  const Document of_text = Document::parse(grid, Format::vtk),
                 of_binary = Document::parse(grid_with_offsets, Format::vtk);
  const Surface &mixed = of_text.surface(), &binary_grid = of_binary.surface();
  EXPECT_EQ(mixed.corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 2, 0, 1, 3, 2, 0, 1, 2, 2, 1, 3}));
  EXPECT_EQ(binary_grid.positions, positions);
  EXPECT_EQ(binary_grid.corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 2}));
}

TEST(Vtk, reads_text_and_binary) {
  for (const std::string& bytes : {binary_float, binary_double, with_offsets, with_offsets_in_text}) {
    const Document document = Document::parse(bytes, Format::vtk);
    EXPECT_EQ(document.surface().positions, positions);
    EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 2}));
    EXPECT_EQ(document.surface().offsets, (std::vector<std::int32_t>{0, 3, 7}));
  }
  EXPECT_TRUE(Document::parse(binary_float, Format::vtk).stores_float32());
  EXPECT_FALSE(Document::parse(binary_double, Format::vtk).stores_float32());
}

TEST(Vtk, strips_are_triangles_of_one_orientation) {
  const Document document = Document::parse(ascii, Format::vtk);
  EXPECT_EQ(document.surface().positions, positions);
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 2, 0, 1, 2, 2, 1, 3}));
  const Document stitched =
      Document::parse(replaced(replaced(ascii, "4 0 1 2 3", "6 0 1 2 2 2 3"), "STRIPS 1 5", "STRIPS 1 7"), Format::vtk);
  EXPECT_EQ(stitched.surface().corners.size(), 10u);
}

TEST(Vtk, keeps_every_promise_of_patching) {
  for (const std::string& bytes :
       {ascii, binary_float, binary_double, with_offsets, with_offsets_in_text, grid, grid_with_offsets})
    check_patching(bytes, Format::vtk);
}

TEST(Vtk, only_the_moved_coordinate_changes) {
  std::vector<double> moved = positions;
  moved[11] = 0.1;
  EXPECT_EQ(patched_bytes(Document::parse(ascii, Format::vtk), moved), replaced(ascii, "4.25", "0.1"));
  EXPECT_EQ(patched_bytes(Document::parse(binary_double, Format::vtk), moved),
            replaced(binary_double, packed<double>({4.25}, big), packed<double>({0.1}, big)));
}

TEST(Vtk, integers_cannot_hold_a_repaired_mesh) {
  const std::string bytes = replaced(replaced(ascii, "4 float", "4 int"), "4.25", "4");
  const Document document = Document::parse(bytes, Format::vtk);
  EXPECT_FALSE(document.notes().empty());
  EXPECT_EQ(patched_bytes(document, document.surface().positions), bytes);
  EXPECT_THROW(document.patched(std::vector<double>(12, 0.5), false), FileError);
}

TEST(Vtk, errors_say_what_and_where) {
  EXPECT_PARSE_ERROR("", Format::vtk, "empty");
  EXPECT_PARSE_ERROR("v 0 0 0\n", Format::vtk, "line 1: '# vtk DataFile Version' should be here");
  EXPECT_PARSE_ERROR(replaced(ascii, "ASCII", "EBCDIC"), Format::vtk, "line 3: 'ebcdic' where ASCII or BINARY");
  EXPECT_PARSE_ERROR(replaced(ascii, "POLYDATA", "STRUCTURED_GRID"), Format::vtk,
                     "line 4: DATASET 'structured_grid': only POLYDATA");
  EXPECT_PARSE_ERROR(replaced(grid, "CELL_TYPES 6\n5\n9", "CELL_TYPES 6\n5\n10"), Format::vtk,
                     "CELLS: cell 1 (counting from 0) is of type 10: only triangles");
  EXPECT_PARSE_ERROR(replaced(grid, "CELL_TYPES 6\n5", "CELL_TYPES 6\n9"), Format::vtk,
                     "CELLS: cell 0 (counting from 0) has 3 points, but is a quad");
  EXPECT_PARSE_ERROR(replaced(grid, "CELL_TYPES 6", "CELL_TYPES 5"), Format::vtk, "5 types for 6 cells");
  const std::string types = "CELL_TYPES 6\n5\n9\n3\n1\n8\n6\n";
  EXPECT_PARSE_ERROR(replaced(grid, types, types + types), Format::vtk, "a second CELL_TYPES");
  EXPECT_PARSE_ERROR(replaced(grid, types, types + "CELLS 1 4\n3 0 1 2\n"), Format::vtk, "a second CELLS");
  EXPECT_PARSE_ERROR(grid.substr(0, grid.find("CELL_TYPES")), Format::vtk, "CELLS, but no CELL_TYPES");
  EXPECT_PARSE_ERROR(replaced(ascii, "POINTS 4", "POINTS 5"), Format::vtk,
                     "line 10: coordinate 'VERTICES' of vertex 4 is not a number");
  EXPECT_PARSE_ERROR(replaced(ascii, "POINTS 4", "POINTS 50"), Format::vtk, "POINTS should hold 150 numbers");
  EXPECT_PARSE_ERROR(replaced(ascii, "POINTS 4", "POINTS 4000000000000"), Format::vtk, "cannot be in this file");
  EXPECT_PARSE_ERROR(replaced(ascii, "POINTS 4", "POINTS x"), Format::vtk, "line 5: 'x' where the number of points");
  EXPECT_PARSE_ERROR(replaced(ascii, "float", "quaternion"), Format::vtk,
                     "'quaternion' is not a supported number type");
  EXPECT_PARSE_ERROR(replaced(ascii, "4.25", "nan"), Format::vtk, "line 8: coordinate 'nan' of vertex 3 is not finite");
  EXPECT_PARSE_ERROR(replaced(ascii, "4 0 1 3 2", "4 0 1 3 4"), Format::vtk, "cell 1 (counting from 0) uses vertex 4");
  EXPECT_PARSE_ERROR(replaced(ascii, "4 0 1 3 2", "5 0 1 3 2"), Format::vtk,
                     "cell 1 of 2 (counting from 0) reaches beyond");
  EXPECT_PARSE_ERROR(replaced(ascii, "POLYGONS", "POLYGONES"), Format::vtk, "line 14: 'polygones' where POINTS");
  EXPECT_PARSE_ERROR(replaced(with_offsets_in_text, "0 3 7", "0 8 7"), Format::vtk, "reaches beyond the list");
  EXPECT_PARSE_ERROR(binary_float.substr(0, 200), Format::vtk, "POINTS should hold 12 numbers of 4 bytes, but has");
  EXPECT_PARSE_ERROR("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n", Format::vtk, "no POINTS");
}

TEST(Vtk, survives_damage) {
  for (const std::string& bytes : {ascii, binary_float, with_offsets, with_offsets_in_text, grid, grid_with_offsets})
    check_damage(bytes, Format::vtk);
}

}  // namespace
}  // namespace unsnarl::vtk_files
