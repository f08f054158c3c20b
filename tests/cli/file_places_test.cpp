#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/program_test.h"
#include "cli/two_tetrahedra.h"

namespace unsnarl::cli {
namespace {

using two_tetrahedra::buffer;

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

TEST_F(FilePlaces, a_buffer_beside_the_result_belongs_to_it) {
  const std::string one = mesh("one", 1), two = mesh("two", 2);
  fs::create_directory(folder / "out");
  const std::string first = folder / "out/one.gltf";
  ASSERT_EQ(run({"fix", one, "-o", first}).exit_code, 0);
  expect_refusal({"fix", two, "-o", folder / "out/two.gltf"}, "scene.bin exists and would be overwritten");
  EXPECT_EQ(run({"fix", one, "-o", first}).exit_code, 0);  // its own is replaced
  EXPECT_EQ(run({"fix", two, "-o", first}).exit_code, 0);
  write(folder / "out/one.gltf", "precious, no glTF");
  expect_refusal({"fix", one, "-o", first}, "scene.bin exists and would be overwritten");

  fs::create_directory(folder / "scene");
  write(folder / "scene/scene.bin", "precious");
  write(folder / "far.obj", "v 90 0 0\nv 91 0 0\nv 90 1 0\nf 1 2 3\n");
  expect_refusal({"fix", two, folder / "far.obj", "-o", folder / "scene"}, "scene.bin exists and would be overwritten");
  expect_refusal({"fix", two, "-o", folder / "two/two.gltf"}, "an external file of the input");
  expect_refusal({"fix", two, "-o", folder / "two.gltf", "--report", folder / "scene.bin"},
                 "--report and an external file of");
  expect_refusal({"fix", two, "-o", folder / "two.gltf", "--report", folder / "two/scene.bin"},
                 "an external file of the input");
  expect_refusal({"fix", two, "--in-place", "--report", folder / "two/scene.bin"}, "--report and an external file of");
  expect_refusal({"check", two, "--pairs", folder / "two/scene.bin"}, "an external file of the input");
}

/// A GIFTI of the two tetrahedra that keeps its numbers in a file of this name, all of it or none of the points.
std::string gifti(const std::string& data, std::size_t first_byte = 0) {
  return fmt::format(
      R"(<GIFTI><DataArray Intent="NIFTI_INTENT_POINTSET" DataType="NIFTI_TYPE_FLOAT32" Dimensionality="2" Dim0="24" )"
      R"(Dim1="3" Encoding="ExternalFileBinary" Endian="LittleEndian" ExternalFileName="{0}" ExternalFileOffset="{1}"/>)"
      R"(<DataArray Intent="NIFTI_INTENT_TRIANGLE" DataType="NIFTI_TYPE_INT32" Dimensionality="2" Dim0="8" Dim1="3" )"
      R"(Encoding="ASCII"><Data>0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23</Data></DataArray></GIFTI>)",
      data, first_byte);
}

TEST_F(FilePlaces, a_gifti_gets_external_files_of_its_own) {
  const std::string points = buffer(1), other = buffer(0.125F), both = points + other;
  write(folder / "both.dat", both);
  const std::string one = file("one.gii", gifti("both.dat")), two = file("two.gii", gifti("both.dat", 288));
  const std::string fixed = folder / "fixed.gii", data = folder / "fixed.gii.data";
  const auto repaired = [&] {
    EXPECT_EQ(pairs_in(fixed), 0u);
    EXPECT_EQ(contents(folder / "both.dat"), both);
    EXPECT_EQ(contents(one), gifti("both.dat"));
    EXPECT_EQ(contents(fixed), gifti("fixed.gii.data"));
    EXPECT_NE(contents(data).substr(0, 288), points);
    EXPECT_EQ(contents(data).substr(288), other);
  };
  ASSERT_EQ(run({"fix", one, "-o", fixed}).exit_code, 0);
  repaired();
  ASSERT_EQ(run({"fix", one, "-o", fixed}).exit_code, 0);  // its own is replaced
  repaired();
  write(folder / "new.gii.data", "precious");
  expect_refusal({"fix", one, "-o", folder / "new.gii"}, "new.gii.data exists and would be overwritten");
  write(folder / "x.gii", gifti("y.gii.data"));
  write(folder / "y.gii.data", points);
  expect_refusal({"fix", folder / "x.gii", "-o", folder / "y.gii"}, "an external file of the input");
  expect_refusal({"fix", one, "-o", folder / "o.gii", "--report", folder / "both.dat"},
                 "an external file of the input");
  expect_refusal({"fix", one, "-o", folder / "o.gii", "--report", folder / "o.gii.data"},
                 "an external file of one.gii");
  expect_refusal({"fix", one, "-o", "-"}, "cannot go to standard output");

  // Two that share a file are taken apart, and repaired as one scene.
  ASSERT_EQ(run({"fix", one, two, "-o", folder / "scene"}).exit_code, 0);
  EXPECT_EQ(run({"check", folder / "scene/one.gii", folder / "scene/two.gii"}).exit_code, 0);
  EXPECT_EQ(contents(folder / "scene/one.gii"), gifti("one.gii.data"));
  EXPECT_EQ(contents(folder / "scene/two.gii"), gifti("two.gii.data", 288));
  EXPECT_EQ(contents(folder / "scene/one.gii.data").substr(288), other);

  // Without motion all is as it was.
  const std::string place = folder / "place.gii";
  write(place, contents(fixed));
  ASSERT_EQ(run({"fix", place, "-o", folder / "clean.gii"}).exit_code, 0);
  EXPECT_EQ(contents(folder / "clean.gii.data"), contents(data));

  // In place names stay.
  ASSERT_EQ(run({"fix", two, "--in-place"}).exit_code, 0);
  EXPECT_EQ(contents(two), gifti("both.dat", 288));
  EXPECT_EQ(contents(folder / "both.dat").substr(0, 288), points);
  EXPECT_EQ(pairs_in(two), 0u);
}

TEST_F(FilePlaces, nothing_is_left_where_an_external_file_cannot_be_written) {
  write(folder / "points.dat", buffer(1));
  const std::string in = file("in.gii", gifti("points.dat"));
  fs::create_directories(folder / "out.gii.data/x");
  expect_refusal({"fix", in, "-o", folder / "out.gii"}, "out.gii.data");
  EXPECT_FALSE(fs::exists(folder / "out.gii"));
}

TEST_F(FilePlaces, no_command_overwrites_what_it_reads) {
  const std::string in = folder / "in.obj", out = folder / "out.obj", ids = folder / "ids.txt";
  write(in, tetrahedron(0));
  write(ids, "0\n");
  expect_refusal({"fix", in, "-o", out, "--fix-vertices", ids, "--report", ids}, "--fix-vertices and --report");
  expect_refusal({"fix", in, "-o", "-", "--report", "-"}, "-o and --report both go to standard output; write one of");
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
}

TEST_F(FilePlaces, a_frame_does_not_overwrite_another_frame_through_a_link) {
  for (const char* name : {"a", "b", "out"}) fs::create_directory(folder / name);
  write(folder / "a/f0.obj", tetrahedron(0));
  write(folder / "b/f1.obj", tetrahedron(0.125));
  fs::create_symlink("../b/f1.obj", folder / "out/f0.obj");
  expect_refusal({"fix", "--sequence", folder / "a/f0.obj", folder / "b/f1.obj", "-o", folder / "out"},
                 "one of the frames and a repaired frame are the same");
}

TEST_F(FilePlaces, every_place_is_tested_before_the_work) {
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

TEST_F(FilePlaces, a_buffer_in_a_subfolder_gets_one_beside_the_result) {
  fs::create_directories(folder / "in/data/deeper");
  fs::create_directory(folder / "out");
  std::string text = gltf(1);
  text.replace(text.find("scene.bin"), 9, "data/./deeper/scene.bin");
  const std::string in = file("in/g.gltf", text), out = folder / "out/g.gltf";
  write(folder / "in/data/deeper/scene.bin", buffer(1));
  const Outcome outcome = run({"fix", in, "-o", out});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(pairs_in(out), 0u);
  EXPECT_TRUE(fs::exists(folder / "out/data/deeper/scene.bin"));
  ASSERT_EQ(run({"fix", in, "-o", out}).exit_code, 0);  // its own is replaced
  ASSERT_EQ(run({"batch", folder / "in", "-o", folder / "batch"}).exit_code, 0);
  EXPECT_EQ(pairs_in(folder / "batch/fixed/g.gltf/g.gltf"), 0u);
  // Where a file has the place of the subfolder, or a link leads elsewhere, nothing is written.
  fs::create_directories(folder / "second");
  fs::create_directories(folder / "third");
  write(folder / "second/data", "precious");
  fs::create_directory_symlink(folder / "out", folder / "third/data");
  expect_refusal({"fix", in, "-o", folder / "second/g.gltf"}, "not a folder", 4);
  expect_refusal({"fix", in, "-o", folder / "third/g.gltf"}, "leads out of the folder", 4);
}

TEST_F(FilePlaces, no_hidden_files_are_made_that_a_file_names) {
  fs::create_directories(folder / "in/.git/hooks");
  fs::create_directory(folder / "out");
  write(folder / "in/.git/hooks/scene", buffer(1));
  std::string text = gltf(1);
  text.replace(text.find("scene.bin"), 9, ".git/hooks/scene");
  expect_refusal({"fix", file("in/g.gltf", text), "-o", folder / "out/g.gltf"}, "a file of this name is not written",
                 4);
}

TEST_F(FilePlaces, no_place_is_an_internal_error) {
  const std::string in = file("in.obj", tetrahedron(0)), long_name(300, 'a');
  const Folder elsewhere;
  fs::create_symlink("loop.obj", elsewhere / "loop.obj");
  write(folder / "file", "no folder");
  for (const std::string& place : {folder / (long_name + ".obj"), folder / (long_name + "/out.obj"),
                                   elsewhere / "loop.obj", folder / "file/out.obj", folder / "none/out.obj"}) {
    expect_refusal({"fix", in, "-o", place}, "", 4);
    expect_refusal({"fix", in, "-o", folder / "out.obj", "--report", place}, "", 4);
    expect_refusal({"fix", in, in + "/../in.obj", "-o", place}, "");
    EXPECT_NE(run({"fix", in, place}).exit_code, 70);
    EXPECT_NE(run({"fix", place, "--in-place"}).exit_code, 70);
    EXPECT_NE(run({"fix", place, "-o", folder / "out.obj", "--report", place}).exit_code, 70);
    EXPECT_NE(run({"batch", place, "-o", folder / "b"}).exit_code, 70);
    EXPECT_NE(run({"batch", folder.string(), "-o", place}).exit_code, 70);
    EXPECT_NE(run({"check", in, "--pairs", place}).exit_code, 70);
    EXPECT_NE(run({"sample", "crossing_tubes", "-o", place}).exit_code, 70);
    EXPECT_NE(run({"view", in, "-o", place}).exit_code, 70);
    EXPECT_NE(run({"fix", "--sequence", in, file("in1.obj", tetrahedron(0)), "-o", place}).exit_code, 70);
  }
}

TEST_F(FilePlaces, a_folder_that_one_may_not_enter_is_no_internal_error) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give its rights up";
  const std::string in = file("in.obj", tetrahedron(0));
  for (const char* name : {"locked", "open"}) fs::create_directory(folder / name);
  ::chmod(folder.string().c_str(), 0755);
  ::chmod((folder / "locked").c_str(), 0700);
  ::chmod((folder / "open").c_str(), 0777);
  const RunOptions as_nobody = {.in_child = [] {
    if (::setgid(65534) != 0 || ::setuid(65534) != 0) ::_exit(127);
  }};
  if (run({"--version"}, as_nobody).exit_code != 0) GTEST_SKIP() << "others may not run the program";
  const std::string place = folder / "locked/x.obj";
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"fix", in, "-o", place},
        {"fix", in, "-o", folder / "locked/deeper/x.obj"},
        {"fix", in, "-o", folder / "open/x.obj", "--report", place},
        {"fix", in, in, "-o", folder / "locked/out"},
        {"batch", folder / "open", "-o", folder / "locked/b"},
        {"sample", "crossing_tubes", "-o", place},
        {"fix", "--sequence", in, "-o", folder / "locked/f"},
        {"fix", place, "-o", folder / "open/x.obj"},
        {"fix", in, place},
        {"check", place},
        {"view", in, "-o", folder / "locked/x.html"},
        {"fix", in, "-o", folder / "open/x.obj", "--picture", folder / "locked/"}}) {
    const Outcome outcome = run(words, as_nobody);
    EXPECT_TRUE(outcome.exit_code >= 2 && outcome.exit_code <= 4) << words.back() << outcome.exit_code << outcome.err;
  }
}

}  // namespace
}  // namespace unsnarl::cli
