#include "unsnarl/staged_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

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

TEST_F(StagedFilesTest, AreInPlaceOnceCommitted) {
  const fs::path main = folder.write("x.gii", "old");
  ::chmod(main.c_str(), 0640);
  {
    StagedFiles staged(main);
    staged.write(three);
    EXPECT_EQ(content(staged.main_file()), "main");
    EXPECT_EQ(content(staged.folder() / "deeper/b.bin"), "b");
    EXPECT_EQ(content(main), "old");
    staged.commit();
  }
  EXPECT_EQ(content(main) + content(folder.path() / "a.bin") + content(folder.path() / "deeper/b.bin"), "mainab");
  struct stat status {};
  ASSERT_EQ(::stat(main.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
  EXPECT_EQ(entries(), 3u);
}

TEST_F(StagedFilesTest, LeaveNothingUnlessCommitted) {
  { StagedFiles(folder.path() / "x.gii").write(three); }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(StagedFilesTest, LeaveAllAsTheyWereWhereOneCannotBeReplaced) {
  const fs::path main = folder.write("x.gii", "old"), last = folder.write("deeper/b.bin", "old b");
  fs::create_directory(folder.path() / "a.bin");
  {
    StagedFiles staged(main);
    staged.write(three);
    EXPECT_THROW(staged.commit(), WriteError);
  }
  EXPECT_EQ(content(main) + content(last), "oldold b");
  EXPECT_EQ(entries(), 3u);
}

TEST_F(StagedFilesTest, ReplaceNoPipes) {
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(StagedFiles(folder.path() / "pipe"), WriteError);
  EXPECT_EQ(entries(), 1u);
}

}  // namespace
}  // namespace unsnarl
