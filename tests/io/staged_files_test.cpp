#include "unsnarl/staged_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <iterator>

#include "folder.h"

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

class StagedFilesTest : public ::testing::Test {
 protected:
  static std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
  }

  const TestFolder folder;
  const std::vector<OutputFile> three = {{{}, "main"}, {"a.bin", "a"}, {"deeper/b.bin", "b"}};
};

TEST_F(StagedFilesTest, are_in_place_once_committed) {
  const fs::path main = folder.write("x.gii", "old");
  ::chmod(main.c_str(), 0640);
  {
    StagedFiles staged;
    const fs::path written = staged.add(main, three);
    EXPECT_EQ(content(written), "main");
    EXPECT_EQ(content(written.parent_path() / "deeper/b.bin"), "b");
    EXPECT_EQ(content(main), "old");
    staged.commit();
  }
  EXPECT_EQ(content(main) + content(folder.path() / "a.bin") + content(folder.path() / "deeper/b.bin"), "mainab");
  struct stat status {};
  ASSERT_EQ(::stat(main.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
  EXPECT_EQ(entries(), 3u);
}

TEST_F(StagedFilesTest, leave_nothing_unless_committed) {
  { StagedFiles().add(folder.path() / "x.gii", three); }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(StagedFilesTest, tell_their_guard_of_every_temporary_folder) {
  std::vector<std::size_t> before, after;
  const StagedFiles::Guard guard = [&](const StagedFiles& files, const std::function<void()>& step) {
    before.push_back(files.folders().size());
    step();
    after.push_back(files.folders().size());
  };
  {
    StagedFiles staged(guard);
    staged.add(folder.path() / "x.gii", three);
    staged.commit();
  }
  // Made, moved from, removed.
  EXPECT_EQ(before, (std::vector<std::size_t>{0, 1, 1}));
  EXPECT_EQ(after, (std::vector<std::size_t>{1, 1, 0}));
}

TEST_F(StagedFilesTest, leave_all_as_they_were_where_one_cannot_be_replaced) {
  const fs::path main = folder.write("x.gii", "old"), last = folder.write("deeper/b.bin", "old b");
  {
    StagedFiles staged;
    staged.add(main, three);
    fs::create_directory(folder.path() / "a.bin");
    EXPECT_THROW(staged.commit(), WriteError);
  }
  EXPECT_EQ(content(main) + content(last), "oldold b");
  EXPECT_EQ(entries(), 3u);
}

TEST_F(StagedFilesTest, are_taken_back_where_a_move_fails) {
  // The folder of the second is gone when its turn comes, so the first, which is moved already, has to come back.
  const fs::path main = folder.write("main.obj", "old"), other = folder.path() / "other";
  fs::create_directory(other);
  {
    StagedFiles staged;
    staged.add(main, "new");
    const fs::path written = staged.add(other / "r.json", "report");
    staged.add(folder.path() / "fresh.obj", "fresh");
    fs::remove(written);
    EXPECT_THROW(staged.commit(), WriteError);
  }
  EXPECT_EQ(content(main), "old");
  EXPECT_FALSE(fs::exists(folder.path() / "fresh.obj"));
  EXPECT_TRUE(fs::is_empty(other));
  EXPECT_EQ(entries(), 2u);
}

TEST_F(StagedFilesTest, replace_no_pipes) {
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(StagedFiles().open(folder.path() / "pipe"), WriteError);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(StagedFilesTest, replace_nothing_that_was_changed_after_it_was_read) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const std::string how : {"longer", "as long", "another file"}) {
    const fs::path main = folder.write("a.obj", mesh);
    const Document document = Document::read(main);
    const std::string edited = how == "longer" ? mesh + "# edited" : "v 9" + mesh.substr(3);
    if (how == "another file")
      fs::rename(folder.write("b.obj", edited), main);
    else
      folder.write("a.obj", edited);
    fs::last_write_time(main, fs::last_write_time(main) + std::chrono::seconds(how == "as long" ? 1 : 0));
    StagedFiles staged;
    staged.add(main, document.patched(document.surface().positions, true));
    EXPECT_THROW(staged.commit(), ChangedMeanwhile) << how;
    EXPECT_EQ(content(main), edited) << how;
  }
  const fs::path main = folder.write("a.obj", mesh);
  const Document document = Document::read(main);
  StagedFiles staged;
  staged.add(main, document.patched(document.surface().positions, true));
  staged.commit();
  EXPECT_EQ(content(main), mesh);
}

TEST_F(StagedFilesTest, write_no_hidden_files_nor_outside_the_folder) {
  const fs::path main = folder.path() / "out/x.gltf";
  fs::create_directories(folder.path() / "out");
  fs::create_directories(folder.path() / "elsewhere");
  fs::create_directory_symlink(folder.path() / "elsewhere", folder.path() / "out/link");
  for (const char* name : {".profile", ".git/hooks/x", "data/.x", "../x.bin", "/tmp/x.bin", "link/x.bin"}) {
    EXPECT_THROW(StagedFiles().open_beside(main, {name}), WriteError) << name;
    EXPECT_THROW(StagedFiles().add(main, {{{}, "main"}, {name, "bytes"}}), WriteError) << name;
  }
  StagedFiles().open_beside(main, {"data/deeper/x.bin"});
  StagedFiles().open_beside(folder.path() / "out/.x.gii", {".x.gii.data"});  // asked for by the user
  EXPECT_EQ(std::distance(fs::recursive_directory_iterator(folder.path()), fs::recursive_directory_iterator()), 3);
}

}  // namespace
}  // namespace unsnarl
