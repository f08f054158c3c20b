#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <limits>

#include "document_checks.h"
#include "io/byte_order.h"

namespace unsnarl {
namespace {

template <class T>
void put(std::string& bytes, T value) {
  bytes.resize(bytes.size() + sizeof(T));
  store(bytes.data() + bytes.size() - sizeof(T), value, std::endian::little);
}

const std::vector<float> tetrahedron = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1f};

/// Positions of a tetrahedron (48 bytes), 12 indices of 16 bits (24 bytes).
std::string buffer_bytes(const std::vector<float>& positions = tetrahedron) {
  std::string bytes;
  for (const float x : positions) put(bytes, x);
  for (const int i : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) put(bytes, static_cast<std::uint16_t>(i));
  return bytes;
}

/// All of the JSON but the buffers; `nodes` and the primitive's extra members vary.
std::string json_text(const std::string& nodes = R"("nodes":[{"mesh":0,"name":"Knot"}])",
                      const std::string& buffer = "",
                      const std::string& primitive = R"("attributes":{"POSITION":0},"indices":1,"material":0)") {
  return R"({"asset" : {"version":"2.0", "generator":"by hand"}, "scene":0,"scenes":[{"nodes":[0]}], )" + nodes +
         R"(,"meshes":[{"name":"Tangle","primitives":[{)" + primitive + R"(}]}],"materials":[{"name":"red"}],
  "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0.0,0e0],"max":[1, 1.000, 0.1]},
               {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
  "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
  "extras":{"min":[0,0,0]}, "buffers":[{)" +
         buffer + R"("byteLength":72}]})";
}

std::string glb(std::string json, std::string binary, const std::string& more_chunks = "") {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  put(bytes, std::uint32_t{2});
  put(bytes, static_cast<std::uint32_t>(28 + json.size() + binary.size() + more_chunks.size()));
  put(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  put(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary + more_chunks;
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string gltf_with_data_uri(const std::string& nodes = R"("nodes":[{"mesh":0,"name":"Knot"}])") {
  return json_text(nodes, R"("uri":"data:application/octet-stream;base64,)" + base64(buffer_bytes()) + R"(",)");
}

const std::string plain = glb(json_text(), buffer_bytes());
const std::string moved_node =
    R"("nodes":[{"children":[1],"translation":[10,0,0],"rotation":[0,0,0.7071067811865476,0.7071067811865476]},
                {"mesh":0,"scale":[2,2,-3],"name":"Knot"}])";

TEST(Gltf, reads_both_containers) {
  for (const Document& document :
       {Document::parse(plain, Format::glb), Document::parse(gltf_with_data_uri(), Format::gltf)}) {
    EXPECT_EQ(document.surface().positions, std::vector<double>(tetrahedron.begin(), tetrahedron.end()));
    EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}));
    EXPECT_TRUE(document.stores_float32());
    EXPECT_TRUE(document.notes().empty());
    ASSERT_EQ(document.face_labels().size(), 3u);
    EXPECT_EQ(document.face_labels()[0].kind, "node");
    EXPECT_EQ(document.face_labels()[0].names, std::vector<std::string>{"Knot"});
    EXPECT_EQ(document.face_labels()[1].names, std::vector<std::string>{"Tangle"});
    EXPECT_EQ(document.face_labels()[2].names, std::vector<std::string>{"red"});
  }
}

TEST(Gltf, keeps_every_promise_of_patching) {
  std::string chunk;
  put(chunk, std::uint32_t{4});
  chunk += "MOREdata";
  check_patching(plain, Format::glb);
  check_patching(glb(json_text(), buffer_bytes(), chunk), Format::glb);
  check_patching(glb(json_text(moved_node), buffer_bytes()), Format::glb);
  check_patching(gltf_with_data_uri(), Format::gltf);
  check_patching(gltf_with_data_uri(moved_node), Format::gltf);
  std::string escaped;
  for (const char c : gltf_with_data_uri()) escaped += c == '/' ? std::string("\\/") : std::string(1, c);
  check_patching(escaped, Format::gltf);
}

TEST(Gltf, only_the_moved_numbers_and_their_bounds_change) {
  const Document document = Document::parse(plain, Format::glb);
  std::vector<double> moved = document.surface().positions;
  moved[4] = 0.5;       // within the bounds
  moved[11] = 1.0 / 3;  // the largest z
  std::vector<float> positions = tetrahedron;
  positions[4] = 0.5f;
  positions[11] = 1.0f / 3;
  EXPECT_EQ(patched_bytes(document, moved),
            glb(replaced(json_text(), "1.000, 0.1]", "1.000, 0.33333334]"), buffer_bytes(positions)));
}

TEST(Gltf, data_uri_changes_only_where_it_must) {
  const std::string text = gltf_with_data_uri();
  const Document document = Document::parse(text, Format::gltf);
  std::vector<double> moved = document.surface().positions;
  moved[4] = 0.5;
  std::vector<float> positions = tetrahedron;
  positions[4] = 0.5f;
  EXPECT_EQ(patched_bytes(document, moved), replaced(text, base64(buffer_bytes()), base64(buffer_bytes(positions))));
}

TEST(Gltf, normals_follow_where_asked_to) {
  EXPECT_FALSE(Document::parse(plain, Format::glb).recompute_normals());
  // A triangle in a node that is moved, mirrored and stretched, and a vertex of no face.
  const std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
                           R"("nodes":[{"mesh":0,"translation":[10,0,0],"scale":[2,4,-2]}],)"
                           R"("meshes":[{"primitives":[{"attributes":{"NORMAL":1,"POSITION":0},"indices":2}]}],)"
                           R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
                           R"({"bufferView":0,"byteOffset":48,"componentType":5126,"count":4,"type":"VEC3"},)"
                           R"({"bufferView":0,"byteOffset":96,"componentType":5125,"count":3,"type":"SCALAR"}],)"
                           R"("bufferViews":[{"buffer":0,"byteLength":108}],"buffers":[{"byteLength":108}]})";
  const auto buffer = [](float lift, float y, float z) {
    std::string bytes;
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, lift, 9.f, 9.f, 9.f}) put(bytes, x);
    for (int v = 0; v < 3; ++v)
      for (const float x : {0.f, y, z}) put(bytes, x);
    for (const float x : {0.f, 0.f, 1.f}) put(bytes, x);
    for (const int i : {0, 1, 2}) put(bytes, static_cast<std::uint32_t>(i));
    return bytes;
  };
  Document document = Document::parse(glb(json, buffer(0, 0, 1)), Format::glb);
  const std::vector<double> lifted = Document::parse(glb(json, buffer(1, 0, 1)), Format::glb).surface().positions;
  EXPECT_EQ(patched_bytes(document, lifted), glb(json, buffer(1, 0, 1)));
  EXPECT_TRUE(document.recompute_normals());
  EXPECT_EQ(patched_bytes(document, lifted), glb(json, buffer(1, -0.70710677f, 0.70710677f)));
  EXPECT_EQ(patched_bytes(document, document.surface().positions), glb(json, buffer(0, 0, 1)));
}

