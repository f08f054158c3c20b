#include "platform/files.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <fstream>
#include <iterator>

#include "io/folder.h"
#include "unsnarl/paths.h"

namespace unsnarl::platform {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  fs::path path(std::string_view name) const { return folder_.path() / path_of(name); }
  fs::path made(std::string_view name, std::string_view bytes = "x") const {
    fs::create_directories(path(name).parent_path());
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  static std::string text(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// Names of the matches, without the folder.
  std::vector<std::string> matches(const std::string& pattern) const {
    std::vector<std::string> paths;
    EXPECT_EQ(find_matches((folder_.path() / path_of(pattern)).string(),
                           [](int error) { return error != ENOENT && error != ENOTDIR; }, paths),
              0);
    for (std::string& found : paths) found = path_of(found).lexically_relative(folder_.path()).generic_string();
    return paths;
  }

  TestFolder folder_;
};

TEST_F(Files, status_tells_kinds_and_changes) {
  EXPECT_EQ(status_of(path("none")).kind, FileKind::none);
  EXPECT_EQ(status_of(folder_.path()).kind, FileKind::folder);
  const fs::path file = made("a \xC3\xA4 \xE4\xB8\xAD.txt", "four");
  const FileStatus status = status_of(file);
  EXPECT_EQ(status.kind, FileKind::file);
  EXPECT_EQ(status.stamp.size, 4);
  EXPECT_EQ(status_of(file).stamp, status.stamp);
  EXPECT_NE(status_of(made("other", "four")).stamp.inode, status.stamp.inode);
  ASSERT_EQ(give_second_name(file, path("second")), 0);
  EXPECT_EQ(status_of(path("second")).stamp, status.stamp);
  EXPECT_NE(status_of(made("second", "five.")).stamp, status.stamp);
}

TEST_F(Files, reads_bytes_as_they_are) {
  const std::string bytes("a\r\nb\n\x1a\0c\xff", 8);
  InputFile file(made("bytes", bytes), InputFile::Opening::at_once);
  ASSERT_EQ(file.error(), 0);
  EXPECT_EQ(file.status().stamp, status_of(path("bytes")).stamp);
  std::string got(100, ' ');
  got.resize(file.read(got.data(), got.size()));
  EXPECT_EQ(got, bytes);
  EXPECT_EQ(file.read(got.data(), got.size()), 0U);
  EXPECT_EQ(file.error(), 0);
}

TEST_F(Files, says_why_a_file_cannot_be_opened) {
  EXPECT_EQ(InputFile(path("none"), InputFile::Opening::at_once).error(), ENOENT);
  EXPECT_EQ(InputFile(path("none/none"), InputFile::Opening::waits).error(), ENOENT);
  InputFile folder(folder_.path(), InputFile::Opening::at_once);
  EXPECT_EQ(folder.error(), 0);
  EXPECT_EQ(folder.status().kind, FileKind::folder);
}

TEST_F(Files, writes_only_what_is_new) {
  const std::string bytes("a\r\n\n\0", 5);
  EXPECT_EQ(write_new_file(path("new"), bytes), 0);
  EXPECT_EQ(text(path("new")), bytes);
  EXPECT_EQ(write_new_file(path("new"), "other"), EEXIST);
  EXPECT_EQ(text(path("new")), bytes);
  EXPECT_EQ(write_new_file(path("none/new"), bytes), ENOENT);
}

TEST_F(Files, moves_over_a_file) {
  made("from", "from"), made("to", "to");
  EXPECT_EQ(move_file(path("from"), path("to")), 0);
  EXPECT_EQ(text(path("to")), "from");
  EXPECT_EQ(status_of(path("from")).kind, FileKind::none);
  EXPECT_EQ(move_file(path("none"), path("to")), ENOENT);
  EXPECT_EQ(give_second_name(path("none"), path("b")), ENOENT);
  EXPECT_EQ(give_second_name(path("none/none"), path("b")), ENOENT);
}

TEST_F(Files, makes_and_removes_folders) {
  EXPECT_EQ(make_folder(path("folder")), 0);
  EXPECT_EQ(make_folder(path("folder")), EEXIST);
  EXPECT_EQ(why_not_writable_folder(path("folder")), 0);
  made("folder/file");
  EXPECT_EQ(why_not_writable(path("folder/file")), 0);
  EXPECT_NE(remove_folder(path("folder")), 0);
  EXPECT_EQ(remove_file(path("folder/file")), 0);
  EXPECT_EQ(remove_folder(path("folder")), 0);
  fs::path first, second;
  EXPECT_EQ(make_temporary_folder(folder_.path(), ".t-", first), 0);
  EXPECT_EQ(make_temporary_folder(folder_.path(), ".t-", second), 0);
  EXPECT_NE(first, second);
  EXPECT_TRUE(fs::is_directory(first) && fs::is_directory(second));
  EXPECT_TRUE(first.filename().string().starts_with(".t-"));
  EXPECT_EQ(make_temporary_folder(path("none"), ".t-", first), ENOENT);
}

TEST_F(Files, finds_matches) {
  for (const char* name : {"f1.obj", "f10.obj", "f2.obj", "f2.ply", ".f3.obj", "a/f1.obj", "b/f1.obj", "\xC3\xA4.obj"})
    made(name);
  using Names = std::vector<std::string>;
  EXPECT_EQ(matches("f*.obj"), (Names{"f1.obj", "f10.obj", "f2.obj"}));
  EXPECT_EQ(matches("f?.obj"), (Names{"f1.obj", "f2.obj"}));
  EXPECT_EQ(matches("f[2-9].*"), (Names{"f2.obj", "f2.ply"}));
  EXPECT_EQ(matches("f[!2].obj"), (Names{"f1.obj"}));
  EXPECT_EQ(matches("*/f1.obj"), (Names{"a/f1.obj", "b/f1.obj"}));
  EXPECT_EQ(matches(".f*"), (Names{".f3.obj"}));
  EXPECT_EQ(matches("\xC3\xA4*"), (Names{"\xC3\xA4.obj"}));
  EXPECT_EQ(matches("none*"), Names());
  EXPECT_EQ(matches("none/*.obj"), Names());
}

}  // namespace
}  // namespace unsnarl::platform
