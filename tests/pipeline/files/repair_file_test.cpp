// What is promised of written files: certified as they are read back, whole or not at all, of several all or none.
#include "unsnarl/repair_file_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "io/folder.h"
#include "pipeline/judged.h"
#include "unsnarl/certify.h"
#include "unsnarl/paths.h"

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

constexpr const char* crossing = "# kept\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 2\nv 2 1 2\nf 1 2 3\nf 4 5 6\n";
constexpr const char* floor_alone = "v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n";
constexpr const char* blade_alone = "v 1 1 -1\nv 1 1 2\nv 2 1 2\nf 1 2 3\n";
/// Two pairs: one that a short motion resolves, and one that takes a long one.
constexpr const char* shallow_and_deep =
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -0.01\nv 1 1 2\nv 2 1 2\nf 1 2 3\nf 4 5 6\n"
    "v 20 0 0\nv 60 0 0\nv 20 40 0\nv 30 10 -10\nv 30 10 20\nv 40 10 20\nf 7 8 9\nf 10 11 12\n";

class RepairFile : public ::testing::Test {
 protected:
  static std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  fs::path at(const std::string& name) const { return folder.path() / name; }
  /// All that is in the folder, but what the test itself wrote first.
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path()))
      found.push_back(fs::relative(entry.path(), folder.path()).string());
    std::sort(found.begin(), found.end());
    return found;
  }
  using Names = std::vector<std::string>;

  const TestFolder folder;
};

/// Options under which `shallow_and_deep` keeps its deep pair.
RepairFileOptions bounded() {
  RepairFileOptions options;
  options.repair.max_displacement_rel = 0.001;
  return options;
}

void expect_certified(const fs::path& written, const Surface& input) {
  const Document read_back = Document::read(written);
  EXPECT_TRUE(certify(input, read_back.surface().positions).embedded());
  EXPECT_EQ(read_back.surface().corners, input.corners);
}

TEST_F(RepairFile, writes_what_it_certified) {
  const fs::path in = folder.write("in.obj", crossing);
  const RepairedFiles done = repair_file(in, at("out.obj"));
  EXPECT_EQ(done.result.status, Status::embedded);
  EXPECT_EQ(done.written, std::vector<fs::path>{at("out.obj")});
  EXPECT_TRUE(done.partial.empty());
  expect_certified(at("out.obj"), Document::read(in).surface());
  EXPECT_EQ(Document::read(at("out.obj")).surface().positions, done.positions);
  EXPECT_TRUE(content(at("out.obj")).starts_with("# kept\n"));
  EXPECT_EQ(done.report.input, in.string());
  EXPECT_EQ(done.report.output, at("out.obj").string());
  EXPECT_EQ(content(in), crossing);
  EXPECT_EQ(names(), (Names{"in.obj", "out.obj"}));
}

TEST_F(RepairFile, gives_an_embedded_file_back_byte_for_byte) {
  repair_file(folder.write("in.obj", floor_alone), at("out.obj"));
  EXPECT_EQ(content(at("out.obj")), floor_alone);
}

TEST_F(RepairFile, replaces_the_input_in_place_only) {
  const fs::path in = folder.write("in.obj", crossing);
  EXPECT_THROW(repair_file(in, in), std::invalid_argument);
  EXPECT_THROW(repair_file(in, {}), std::invalid_argument);
  RepairFileOptions options;
  options.in_place = true;
  EXPECT_THROW(repair_file(in, at("out.obj"), options), std::invalid_argument);
  const Surface input = Document::read(in).surface();
  EXPECT_EQ(repair_file(in, {}, options).written, std::vector<fs::path>{in});
  expect_certified(in, input);
  EXPECT_EQ(names(), Names{"in.obj"});
}

TEST_F(RepairFile, keeps_an_unfinished_result_beside_its_place) {
  const fs::path in = folder.write("in.obj", shallow_and_deep);
  folder.write("out.obj", "old");
  const RepairedFiles done = repair_file(in, at("out.obj"), bounded());
  EXPECT_EQ(done.result.status, Status::displacement_exceeded);
  EXPECT_EQ(done.partial, std::vector<fs::path>{at("out.partial.obj")});
  EXPECT_TRUE(done.written.empty());
  EXPECT_EQ(content(at("out.obj")), "old");
  const Surface input = Document::read(in).surface();
  EXPECT_LT(judged(input, Document::read(done.partial[0]).surface().positions).size(),
            judged(input, input.positions).size());
}

TEST_F(RepairFile, goes_on_from_a_partial_result_without_replacing_it) {
  const fs::path in = folder.write("out.partial.obj", shallow_and_deep);
  const RepairedFiles done = repair_file(in, at("out.obj"), bounded());
  EXPECT_EQ(done.partial, std::vector<fs::path>{at("out.partial.2.obj")});
  EXPECT_EQ(content(in), shallow_and_deep);
}

