#include "io/linked_file.h"

#include <gtest/gtest.h>

#include "io/folder.h"
#include "io/mesh_file.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

bool is_read(const fs::path& folder, const fs::path& name) {
  try {
    return read_file(linked_file(folder, name)) == "inside";
  } catch (const FileError&) {
    return false;
  }
}

class LinkedFile : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("mesh/a.bin", "inside");
    folder.write("mesh/below/b.bin", "inside");
    folder.write("secret", "outside");
    folder.write("mesh-too/c.bin", "outside");
  }
  void link(const fs::path& to, const std::string& name) const { fs::create_symlink(to, mesh() / name); }
  fs::path mesh() const { return folder.path() / "mesh"; }
  const TestFolder folder;
};

TEST_F(LinkedFile, what_lies_in_the_folder_or_below_is_read) {
  for (const char* const name : {"a.bin", "./a.bin", "below/b.bin", "below//b.bin"})
    EXPECT_TRUE(is_read(mesh(), name)) << name;
  link("a.bin", "a link");
  link(mesh() / "below", "below too");
  EXPECT_TRUE(is_read(mesh(), "a link"));
  EXPECT_TRUE(is_read(mesh(), "below too/b.bin"));
}

TEST_F(LinkedFile, parts_may_be_apart_as_on_windows) {
  EXPECT_TRUE(is_read(mesh(), named_path("below\\b.bin")));
  EXPECT_TRUE(is_read(mesh(), named_path(".\\below/b.bin")));
  for (const char* const name : {"..\\secret", "below\\..\\..\\secret", "\\secret"})
    EXPECT_FALSE(is_read(mesh(), named_path(name))) << name;
}

TEST_F(LinkedFile, a_folder_that_is_itself_a_link_counts_as_where_it_leads) {
  fs::create_directory_symlink(mesh(), folder.path() / "another name");
  EXPECT_TRUE(is_read(folder.path() / "another name", "below/b.bin"));
  fs::current_path(mesh());
  EXPECT_TRUE(is_read({}, "a.bin"));
  EXPECT_FALSE(is_read({}, "../secret"));
  fs::current_path("/");
}

TEST_F(LinkedFile, what_leads_out_of_the_folder_is_refused) {
  link("../secret", "link");
  link(folder.path() / "secret", "absolute link");
  link("link", "link to a link");
  link("..", "up");
  link("../mesh-too", "neighbour");
  link("loop", "loop");
  for (const std::string& name :
       {std::string("../secret"), (folder.path() / "secret").string(), std::string("below/../../secret"),
        std::string("link"), std::string("absolute link"), std::string("link to a link"), std::string("up/secret"),
        std::string("neighbour/c.bin"), std::string("loop"), std::string(), std::string("a.bin\0", 6)}) {
    try {
      read_file(linked_file(mesh(), name));
      ADD_FAILURE() << name;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("is not in the folder of the file that names it"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace unsnarl
