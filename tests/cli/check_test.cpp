#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program_test.h"

namespace unsnarl::cli {
namespace {

using Check = ProgramTest;

TEST_F(Check, check_counts_and_locates) {
  const std::string in = file("in.obj", crossing);
  const Outcome text = run({"check", in, "--pairs", folder / "pairs.csv"});
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_EQ(text.err, "");
  EXPECT_NE(text.out.find("disjoint"), std::string::npos);
  const Outcome outcome = run({"check", in, "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["schema"], "unsnarl-check");
  EXPECT_EQ(json["options"]["both_diagonals"], false);
  EXPECT_EQ(nlohmann::json::parse(run({"check", in, "--json", "--both-diagonals"}).out)["options"]["both_diagonals"],
            true);
  EXPECT_EQ(json["pairs"]["total"], pairs_in(in));
  EXPECT_EQ(json["components"]["intersecting"], 2);
  EXPECT_EQ(json["components"]["pairs_between"], pairs_in(in));
  ASSERT_EQ(json["components"]["list"].size(), 2u);
  EXPECT_EQ(json["components"]["list"][1]["first_face"], 4);
  EXPECT_EQ(json["components"]["list"][1]["pairs_with_others"], pairs_in(in));
  EXPECT_EQ(json["components"]["list"][1]["pairs_within"], 0);
  EXPECT_NE(text.out.find("component 1"), std::string::npos);
  ASSERT_EQ(json["places"].size(), 1u);
  EXPECT_EQ(json["places"][0]["pairs"], pairs_in(in));
  EXPECT_EQ(json["topology"]["closed_components"], 2);
  std::istringstream table(contents(folder / "pairs.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "face_a,face_b,class");
  std::size_t rows = 0;
  while (std::getline(table, line)) ++rows;
  EXPECT_EQ(rows, pairs_in(in));

  const Outcome clean = run({"check", file("clean.obj", clean_cube)});
  EXPECT_EQ(clean.exit_code, 0);
  EXPECT_NE(clean.out.find("no self-intersections"), std::string::npos);
}

TEST_F(Check, parts_that_options_can_name_are_listed_with_their_sizes) {
  const std::string in = file("in.obj",
                              "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 2\nv 2 1 2\n"
                              "o sheet\ng flat lower\nusemtl red\nf 1 2 3\no blade\ng upright\nf 4 5 6\n");
  const std::string text = run({"check", in}).out;
  for (const char* line : {"  object sheet: 1 face, 3 vertices\n", "  object blade: 1 face, 3 vertices\n",
                           "  group flat lower: 1 face, 3 vertices\n", "  group upright: 1 face, 3 vertices\n",
                           "  material red: 2 faces, 6 vertices\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  EXPECT_NE(text.find("component 1        1 face       3 vertices"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(run({"check", in, "--json"}).out);
  ASSERT_EQ(json["parts"].size(), 5u);
  EXPECT_EQ(json["parts"][2],
            (nlohmann::json{{"kind", "group"}, {"name", "flat lower"}, {"faces", 1}, {"vertices", 3}}));
  EXPECT_EQ(json["components"]["list"][1]["vertices"], 3);
  // What is listed can be named.
  for (const auto& part : json["parts"])
    EXPECT_EQ(run({"fix", in, "-o", folder / "out.obj", "--keep-partial", "--fix-" + part["kind"].get<std::string>(),
                   part["name"].get<std::string>()})
                  .exit_code,
              part["name"] == "red" ? 7 : 0);
  // Of very many the text names the first ones and counts the others.
  std::string many = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 30; ++i) many += "g part" + std::to_string(i) + "\n";
  const std::string long_list = run({"check", file("many.obj", many + "f 1 2 3\n")}).out;
  EXPECT_NE(long_list.find("more groups (--json lists all)"), std::string::npos) << long_list;
}

TEST_F(Check, one_pair_is_no_pairs) {
  // A folded pair of faces with a common edge, and a face far away.
  const std::string in = file("in.obj",
                              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.9 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\n"
                              "f 1 2 3\nf 2 1 4\nf 5 6 7\n");
  const std::string text = run({"check", in}).out;
  EXPECT_NE(text.find("1 pair  within"), std::string::npos) << text;
  EXPECT_NE(text.find("1 pair of faces intersects: 2 faces in 1 component;"), std::string::npos) << text;
}

TEST_F(Check, check_for_the_goal_disjoint_sees_no_others) {
  // Two faces of one fan pass through each other at their common vertex only.
  const std::string in = file("in.obj", "v 0 0 0\nv 2 -1 0\nv 2 1 0\nv 2 0 -1\nv 2 0 1\nf 1 2 3\nf 1 4 5\n");
  EXPECT_EQ(run({"check", in}).exit_code, 1);
  EXPECT_EQ(run({"check", in, "--goal", "disjoint"}).exit_code, 0);
}

TEST_F(Check, weld_decides_what_touching_means) {
  // Two triangles with a common side, written with corners of their own.
  const std::string in = file("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 0\nv 1 0 0\nv 1 1 1\nf 1 2 3\nf 4 5 6\n");
  EXPECT_EQ(run({"check", in}).exit_code, 0);
  EXPECT_EQ(run({"check", in, "--weld", "none"}).exit_code, 1);
  const std::string near =
      file("near.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0.001 1 0\nv 0.999 0 0\nv 1 1 0\nf 1 2 3\nf 4 5 6\n");
  EXPECT_EQ(run({"check", near}).exit_code, 1);
  EXPECT_EQ(run({"check", near, "--weld-tolerance", "0.01"}).exit_code, 0);
}

/// Triangles through one line, with corners of their own: every two intersect.
std::string bundle(int count) {
  std::string obj;
  for (int t = 0; t < count; ++t) {
    const double angle = 3.0 * t / count, shift = 1e-3 * t;
    obj += fmt::format("v {} {} {}\nv {} {} {}\nv 0 0 {}\nf {} {} {}\n", -std::cos(angle), -std::sin(angle), shift - 9,
                       std::cos(angle), std::sin(angle), shift - 9, shift + 9, 3 * t + 1, 3 * t + 2, 3 * t + 3);
  }
  return obj;
}

TEST_F(Check, memory_does_not_follow_the_number_of_pairs) {
  if (!memory_can_be_limited) GTEST_SKIP() << "the sanitizer needs all addresses";
  constexpr int count = 3000;
  const std::string in = file("in.obj", bundle(count));
  // A list of them all is 54 MB.
  const Outcome outcome = run({"check", in, "--json", "--memory-limit", "55", "--threads", "1"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["pairs"]["total"], count * (count - 1) / 2);
}

TEST_F(Check, limits_of_time_and_memory_exit_with5) {
  const std::string in = file("in.obj", bundle(1000)), table = folder / "pairs.csv";
  expect_refusal({"check", in, "--time-limit", "0.001"}, 5, "raise --time-limit");
  if (!memory_can_be_limited) return;
  expect_refusal({"check", in, "--memory-limit", "20", "--threads", "1"}, 5, "raise --memory-limit");
  expect_refusal({"check", in, "--memory-limit", "20", "--pairs", table, "--threads", "1"}, 5, "raise --memory-limit");
}

}  // namespace
}  // namespace unsnarl::cli
