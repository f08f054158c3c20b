#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "folder.h"
#include "image_bytes.h"
#include "io/base64.h"
#include "io/byte_order.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

template <class T>
void append(std::string& bytes, T value) {
  bytes.resize(bytes.size() + sizeof(T));
  store(bytes.data() + bytes.size() - sizeof(T), value, std::endian::little);
}

/// A glTF file with a triangle twice: painted by material 0, and without a material. The buffer holds positions (36
/// bytes), coordinates as floats (24), as bytes (6, then 2 of padding), and an image.
struct TexturedTriangle {
  std::string materials = R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])";
  std::string textures = R"([{"source":0,"sampler":0}])";
  std::string images = R"([{"bufferView":3,"mimeType":"image/png","name":"skin"}])";
  std::string samplers = R"([{"wrapS":33071,"wrapT":33648}])";
  std::string attributes = R"("TEXCOORD_0":1,"TEXCOORD_1":2)";
  std::string image = png_bytes(4, 2);
  std::array<float, 6> uv = {0, 0, 1, 0, 0.25f, 0.75f};

  std::string json() const {
    std::string data;
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append(data, x);
    for (const float x : uv) append(data, x);
    for (const int x : {0, 51, 255, 0, 0, 102, 0, 0}) append(data, static_cast<std::uint8_t>(x));
    data += image;
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}},{{"attributes":{{"POSITION":0,{}}},"material":0}}]}}],)"
        R"("materials":{},"textures":{},"images":{},"samplers":{},)"
        R"("accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},)"
        R"({{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}},)"
        R"({{"bufferView":2,"componentType":5121,"normalized":true,"count":3,"type":"VEC2"}}],)"
        R"("bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":24}},)"
        R"({{"buffer":0,"byteOffset":60,"byteLength":6}},{{"buffer":0,"byteOffset":68,"byteLength":{}}}],)"
        R"("buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}}]}})",
        attributes, materials, textures, images, samplers, image.size(), data.size(), base64_encoded(data));
  }
  Appearance look(const std::filesystem::path& folder = {}, std::size_t image_bytes = most_image_bytes) const {
    return Document::parse(json(), Format::gltf, folder).appearance(image_bytes);
  }
};

/// u and v of the corners of the painted triangle.
std::vector<float> painted(const Appearance& look) {
  return {look.uv_of_corner.begin() + 6, look.uv_of_corner.end()};
}

TEST(GltfAppearance, images_in_the_file) {
  const Appearance look = TexturedTriangle().look();
  EXPECT_EQ(look.material_of_face, (std::vector<std::int32_t>{-1, 0}));
  ASSERT_EQ(look.images.size(), 1u);
  EXPECT_EQ(look.images[0].name, "0 (skin)");
  EXPECT_EQ(look.images[0].media_type, "image/png");
  EXPECT_EQ(look.images[0].bytes, png_bytes(4, 2));
  ASSERT_EQ(look.materials.size(), 1u);
  EXPECT_EQ(look.materials[0].image, 0);
  EXPECT_EQ(look.materials[0].wrap_u, Appearance::Wrap::clamp);
  EXPECT_EQ(look.materials[0].wrap_v, Appearance::Wrap::mirror);
  EXPECT_EQ(look.materials[0].alpha_cutoff, 0);
  EXPECT_EQ(painted(look), (std::vector<float>{0, 0, 1, 0, 0.25f, 0.75f}));
  EXPECT_TRUE(look.notes.empty());
}

TEST(GltfAppearance, images_as_data_and_beside_the_file) {
  TexturedTriangle file;
  file.images = R"([{"uri":"data:image/jpeg;base64,)" + base64_encoded(jpeg_bytes(6, 5)) + R"("}])";
  EXPECT_EQ(file.look().images.at(0).media_type, "image/jpeg");
  const TestFolder folder;
  folder.write("maps/my skin.png", png_bytes(9, 9));
  file.images = R"([{"uri":"maps/my%20skin.png"}])";
  EXPECT_EQ(file.look(folder.path()).images.at(0).width, 9u);
  EXPECT_EQ(file.look(folder.path()).images.at(0).name, "0 (maps/my%20skin.png)");
}

