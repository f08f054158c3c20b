#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>

#include "unsnarl/document.h"

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

class FileAccess : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "unsnarl-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }
  static std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static std::string read_error(const fs::path& path) {
    try {
      Document::read(path);
    } catch (const FileError& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
};

TEST_F(FileAccess, writes_new_files_and_replaces_old_ones) {
  write_atomically(folder_ / "a.obj", "one");
  EXPECT_EQ(content(folder_ / "a.obj"), "one");
  write_atomically(folder_ / "a.obj", std::string("t\0o", 3));
  EXPECT_EQ(content(folder_ / "a.obj"), std::string("t\0o", 3));
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(FileAccess, keeps_permissions) {
  write_atomically(folder_ / "a.obj", "one");
  fs::permissions(folder_ / "a.obj", fs::perms::owner_read | fs::perms::owner_write);
  write_atomically(folder_ / "a.obj", "two");
  EXPECT_EQ(fs::status(folder_ / "a.obj").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(FileAccess, respects_write_protection) {
  if (::geteuid() == 0) GTEST_SKIP() << "nothing is protected from root";
  write_atomically(folder_ / "a.obj", "one");
  fs::permissions(folder_ / "a.obj", fs::perms::owner_read);
  EXPECT_THROW(write_atomically(folder_ / "a.obj", "two"), WriteError);
  EXPECT_EQ(content(folder_ / "a.obj"), "one");
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(FileAccess, follows_links) {
  write_atomically(folder_ / "a.obj", "one");
  fs::create_symlink("a.obj", folder_ / "link.obj");
  write_atomically(folder_ / "link.obj", "two");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.obj"));
  EXPECT_EQ(content(folder_ / "a.obj"), "two");
}

TEST_F(FileAccess, writes_into_devices) {
  write_atomically("/dev/null", "gone");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(FileAccess, failures_leave_nothing_behind) {
  EXPECT_THROW(write_atomically(folder_ / "missing" / "a.obj", "x"), WriteError);
  EXPECT_THROW(write_atomically(folder_, "x"), WriteError);
  EXPECT_THROW(write_atomically("", "x"), WriteError);
  EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(FileAccess, reads_with_the_format_of_the_extension_or_the_content) {
  write_atomically(folder_ / "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(Document::read(folder_ / "a.off").format(), Format::off);
  fs::rename(folder_ / "a.off", folder_ / "a");
  EXPECT_EQ(Document::read(folder_ / "a", Format::off).surface().view().vertex_count(), 3u);
  EXPECT_EQ(Document::read(folder_ / "a").format(), Format::off);  // by its content
  write_atomically(folder_ / "b", "v 0 0 0\n");
  EXPECT_NE(read_error(folder_ / "b").find("nor the content tells the format"), std::string::npos);
}

TEST_F(FileAccess, refuses_what_is_no_file_and_names_it) {
  EXPECT_NE(read_error(folder_ / "missing.obj").find("missing.obj: cannot open"), std::string::npos);
  fs::create_directory(folder_ / "folder.obj");
  EXPECT_NE(read_error(folder_ / "folder.obj").find("is a folder"), std::string::npos);
  ASSERT_EQ(::mkfifo((folder_ / "pipe.obj").c_str(), 0600), 0);
  EXPECT_NE(read_error(folder_ / "pipe.obj").find("not a regular file"), std::string::npos);
  write_atomically(folder_ / "bad.obj", "v 0 0 x\n");
  EXPECT_NE(read_error(folder_ / "bad.obj").find("bad.obj: line 1: "), std::string::npos);
}

/// While it lives, this process can open no more files.
class NoMoreDescriptors {
 public:
  NoMoreDescriptors() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit none = {0, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoMoreDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(FileAccess, a_failure_of_the_system_is_no_error_of_the_file) {
  write_atomically(folder_ / "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  {
    const NoMoreDescriptors none;
    EXPECT_THROW(Document::read(folder_ / "a.off"), SystemError);
    EXPECT_THROW(write_atomically(folder_ / "a.off", "x"), SystemError);
  }
  EXPECT_EQ(Document::read(folder_ / "a.off").format(), Format::off);
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(FileAccess, an_error_of_a_file_keeps_the_number_of_the_system) {
  try {
    Document::read(folder_ / "missing.obj");
    ADD_FAILURE() << "it was read";
  } catch (const FileError& error) {
    EXPECT_EQ(error.error_number(), ENOENT);
  }
}

}  // namespace
}  // namespace unsnarl
