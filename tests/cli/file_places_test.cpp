#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>

#include "cli/program_test.h"

namespace unsnarl::cli {
namespace {

constexpr std::array<std::array<float, 3>, 8> points = {{{0, 0, 0},
                                                         {4, 0, 0},
                                                         {0, 4, 0},
                                                         {0, 0, 4},
                                                         {1.2F, 1.2F, 1.1F},
                                                         {2.6F, 2.5F, 2},
                                                         {2.5F, 2.6F, 2.2F},
                                                         {2, 2, 2.7F}}};
constexpr std::array<int, 24> corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4, 6, 5, 4, 5, 7, 5, 6, 7, 4, 7, 6};

/// A tetrahedron and a small one whose tip sticks into it, larger by `scale`, as the bytes of a buffer.
std::string buffer(float scale) {
  std::string bytes;
  for (const int c : corners)
    for (const float x : points[c]) {
      const auto word = std::bit_cast<std::uint32_t>(scale * x);
      for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 255);
    }
  return bytes;
}

std::string gltf(float scale) {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":24,"type":"VEC3","min":[0,0,0],"max":[{0},{0},{0}]}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":288}}],"buffers":[{{"byteLength":288,"uri":"scene.bin"}}]}})",
      4 * scale);
}

std::string tetrahedron(double shift) {
  return fmt::format("v {0} 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n", shift);
}

class FilePlaces : public ProgramTest {
 protected:
  std::string mesh(const std::string& name, float scale) {
    fs::create_directory(folder / name);
    write(folder / (name + "/scene.bin"), buffer(scale));
    write(folder / (name + "/scene.gltf"), gltf(scale));
    return folder / (name + "/scene.gltf");
  }
  void expect_refusal(const std::vector<std::string>& arguments, const std::string& words, int exit_code = 2) {
    ProgramTest::expect_refusal(arguments, exit_code, words);
  }
};

TEST_F(FilePlaces, ABufferBesideTheResultBelongsToIt) {
  const std::string one = mesh("one", 1), two = mesh("two", 2);
  fs::create_directory(folder / "out");
  const std::string first = folder / "out/one.gltf";
  ASSERT_EQ(run({"fix", one, "-o", first}).exit_code, 0);
  expect_refusal({"fix", two, "-o", folder / "out/two.gltf"}, "scene.bin is there already");
  EXPECT_EQ(run({"fix", one, "-o", first}).exit_code, 0);  // its own is replaced
  EXPECT_EQ(run({"fix", two, "-o", first}).exit_code, 0);
  write(folder / "out/one.gltf", "precious, no glTF");
  expect_refusal({"fix", one, "-o", first}, "scene.bin is there already");

  fs::create_directory(folder / "scene");
  write(folder / "scene/scene.bin", "precious");
  write(folder / "far.obj", "v 90 0 0\nv 91 0 0\nv 90 1 0\nf 1 2 3\n");
  expect_refusal({"fix", two, folder / "far.obj", "-o", folder / "scene"}, "scene.bin is there already");
  expect_refusal({"fix", two, "-o", folder / "two/two.gltf"}, "a buffer of the input");
  expect_refusal({"fix", two, "-o", folder / "two.gltf", "--report", folder / "scene.bin"}, "--report and a buffer of");
  expect_refusal({"fix", two, "-o", folder / "two.gltf", "--report", folder / "two/scene.bin"},
                 "a buffer of the input");
  expect_refusal({"fix", two, "--in-place", "--report", folder / "two/scene.bin"}, "--report and a buffer of");
  expect_refusal({"check", two, "--pairs", folder / "two/scene.bin"}, "a buffer of the input");
}

TEST_F(FilePlaces, NoCommandOverwritesWhatItReads) {
  const std::string in = folder / "in.obj", out = folder / "out.obj", ids = folder / "ids.txt";
  write(in, tetrahedron(0));
  write(ids, "0\n");
  expect_refusal({"fix", in, "-o", out, "--fix-vertices", ids, "--report", ids}, "--fix-vertices and --report");
  expect_refusal({"check", in, "--pairs", folder / "./in.obj"}, "the input and --pairs");

  const std::string knot = folder / "knot.obj";  // whatever its name
  write(knot, "0 0 0\n1 0 0\n0 1 0\n");
  expect_refusal({"seifert", knot, "-o", knot}, "the input and -o");
  expect_refusal({"seifert", knot, "-o", out, "--report", knot}, "the input and --report");
  expect_refusal({"seifert", knot, "-o", out, "--report", out}, "-o and --report");
  ASSERT_EQ(run({"seifert", knot, "-o", out, "--no-fair"}).exit_code, 0);
  expect_refusal({"seifert", knot, "--check", out, "--report", out}, "--check");

  const std::string curves = folder / "curves.json";
  write(curves, R"({"curves": [{"closed": true, "points": [[0, 0], [9, 0], [0, 9]]}]})");
  expect_refusal({"curves", curves, "-o", folder / "c.json", "--report", curves}, "the input and --report");

  const std::string list = folder / "list.txt";
  write(list, in + "\tfixed.obj\n" + in + "\tfixed.obj/other.obj\n");
  expect_refusal({"batch", list, "-o", folder / "batch"}, "to a folder of that name");
}

TEST_F(FilePlaces, AFrameDoesNotOverwriteAnotherFrameThroughALink) {
  for (const char* name : {"a", "b", "out"}) fs::create_directory(folder / name);
  write(folder / "a/f0.obj", tetrahedron(0));
  write(folder / "b/f1.obj", tetrahedron(0.125));
  fs::create_symlink("../b/f1.obj", folder / "out/f0.obj");
  expect_refusal({"fix", "--sequence", folder / "a/f0.obj", folder / "b/f1.obj", "-o", folder / "out"},
                 "one of the frames and a repaired frame are the same");
}

TEST_F(FilePlaces, EveryPlaceIsTestedBeforeTheWork) {
  const std::string in = folder / "in.obj", out = folder / "out.obj";
  write(in, tetrahedron(0));
  for (const auto& [option, name] : {std::pair("--report", "none/file"),
                                     {"--highlight", "none/file.ply"},
                                     {"--record", "none/file"},
                                     {"--picture", "none/file.png"}})
    expect_refusal({"fix", in, "-o", out, option, folder / name}, "cannot create files", 4);
  write(folder / "k.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  expect_refusal({"seifert", folder / "k.xyz", "-o", out, "--report", folder / "none/file"}, "cannot create files", 4);
}

}  // namespace
}  // namespace unsnarl::cli
