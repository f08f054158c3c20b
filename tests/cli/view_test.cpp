#include <gtest/gtest.h>

#include "cli/program.h"

namespace unsnarl::cli {
namespace {

const std::string crossing_triangles = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 1\nv 1 9 0\nf 1 2 3\nf 4 5 6\n";

class View : public ::testing::Test {
 protected:
  View() { write(in, crossing_triangles); }
  std::string complaint(std::vector<std::string> arguments, int exit_code) {
    const auto before = folder.names();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(folder.names(), before);
    return outcome.err;
  }
  Folder folder;
  const std::string in = folder / "in.obj", page = folder / "page.html";
};

TEST_F(View, writes_one_page_that_needs_nothing_else) {
  const Outcome outcome = run({"view", in, "-o", page});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string html = contents(page);
  EXPECT_TRUE(html.starts_with("<!doctype html>"));
  EXPECT_TRUE(contains(html, "\"input\":\"in.obj\""));
  EXPECT_TRUE(contains(html, "The MIT License"));
  EXPECT_FALSE(contains(html, "<script src"));
  EXPECT_FALSE(contains(html, "<link rel=\"stylesheet\""));
  EXPECT_FALSE(contains(html, "id=\"positions_after\""));
  EXPECT_TRUE(contains(outcome.err, "page.html"));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj", "page.html"}));
}

TEST_F(View, shows_a_repair_with_its_report) {
  const std::string out = folder / "out.obj", report = folder / "report.json";
  ASSERT_EQ(run({"fix", in, "-o", out, "--report", report, "--view", page}).exit_code, 0);
  EXPECT_TRUE(contains(contents(page), "\"status\":\"embedded\""));
  EXPECT_TRUE(contains(contents(page), "id=\"positions_after\""));
  ASSERT_EQ(run({"view", in, out, "--report", report, "-o", page}).exit_code, 0);
  EXPECT_TRUE(contains(contents(page), "\"status\":\"embedded\""));
  EXPECT_TRUE(contains(contents(page), "\"output\":\"out.obj\""));
}

TEST_F(View, the_same_page_at_any_number_of_threads) {
  ASSERT_EQ(run({"view", in, in, "-o", page, "--threads", "1"}).exit_code, 0);
  const std::string first = contents(page);
  ASSERT_EQ(run({"view", in, in, "-o", page, "--threads", "3"}).exit_code, 0);
  EXPECT_EQ(contents(page), first);
}

TEST_F(View, images_of_materials_are_in_the_page_or_in_a_note) {
  write(in, "mtllib in.mtl\n" + crossing_triangles + "usemtl a\nf 1 2 4\nusemtl b\nf 1 3 5\n");
  write(folder / "in.mtl", "newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd gone.png\n");
  const std::string png("\x89PNG\r\n\x1A\n\0\0\0\rIHDR\0\0\0\x04\0\0\0\x04", 24);
  write(folder / "a.png", png);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"view", in, "-o", page},
        std::vector<std::string>{"fix", in, "-o", folder / "out.obj", "--view", page}}) {
    const Outcome outcome = run(command);
    EXPECT_TRUE(contains(outcome.err, "note: Image gone.png is left out")) << outcome.err;
    EXPECT_TRUE(contains(contents(page), "id=\"image_0\">iVBORw0KGgo"));
    EXPECT_TRUE(contains(contents(page), "Image gone.png is left out"));
  }
}

TEST_F(View, refuses_what_makes_no_sense) {
  const std::string other = folder / "other.obj", text = folder / "text.json", old = folder / "old.json";
  write(other, crossing_triangles + "f 1 2 4\n");
  write(text, "{}");
  write(old, R"({"schema": "unsnarl-report", "schema_version": 1})");
  EXPECT_TRUE(contains(complaint({"view", in}, 2), "-o"));
  EXPECT_TRUE(contains(complaint({"view", in, "-o", in}, 2), "html"));
  EXPECT_TRUE(contains(complaint({"view", in, other, "-o", page}, 3), "not those of"));
  EXPECT_TRUE(contains(complaint({"view", in, "--report", text, "-o", page}, 3), "no"));
  EXPECT_TRUE(contains(complaint({"view", in, "--report", old, "-o", page}, 3), "schema version 1"));
  EXPECT_TRUE(contains(complaint({"view", folder / "absent.obj", "-o", page}, 3), "absent.obj"));
  EXPECT_TRUE(contains(complaint({"view", in, "-o", folder / "absent/page.html"}, 4), "absent"));
  EXPECT_TRUE(contains(complaint({"fix", in, "-o", folder / "out.obj", "--view", in}, 2), "html"));
}

}  // namespace
}  // namespace unsnarl::cli