TEST(Gltf, nodes_place_their_meshes) {
  const Document document = Document::parse(glb(json_text(moved_node), buffer_bytes()), Format::glb);
  const std::vector<double>& x = document.surface().positions;
  const double expected[] = {10, 0, 0, 10, 2, 0, 8, 0, 0, 10, 0, -3 * static_cast<double>(0.1f)};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(x[i], expected[i], 1e-12);

  std::vector<double> moved = x;
  moved[3] = 9.5;  // half a unit along world x is -y/2 in the mesh, scaled by 1/2
  const std::string bytes = patched_bytes(document, moved);
  const std::size_t vertex = bytes.size() - 72 + 12;
  EXPECT_NEAR(load<float>(bytes.data() + vertex, std::endian::little), 1.0f, 1e-7f);
  EXPECT_NEAR(load<float>(bytes.data() + vertex + 4, std::endian::little), 0.25f, 1e-7f);
}

TEST(Gltf, matrix_is_column_major) {
  const Document document = Document::parse(
      glb(json_text(R"("nodes":[{"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}])"), buffer_bytes()),
      Format::glb);
  EXPECT_EQ(document.surface().positions[3], 6.0);
  EXPECT_EQ(document.surface().positions[4], 6.0);
  EXPECT_EQ(document.surface().positions[5], 7.0);
}