TEST(GltfAppearance, colours_and_holes) {
  TexturedTriangle file;
  file.materials =
      R"([{"alphaMode":"MASK","alphaCutoff":0.3,"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[1,0,0.2140411,1]}}])";
  const Appearance::Material masked = file.look().materials.at(0);
  EXPECT_EQ(masked.alpha_cutoff, 0.3f);
  EXPECT_EQ(masked.colour[0], 1);
  EXPECT_EQ(masked.colour[1], 0);
  EXPECT_NEAR(masked.colour[2], 0.5, 1e-6) << "from linear light";
  file.materials = R"([{"alphaMode":"BLEND","extensions":{"KHR_materials_pbrSpecularGlossiness":)"
                   R"({"diffuseTexture":{"index":0},"diffuseFactor":[0,1,0,1]}}}])";
  const Appearance::Material glossy = file.look().materials.at(0);
  EXPECT_EQ(glossy.alpha_cutoff, 0.5f);
  EXPECT_EQ(glossy.image, 0);
  EXPECT_EQ(glossy.colour, (std::array<float, 3>{0, 1, 0}));
  file.materials = R"([{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1]}}])";
  EXPECT_TRUE(file.look().images.empty());
  EXPECT_TRUE(file.look().uv_of_corner.empty());
}

TEST(GltfAppearance, other_coordinates_and_transforms) {
  TexturedTriangle file;
  file.materials = R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}}])";
  EXPECT_EQ(painted(file.look()), (std::vector<float>{0, 0.2f, 1, 0, 0, 0.4f}));
  // A quarter of a turn, then the shift, as KHR_texture_transform says.
  file.materials = R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1,"extensions":
      {"KHR_texture_transform":{"texCoord":0,"offset":[0.5,0],"scale":[2,1],"rotation":1.5707963267948966}}}}}])";
  const std::vector<float> turned = painted(file.look());
  const std::vector<float> expected = {0.5f, 0, 0.5f, -2, 1.25f, -0.5f};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(turned[i], expected[i], 1e-6) << i;
  file.uv[1] = std::numeric_limits<float>::quiet_NaN();
  file.materials = TexturedTriangle().materials;
  EXPECT_EQ(painted(file.look())[1], 0);
}

TEST(GltfAppearance, what_cannot_be_shown_is_said) {
  const auto note = [](const TexturedTriangle& file) {
    const Appearance look = file.look();
    EXPECT_EQ(look.material_of_face.size(), 2u);
    return look.notes.empty() ? std::string() : look.notes[0];
  };
  const auto expect_note = [&](auto change, const std::string& part) {
    TexturedTriangle file;
    change(file);
    EXPECT_NE(note(file).find(part), std::string::npos) << note(file) << " should say: " << part;
  };
  expect_note([](auto& f) { f.image = "WEBP"; }, "Image 0 (skin) is left out: neither PNG nor JPEG.");
  expect_note([](auto& f) { f.image = png_bytes(60000, 60000); }, "100 million are the most");
  expect_note([](auto& f) { f.images = R"([{"bufferView":77}])"; }, "neither a uri nor a bufferView");
  expect_note([](auto& f) { f.images = R"([{}])"; }, "neither a uri nor a bufferView");
  expect_note([](auto& f) { f.images = R"([{"bufferView":-1}])"; }, "not a whole number");
  expect_note([](auto& f) { f.images = R"([{"uri":"../skin.png"}])"; }, "not in the folder");
  expect_note([](auto& f) { f.images = R"([{"uri":"http://example.com/skin.png"}])"; }, "left out");
  expect_note([](auto& f) { f.images = R"([{"uri":"data:image/png;base64,!"}])"; }, "not valid base64");
  expect_note([](auto& f) { f.images = R"([{"uri":"data:image/png,abc"}])"; }, "not base64");
  expect_note([](auto& f) { f.attributes = R"("TEXCOORD_7":1)"; }, "TEXCOORD_0 is missing");
  expect_note([](auto& f) { f.attributes = R"("TEXCOORD_0":0)"; }, "type VEC2");
  expect_note([](auto& f) { f.attributes = R"("TEXCOORD_0":99)"; }, "does not exist");
  expect_note([](auto& f) { f.textures = R"([{"extensions":{"EXT_texture_webp":{"source":0}}}])", f.image = "RIFF"; },
              "PNG");
  TexturedTriangle large;
  large.image = png_bytes(4, 4, 3'000'000);
  EXPECT_NE(large.look({}, 2'000'000).notes.at(0).find("3.0 MB; all images together may have 2 MB"), std::string::npos);
  EXPECT_TRUE(large.look().notes.empty());
  TexturedTriangle dangling;
  dangling.textures = R"([{"source":5}])";
  EXPECT_EQ(dangling.look().materials.at(0).image, -1);
}

TEST(GltfAppearance, a_mesh_without_materials_has_none) {
  TexturedTriangle file;
  file.materials = "[]";
  EXPECT_FALSE(file.look().is_worth_showing());
}

}  // namespace
}  // namespace unsnarl