TEST_F(RepairFile, writes_an_unfinished_result_as_asked) {
  const fs::path in = folder.write("in.obj", shallow_and_deep);
  RepairFileOptions options = bounded();
  options.no_partial = true;
  EXPECT_FALSE(repair_file(in, at("out.obj"), options).is_written());
  EXPECT_EQ(names(), Names{"in.obj"});
  options.keep_partial = true;
  EXPECT_EQ(repair_file(in, at("out.obj"), options).written, std::vector<fs::path>{at("out.obj")});
  EXPECT_EQ(names(), (Names{"in.obj", "out.obj"}));
}

TEST_F(RepairFile, completes_its_options_from_the_file) {
  const fs::path in = folder.write("in.obj", crossing);
  RepairFileOptions options;
  options.when_read = [](const SceneDocument& scene, RepairFileOptions& own) {
    own.repair.fixed.assign(scene.surface().view().vertex_count(), 1);
  };
  const RepairedFiles done = repair_file(in, at("out.obj"), options);
  EXPECT_EQ(done.result.status, Status::obstructed);
  EXPECT_EQ(names(), Names{"in.obj"});
}

TEST_F(RepairFile, leaves_nothing_where_it_cannot_write) {
  const fs::path in = folder.write("in.obj", crossing);
  fs::create_directory(at("out.obj"));
  const Names before = names();
  EXPECT_THROW(repair_file(in, at("out.obj")), WriteError);
  EXPECT_THROW(repair_file(in, at("missing/out.obj")), WriteError);
  EXPECT_THROW(repair_file(in, at("out.ply")), std::invalid_argument);
  EXPECT_THROW(repair_file(at("none.obj"), at("result.obj")), FileError);
  EXPECT_EQ(names(), before);
}

TEST_F(RepairFile, leaves_a_file_that_was_changed_meanwhile) {
  const fs::path in = folder.write("in.obj", crossing);
  const Surface input = Document::read(in).surface();
  RepairFileOptions options;
  options.in_place = true;
  options.when_read = [&](const SceneDocument&, RepairFileOptions&) { folder.write("in.obj", "# edited\n"); };
  try {
    repair_file(in, {}, options);
    FAIL() << "it overwrote what was changed";
  } catch (const WriteError& error) {
    EXPECT_NE(std::string(error.what()).find(at("in.partial.obj").string()), std::string::npos) << error.what();
  }
  EXPECT_EQ(content(in), "# edited\n");
  expect_certified(at("in.partial.obj"), input);
  EXPECT_EQ(names(), (Names{"in.obj", "in.partial.obj"}));
}

TEST_F(RepairFile, refuses_to_stage_what_does_not_hold) {
  const fs::path in = folder.write("in.obj", crossing);
  const FilesToRepair files =
      files_to_repair(std::make_shared<SceneDocument>(read_scene({in})), {in}, at("out.obj"), {});
  RepairResult wrong;
  wrong.status = Status::embedded;
  wrong.positions = files.scene->surface().positions;
  {
    StagedFiles staged;
    EXPECT_THROW(stage_result(files, wrong, {}, staged), std::logic_error);
  }
  EXPECT_EQ(names(), Names{"in.obj"});
}

TEST_F(RepairFile, hands_bytes_back_that_have_no_place) {
  const fs::path in = folder.write("in.obj", crossing);
  const FilesToRepair files = files_to_repair(std::make_shared<SceneDocument>(read_scene({in})), {in}, {}, {});
  const RepairedFiles done = repair_files(files, RepairFileOptions{});
  EXPECT_TRUE(done.is_written());
  expect_certified(folder.write("bytes.obj", done.bytes), files.scene->surface());
}

TEST_F(RepairFile, puts_all_files_of_a_scene_in_place_or_none) {
  const std::vector<fs::path> in = {folder.write("floor.obj", floor_alone), folder.write("blade.obj", blade_alone)};
  const Surface input = read_scene(in).surface();
  fs::create_directories(at("taken/blade.obj"));
  EXPECT_THROW(repair_files(in, at("taken")), WriteError);
  EXPECT_EQ(names(), (Names{"blade.obj", "floor.obj", "taken", "taken/blade.obj"}));

  const RepairedFiles done = repair_files(in, at("new/folder"));
  EXPECT_EQ(done.written, (std::vector<fs::path>{at("new/folder/floor.obj"), at("new/folder/blade.obj")}));
  EXPECT_TRUE(certify(input, read_scene(done.written).surface().positions).embedded());
  ASSERT_EQ(done.report.scene.files.size(), 2u);
  EXPECT_EQ(path_of(done.report.scene.files[1].output), at("new/folder/blade.obj"));
}

TEST_F(RepairFile, makes_no_folder_for_a_scene_that_is_refused) {
  const std::vector<fs::path> in = {folder.write("floor.obj", floor_alone), folder.write("blade.obj", blade_alone)};
  EXPECT_THROW(repair_files(in, folder.path()), std::invalid_argument);
  RepairFileOptions options;
  options.repair.min_gap_rel = -1;
  EXPECT_THROW(repair_files(in, at("new"), options), std::invalid_argument);
  EXPECT_THROW(repair_files({in[0], in[0]}, at("new")), std::invalid_argument);
  EXPECT_EQ(names(), (Names{"blade.obj", "floor.obj"}));
}

}  // namespace
}  // namespace unsnarl