// An armature is turned by a quarter about x, which takes z to y. Without matrices of the bind pose the mesh is
// modelled with z up; with one that undoes the turn it is modelled as it stands in the scene.
TEST(Gltf, up_is_what_the_joints_turn_to_y) {
  using Axis = std::array<double, 3>;
  const auto up = [](const std::string& json, const std::string& more_bytes = "") {
    const std::string bytes = glb(json, buffer_bytes() + more_bytes);
    check_patching(bytes, Format::glb);
    return Document::parse(bytes, Format::glb).up();
  };
  EXPECT_EQ(up(json_text()), (Axis{0, 1, 0}));
  EXPECT_EQ(up(json_text(moved_node)), (Axis{0, 1, 0})) << "positions are those of the world";

  const std::string nodes =
      R"("nodes":[{"children":[1,2],"rotation":[-0.7071067811865476,0,0,0.7071067811865476]},
                  {"mesh":0,"skin":0},{"translation":[1,2,3],"children":[3]},{"translation":[0,1,0]}],)";
  const std::string posed = json_text(nodes + R"("skins":[{"joints":[2,3]}])");
  EXPECT_EQ(up(posed), (Axis{0, 0, 1}));
  EXPECT_EQ(up(replaced(posed, "-0.7071067811865476", "0.7071067811865476")), (Axis{0, 0, -1}));
  EXPECT_EQ(up(replaced(posed, "[2,3]", "[7]")), (Axis{0, 1, 0})) << "a joint that does not exist";
  EXPECT_EQ(up(replaced(posed, R"("skin":0)", R"("skin":5)")), (Axis{0, 1, 0}));
  EXPECT_EQ(up(json_text(nodes + R"("skins":[{"joints":[2],"inverseBindMatrices":1}])")), (Axis{0, 1, 0}))
      << "indices are no matrices";

  std::string bound = json_text(nodes + R"("skins":[{"joints":[2],"inverseBindMatrices":2}])");
  bound =
      replaced(bound, R"("SCALAR"}])", R"("SCALAR"},{"bufferView":2,"componentType":5126,"count":1,"type":"MAT4"}])");
  bound = replaced(bound, R"("byteLength":24}])", R"("byteLength":24},{"buffer":0,"byteOffset":72,"byteLength":64}])");
  bound = replaced(bound, R"("byteLength":72})", R"("byteLength":136})");
  std::string matrix;
  for (const float m : {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, -1, -2, -3, 1}) put(matrix, m);
  EXPECT_EQ(up(bound, matrix), (Axis{0, 1, 0}));
}

TEST(Gltf, notes_on_what_is_special) {
  const auto note = [](const std::string& nodes,
                       const std::string& primitive = R"("attributes":{"POSITION":0},"indices":1)") {
    const std::string bytes = glb(json_text(nodes, "", primitive), buffer_bytes());
    check_patching(bytes, Format::glb);
    const Document document = Document::parse(bytes, Format::glb);
    EXPECT_EQ(document.surface().positions[3], 1.0);  // no transform in any of these
    return document.notes().empty() ? std::string() : document.notes().back();
  };
  EXPECT_PRED2(message_contains, note(R"("nodes":[{"mesh":0,"skin":0,"translation":[9,9,9]}])"), "bind pose");
  EXPECT_PRED2(message_contains, note(R"("nodes":[{"mesh":0,"children":[1]},{"mesh":0,"translation":[9,9,9]}])"),
               "several nodes");
  EXPECT_PRED2(message_contains, note(R"("nodes":[{"mesh":0,"scale":[1,0,1]}])"), "cannot be inverted");
  EXPECT_PRED2(message_contains, note(R"("nodes":[{},{"mesh":0,"translation":[9,9,9]}])"), "not shown");
  EXPECT_PRED2(message_contains,
               note(R"("nodes":[{"mesh":0}])", R"("attributes":{"POSITION":0},"indices":1,"targets":[{"POSITION":5}])"),
               "Morph");
  EXPECT_PRED2(message_contains,
               note(R"("nodes":[{"mesh":0}])",
                    R"("attributes":{"POSITION":0},"indices":1},{"mode":1,"attributes":{"POSITION":0})"),
               "1 primitives without triangles");
}

