#include "platform/locks.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <optional>

#include "io/folder.h"

namespace unsnarl::platform {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Locks, keep_others_out_until_the_file_is_closed) {
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "lines";
  std::optional<LockedFile> first;
  first.emplace();
  ASSERT_EQ(first->open(path), 0);
  EXPECT_TRUE(first->try_lock());
  EXPECT_EQ(first->append("a line\n"), 0);
  LockedFile second;
  ASSERT_EQ(second.open(path), 0);
  EXPECT_FALSE(second.try_lock());
  EXPECT_EQ(text_of(path), "a line\n") << "what is locked can be read";
  first.reset();
  EXPECT_TRUE(second.try_lock());
}

TEST(Locks, lines_are_appended) {
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "lines";
  LockedFile file;
  ASSERT_EQ(file.open(path), 0);
  file.lock();
  EXPECT_FALSE(file.ends_in_the_middle_of_a_line());
  EXPECT_EQ(file.append("whole\n"), 0);
  EXPECT_FALSE(file.ends_in_the_middle_of_a_line());
  EXPECT_EQ(file.append("cut o"), 0);
  EXPECT_TRUE(file.ends_in_the_middle_of_a_line());
  EXPECT_EQ(file.append("\n"), 0);
  EXPECT_EQ(text_of(path), "whole\ncut o\n");
}

TEST(Locks, say_why_a_file_cannot_be_opened) {
  const TestFolder folder;
  EXPECT_EQ(LockedFile().open(folder.path() / "none" / "lines"), ENOENT);
}

}  // namespace
}  // namespace unsnarl::platform
