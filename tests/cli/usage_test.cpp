#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "cli/program_test.h"

namespace unsnarl::cli {
namespace {

using Usage = ProgramTest;

TEST_F(Usage, HelpAndVersionGoToStandardOutput) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"fix", "--help"},
                                                    {"check", "--help"},
                                                    {"view", "--help"},
                                                    {"sample", "--help"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.out.find("Examples"), std::string::npos);
    EXPECT_EQ(outcome.err, "");
  }
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out.rfind("unsnarl ", 0), 0u);
}

TEST_F(Usage, VersionsOfAllLibraries) {
  for (const bool json_first : {false, true}) {
    const Outcome outcome = json_first ? run({"--json", "--version"}) : run({"--version", "--json"});
    EXPECT_EQ(outcome.exit_code, 0);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ("unsnarl " + json["unsnarl"].get<std::string>() + "\n", run({"--version"}).out);
    for (const char* name : {"CGAL", "CLI11", "GMP", "OpenSSL", "glibc", "oneTBB", "zlib", "{fmt}"})
      EXPECT_TRUE(std::regex_match(json["libraries"][name].get<std::string>(), std::regex(R"(\d+(\.\d+)+.*)"))) << name;
  }
}

TEST_F(Usage, UsageErrorsExitWith2) {
  const std::string in = file("in.obj", clean_cube);
  expect_refusal({}, 2, "");
  expect_refusal({"mend"}, 2, "fix, batch, check, view, sample, curves, isotopy, seifert or routes");
  expect_refusal({"fix"}, 2, "IN");
  expect_refusal({"fix", in}, 2, "-o");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--frobnicate"}, 2, "frobnicate");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--goal", "some"}, 2, "goal");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--time-limit", "-1"}, 2, "time-limit");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--in-place"}, 2, "--in-place");
  expect_refusal({"fix", in, "-o", folder / "o.stl"}, 2, "keeps the format");
  expect_refusal({"fix", in, "-o", in}, 2, "--in-place");
  expect_refusal({"fix", in, "-o", folder.string() + "/./in.obj"}, 2, "--in-place");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--report", in}, 2, "the same");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--report", folder / "o.obj"}, 2, "the same");
  expect_refusal({"fix", "-", "-o", folder / "o.obj"}, 2, "--format");
  expect_refusal({"fix", "-", "--in-place", "--format", "obj"}, 2, "--in-place");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--format", "doc"}, 2, "doc");
  expect_refusal({"sample"}, 2, "--list");
  expect_refusal({"sample", "no_such_thing", "-o", folder / "o.obj"}, 2, "no_such_thing");
  expect_refusal({"sample", "book", "-o", folder / "o.glb"}, 2, "glb");
  expect_refusal({"sample", "book", "-o", folder / "o.obj", "--set", "pages"}, 2, "NAME=NUMBER");
  EXPECT_EQ(contents(in), clean_cube);
}

TEST_F(Usage, WhatIsNoNumberInTheRangeIsRefused) {
  const std::string in = file("in.obj", crossing);
  for (const char* value : {"90", "200", "-1", "nan", "inf", "x"})
    expect_refusal({"fix", in, "-o", folder / "out.obj", "--min-dihedral", value}, 2, "--min-dihedral");
  for (const char* option : {"--max-displacement", "--min-gap", "--time-limit", "--memory-limit", "--weld-tolerance"})
    for (const char* value : {"nan", "-1"})
      expect_refusal({"fix", in, "-o", folder / "out.obj", option, value}, 2, option);
}

TEST_F(Usage, InputsThatMakeNoSenseExitWith3) {
  const std::string out = folder / "out.obj";
  expect_refusal({"fix", folder / "missing.obj", "-o", out}, 3, "missing.obj");
  expect_refusal({"check", folder / "missing.obj"}, 3, "missing.obj");
  expect_refusal({"check", folder.string()}, 3, "");
  const std::string wrong = file("wrong.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  expect_refusal({"fix", wrong, "-o", out}, 3, "9");
  expect_refusal({"fix", file("nan.obj", "v 0 0 nan\nf 1 1 1\n"), "-o", out}, 3, "1");
  const std::string in = file("in.obj", crossing);
  expect_refusal({"fix", in, "-o", out, "--fix-vertices", folder / "none.txt"}, 3, "none.txt");
  expect_refusal({"fix", in, "-o", out, "--fix-vertices", file("ids.txt", "0 1\n8 # too large\n")}, 3, "ids.txt:2");
  expect_refusal({"fix", in, "-o", out, "--fix-vertices", file("ids.txt", "0 -1\n")}, 3, "ids.txt:1");
}

TEST_F(Usage, ForeignFormatsAreRefusedWithAHint) {
  const std::string out = folder / "out.obj";
  expect_refusal({"fix", file("a.fbx", "Kaydara FBX Binary"), "-o", out}, 3,
                 "FBX files are not read; import it into Blender");
  expect_refusal({"check", file("b.blend", "")}, 3, "Blend files are not read");
}

TEST_F(Usage, OutputsThatCannotBeWrittenExitWith4) {
  const std::string in = file("in.obj", crossing);
  expect_refusal({"fix", in, "-o", folder / "no/such/folder/out.obj"}, 4, "no/such/folder");
  fs::create_directory(folder / "taken.obj");
  expect_refusal({"fix", in, "-o", folder / "taken.obj"}, 4, "is a folder");
  expect_refusal({"fix", in, "-o", "/dev/full"}, 4, "/dev/full");
  expect_refusal({"check", in, "--pairs", folder / "no/pairs.csv"}, 4, "pairs.csv");
  const RunOptions to_full_disk = {.stdout_path = "/dev/full"};
  EXPECT_EQ(run({"fix", in, "-o", "-"}, to_full_disk).exit_code, 4);
  EXPECT_EQ(run({"check", in}, to_full_disk).exit_code, 4);
  EXPECT_EQ(run({"sample", "book", "-o", "-"}, to_full_disk).exit_code, 4);
}

}  // namespace
}  // namespace unsnarl::cli