TEST(Gltf, a_later_place_serves_where_the_first_is_flat) {
  const Document document = Document::parse(
      glb(json_text(R"("nodes":[{"mesh":0,"scale":[0,0,0]},{"mesh":0,"translation":[5,0,0]}])"), buffer_bytes()),
      Format::glb);
  EXPECT_EQ(document.surface().positions[3], 1.0);  // node 1 is no part of the scene
  const std::string both =
      replaced(json_text(R"("nodes":[{"mesh":0,"scale":[0,0,0]},{"mesh":0,"translation":[5,0,0]}])"), R"("nodes":[0])",
               R"("nodes":[0,1])");
  EXPECT_EQ(Document::parse(glb(both, buffer_bytes()), Format::glb).surface().positions[3], 6.0);
}

TEST(Gltf, strips_fans_and_unindexed) {
  const auto corners = [](const std::string& primitive) {
    return Document::parse(glb(json_text(R"("nodes":[{"mesh":0}])", "", primitive), buffer_bytes()), Format::glb)
        .surface()
        .corners;
  };
  using Corners = std::vector<std::int32_t>;
  EXPECT_EQ(corners(R"("attributes":{"POSITION":0},"mode":4)"), (Corners{0, 1, 2}));
  EXPECT_EQ(corners(R"("attributes":{"POSITION":0},"mode":5)"), (Corners{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(corners(R"("attributes":{"POSITION":0},"mode":6)"), (Corners{1, 2, 0, 2, 3, 0}));
}

TEST(Gltf, primitives_that_share_an_accessor_share_vertices) {
  const std::string bytes =
      glb(json_text(R"("nodes":[{"mesh":0}])", "",
                    R"("attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"mode":6)"),
          buffer_bytes());
  const Document document = Document::parse(bytes, Format::glb);
  EXPECT_EQ(document.surface().view().vertex_count(), 4u);
  EXPECT_EQ(document.surface().view().face_count(), 6u);
  check_patching(bytes, Format::glb);
}

/// Two meshes in one interleaved vertex buffer (position, normal), each with its own window into it.
std::string interleaved(std::size_t second_start) {
  std::string data;
  for (int v = 0; v < 6; ++v) {
    for (const float x : {v * 1.0f, v * v * 0.5f, 0.25f, 0.0f, 0.0f, 1.0f}) put(data, x);
  }
  const std::string accessor = R"("bufferView":0,"componentType":5126,"type":"VEC3",)";
  return glb(R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":2}}]},
                 {"primitives":[{"attributes":{"POSITION":1,"NORMAL":2}}]}],"accessors":[{)" +
                 accessor + R"("count":4},{)" + accessor +
                 fmt::format(R"("count":3,"byteOffset":{},"min":[2,2,0.25]}},{{)", second_start) + accessor +
                 R"("count":6,"byteOffset":12}],"bufferViews":[{"buffer":0,"byteLength":144,"byteStride":24}],
                 "buffers":[{"byteLength":144}]})",
             data);
}

TEST(Gltf, accessors_that_overlap_share_vertices) {
  const Document document = Document::parse(interleaved(48), Format::glb);
  EXPECT_EQ(document.surface().view().vertex_count(), 5u);
  EXPECT_EQ(document.surface().corners, (std::vector<std::int32_t>{0, 1, 2, 2, 3, 4}));
  EXPECT_EQ(document.surface().positions[12], 4.0);
  check_patching(interleaved(48), Format::glb);
  check_patching(interleaved(72), Format::glb);
}

TEST(Gltf, positions_that_cut_through_each_other_are_refused) {
  EXPECT_PARSE_ERROR(interleaved(52), Format::glb, "overlap at byte");
}

TEST(Gltf, positions_that_are_normals_too_cannot_move) {
  const Document document = Document::parse(
      glb(json_text(R"("nodes":[{"mesh":0}])", "", R"("attributes":{"POSITION":0,"NORMAL":0},"indices":1)"),
          buffer_bytes()),
      Format::glb);
  ASSERT_EQ(document.notes().size(), 1u);
  std::vector<double> moved = document.surface().positions;
  EXPECT_NO_THROW(document.patched(moved, false));
  moved[0] = 3;
  EXPECT_THROW(document.patched(moved, false), FileError);
}

TEST(Gltf, positions_that_are_indices_too_cannot_move) {
  const std::string text = replaced(json_text(), R"("byteOffset":48,"byteLength":24)", R"("byteLength":24)");
  const Document document = Document::parse(glb(text, buffer_bytes(std::vector<float>(12, 0.0f))), Format::glb);
  ASSERT_EQ(document.notes().size(), 1u);
  std::vector<double> moved = document.surface().positions;
  EXPECT_NO_THROW(document.patched(moved, false));
  moved[0] = 3;
  EXPECT_THROW(document.patched(moved, false), FileError);
  // Right behind the positions is where they usually are.
  EXPECT_TRUE(Document::parse(plain, Format::glb).notes().empty());
}

class GltfFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "unsnarl-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(GltfFolder, external_buffers_come_back_as_files) {
  const std::string text = json_text(R"("nodes":[{"mesh":0}])", R"("uri":"my%20data.bin",)");
  write_atomically(folder_ / "a.gltf", text);
  write_atomically(folder_ / "my data.bin", buffer_bytes());
  const Document document = Document::read(folder_ / "a.gltf");
  std::vector<double> moved = document.surface().positions;
  std::vector<OutputFile> files = document.patched(moved, false);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].bytes, text);
  EXPECT_EQ(files[1].name, "my data.bin");
  EXPECT_EQ(files[1].bytes, buffer_bytes());

  moved[11] = -0.75;
  files = document.patched(moved, false);
  std::vector<float> positions = tetrahedron;
  positions[11] = -0.75f;
  EXPECT_EQ(files[0].bytes, replaced(replaced(text, "0e0]", "-0.75]"), "1.000, 0.1]", "1.000, 0]"));
  EXPECT_EQ(files[1].bytes, buffer_bytes(positions));
}

TEST_F(GltfFolder, external_buffers_have_to_be_in_the_folder) {
  const auto error = [this](const std::string& uri) {
    write_atomically(folder_ / "a.gltf", json_text(R"("nodes":[{"mesh":0}])", R"("uri":")" + uri + R"(",)"));
    try {
      Document::read(folder_ / "a.gltf");
    } catch (const FileError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  for (const char* uri :
       {"../x.bin", "/etc/passwd", "a/../../x.bin", "%2e%2e/x.bin", "https://example.org/x.bin", ""}) {
    EXPECT_PRED2(message_contains, error(uri), "in the folder of the") << uri;
  }
  std::filesystem::create_symlink("/etc/passwd", folder_ / "link.bin");
  EXPECT_PRED2(message_contains, error("link.bin"), "a link out of it");
  EXPECT_PRED2(message_contains, error("missing.bin"), "missing.bin: cannot open");
  write_atomically(folder_ / "short.bin", "1234");
  EXPECT_PRED2(message_contains, error("short.bin"), "should have 72 bytes, but 4 are there");
}

TEST(Gltf, errors_say_what_and_where) {
  const std::string json = json_text();
  const auto error = [&](const std::string& from, const std::string& to) {
    return parse_error(glb(replaced(json, from, to), buffer_bytes()), Format::glb);
  };
  EXPECT_PARSE_ERROR("", Format::glb, "empty");
  EXPECT_PARSE_ERROR("", Format::gltf, "empty");
  EXPECT_PARSE_ERROR("v 0 0 0\n", Format::gltf, "JSON byte 0");
  EXPECT_PARSE_ERROR("{}", Format::gltf, "'asset' with a version is missing");
  EXPECT_PARSE_ERROR("hello hello hello hello hello", Format::glb, "byte 0: 'glTF'");
  EXPECT_PARSE_ERROR(plain.substr(0, plain.size() - 1), Format::glb, "it is cut short");
  EXPECT_PARSE_ERROR(replaced(plain, std::string("glTF\2", 5), std::string("glTF\1", 5)), Format::glb,
                     "glTF version 1");
  EXPECT_PRED2(message_contains, error("2.0", "1.0"), "glTF version 1.0");
  EXPECT_PRED2(message_contains, error("\"count\":4,", "\"count\":5,"),
               "5 elements do not fit into bufferView 0 of 48 bytes");
  EXPECT_PRED2(message_contains, error("\"count\":4,", "\"count\":9007199254740992,"), "do not fit");
  EXPECT_PRED2(message_contains, error("\"count\":4,", "\"count\":3,"),
               "index 5 uses vertex 3, but the primitive has 3 vertices");
  EXPECT_PRED2(message_contains, error("\"count\":4,", "\"count\":4,\"sparse\":{},"), "is sparse");
  EXPECT_PRED2(message_contains, error("5126", "5122"), "quantised");
  EXPECT_PRED2(message_contains,
               error("\"material\"", "\"extensions\":{\"KHR_draco_mesh_compression\":{}},\"material\""),
               "KHR_draco_mesh_compression, which");
  EXPECT_PRED2(message_contains,
               error("\"byteLength\":48", "\"byteLength\":48,\"extensions\":{\"EXT_meshopt_compression\":{}}"),
               "EXT_meshopt_compression");
  EXPECT_PRED2(message_contains, error("\"POSITION\":0", "\"POSITION\":7"), "accessor 7 does not exist");
  EXPECT_PRED2(message_contains, error("\"byteOffset\":48", "\"byteOffset\":49"),
               "bufferView 1 reaches beyond its buffer");
  EXPECT_PRED2(message_contains, error("\"mesh\":0", "\"mesh\":3"), "node 0 shows mesh 3");
  EXPECT_PRED2(message_contains, error("\"mesh\":0", "\"mesh\":0,\"children\":[0]"),
               "node 0 has several parents or contains itself");
  EXPECT_PRED2(message_contains, error("\"mesh\":0", "\"mesh\":0,\"scale\":[1,2]"),
               "node 0: 'scale' should be 3 numbers");
  std::vector<float> positions = tetrahedron;
  positions[7] = std::numeric_limits<float>::infinity();
  EXPECT_PARSE_ERROR(glb(json, buffer_bytes(positions)), Format::glb, "byte 24 of buffer 0: vertex 2");
}

TEST(Gltf, many_primitives_on_the_same_indices_are_refused) {
  std::string primitives = R"("attributes":{"POSITION":0},"indices":1)";
  for (int i = 0; i < 20000; ++i) primitives += R"(},{"attributes":{"POSITION":0},"indices":1)";
  EXPECT_TRUE(
      parse_error(glb(json_text(R"("nodes":[{"mesh":0}])", "", primitives), buffer_bytes()), Format::glb).empty());
  std::string many;
  for (int i = 0; i < 60000; ++i) put(many, std::uint16_t{0});
  std::string json = json_text(R"("nodes":[{"mesh":0}])", "", primitives);
  json = replaced(json, "\"byteOffset\":48,\"byteLength\":24", "\"byteOffset\":48,\"byteLength\":120000");
  json = replaced(json, "\"count\":12", "\"count\":60000");
  json = replaced(json, "\"byteLength\":72}]", "\"byteLength\":120048}]");
  EXPECT_PARSE_ERROR(glb(json, buffer_bytes().substr(0, 48) + many), Format::glb,
                     "more face corners than a file of this size");
}

TEST(Gltf, survives_damage) {
  check_damage(plain, Format::glb);
  check_damage(interleaved(48), Format::glb);
  check_damage(gltf_with_data_uri(moved_node), Format::gltf);
}

}  // namespace
}  // namespace unsnarl
