#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program_test.h"
#include "unsnarl/document.h"

namespace unsnarl::cli {
namespace {

using Fix = ProgramTest;

TEST_F(Fix, clean_input_comes_back_byte_for_byte) {
  const std::string in = file("in.obj", clean_cube), out = folder / "out.obj";
  const Outcome outcome = run({"fix", in, "-o", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(contents(out), clean_cube);
  EXPECT_EQ(contents(in), clean_cube);
}

TEST_F(Fix, repairs_and_keeps_everything_else) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  EXPECT_GT(pairs_in(in), 0u);
  const Outcome outcome = run({"fix", in, "-o", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("embedded"), std::string::npos);
  EXPECT_EQ(pairs_in(out), 0u);
  EXPECT_EQ(contents(in), crossing);
  EXPECT_NE(contents(out).find("# top"), std::string::npos);
  EXPECT_EQ(contents(out).substr(contents(out).find("f 1 3 2")), crossing.substr(crossing.find("f 1 3 2")));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj", "out.obj"}));
}

TEST_F(Fix, parts_that_change_and_parts_that_overlap_are_named) {
  const std::string in = sample("stool", {"--resolution", "16"}), json = folder / "r.json";
  // Each rung is longer than the room between its legs.
  const Outcome outcome = run({"fix", in, "-o", folder / "out.obj", "--fix-object", "leg", "--fix-object", "leg_2",
                               "--fix-object", "leg_3", "--fix-object", "leg_4", "--report", json});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = nlohmann::json::parse(contents(json));
  ASSERT_FALSE(report["changed_components"].empty());
  for (const auto& component : report["changed_components"]) {
    EXPECT_NE(outcome.err.find("  " + component["message"].get<std::string>() + "\n"), std::string::npos)
        << outcome.err;
    EXPECT_FALSE(component["name"].get<std::string>().starts_with("leg")) << "what is fixed does not change";
  }
  ASSERT_EQ(report["overlapping_components"].size(), 2u);
  EXPECT_EQ(report["overlapping_components"][0]["name"], "rung");
  EXPECT_EQ(report["overlapping_components"][1]["name"], "rung_2");
  EXPECT_NEAR(report["overlapping_components"][0]["volume_share"], report["overlapping_components"][1]["volume_share"],
              0.05);
  const std::string advice = report["advice"].at(0);
  EXPECT_NE(outcome.err.find("  advice: " + advice + "\n"), std::string::npos) << outcome.err;
  EXPECT_NE(run({"check", in}).out.find("advice: " + advice + "\n"), std::string::npos);
  const auto found = nlohmann::json::parse(run({"check", in, "--json"}).out);
  EXPECT_EQ(found["advice"], report["advice"]);
  EXPECT_EQ(found["overlapping_components"], report["overlapping_components"]);
}

TEST_F(Fix, quiet_says_nothing) {
  const std::string in = file("in.obj", crossing);
  const Outcome outcome = run({"fix", in, "-o", folder / "out.obj", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  const Outcome check = run({"check", in, "--quiet"});
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_EQ(check.out + check.err, "");
}

TEST_F(Fix, in_place_replaces_the_input_and_keeps_its_permissions) {
  const std::string in = file("in.obj", crossing);
  fs::permissions(in, fs::perms(0640));
  fs::create_symlink("in.obj", folder / "link.obj");
  EXPECT_EQ(run({"fix", folder / "link.obj", "--in-place"}).exit_code, 0);
  EXPECT_EQ(pairs_in(in), 0u);
  EXPECT_EQ(fs::status(in).permissions(), fs::perms(0640));
  EXPECT_TRUE(fs::is_symlink(folder / "link.obj"));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj", "link.obj"}));
}

TEST_F(Fix, output_is_replaced_only_by_success) {
  const std::string in = file("in.obj", hopeless), out = file("out.obj", "precious");
  const std::string ids = file("ids.txt", "1 2 3 4 5\n");
  const Outcome outcome = run({"fix", in, "-o", out, "--fix-vertices", ids});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(contents(out), "precious");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj", "out.obj", "ids.txt"}));
}

TEST_F(Fix, nothing_better_than_the_input_exits_with1) {
  const std::string in = file("in.obj", hopeless), out = folder / "out.obj", report = folder / "report.json";
  const std::string ids = file("ids.txt", "1 2 # those around it\n3 4 5\n");
  const Outcome outcome = run({"fix", in, "-o", out, "--fix-vertices", ids, "--report", report});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_FALSE(fs::exists(out));
  const auto json = nlohmann::json::parse(contents(report));
  EXPECT_EQ(json["exit_code"], 1);
  EXPECT_EQ(json["output"]["written"], false);
  EXPECT_EQ(json["options"]["fixed_vertices"], 5);
  // With --keep-partial what was reached is written, and it is no worse.
  EXPECT_EQ(run({"fix", in, "-o", out, "--fix-vertices", ids, "--keep-partial"}).exit_code, 1);
  EXPECT_LE(pairs_in(out), pairs_in(in));
}

TEST_F(Fix, both_diagonals_of_quads_count_where_asked_for) {
  const std::string in = file("in.obj",
                              "v 0 0 0\nv 4 0 1\nv 4 4 0\nv 0 4 1\nv 1.9 2.1 0.6\nv 2.2 1.9 0.5\nv 2 2 3\n"
                              "f 1 2 3 4\nf 5 6 7\n");
  const std::string out = folder / "out.obj";
  EXPECT_EQ(run({"check", in}).exit_code, 0);
  EXPECT_EQ(run({"check", in, "--both-diagonals"}).exit_code, 1);
  const Outcome outcome = run({"fix", in, "-o", out, "--both-diagonals"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(run({"check", out, "--both-diagonals"}).exit_code, 0);
}

TEST_F(Fix, obstructed_exits_with7) {
  const std::string bottle = sample("klein_bottle"), out = folder / "out.obj";
  const Outcome refused = run({"fix", bottle, "-o", out});
  EXPECT_EQ(refused.exit_code, 7) << refused.err;
  EXPECT_NE(refused.err.find("non-orientable"), std::string::npos);
  EXPECT_FALSE(fs::exists(out));

  // With something else to repair the result is written, and only the obstruction is left.
  const Surface surface = Document::read(bottle).surface();
  std::ostringstream both;
  both << contents(bottle);
  for (int i = 0; i < 2; ++i)
    both << "v 100 0 " << i << "\nv 104 0 " << i << "\nv 100 4 " << i << "\nv 101 1 " << i + 4 - 6 * i << "\n";
  const auto n = static_cast<int>(surface.positions.size() / 3);
  for (int i = 0; i < 2; ++i)
    for (const auto& f : {std::array{1, 3, 2}, {1, 2, 4}, {2, 3, 4}, {3, 1, 4}})
      both << "f " << n + 4 * i + f[0] << ' ' << n + 4 * i + f[1] << ' ' << n + 4 * i + f[2] << '\n';
  const std::string in = file("both.obj", both.str());
  ASSERT_GT(pairs_in(in), pairs_in(bottle));
  EXPECT_EQ(run({"fix", in, "-o", out}).exit_code, 7);
  ASSERT_TRUE(fs::exists(out));
  EXPECT_EQ(pairs_in(out), pairs_in(bottle));
}

TEST_F(Fix, the_first_obstructions_of_a_kind_are_named) {
  std::ostringstream doubled;
  for (int i = 0; i < 7; ++i) doubled << "v " << 9 * i << " 0 0\nv " << 9 * i << " 4 0\nv " << 9 * i << " 0 4\n";
  for (int i = 0; i < 7; ++i)
    for (int k = 0; k < 2; ++k) doubled << "f " << 3 * i + 1 << ' ' << 3 * i + 2 << ' ' << 3 * i + 3 << '\n';
  const std::string in = file("doubled.obj", doubled.str());
  const Outcome outcome = run({"fix", in, "-o", folder / "out.obj"});
  EXPECT_EQ(outcome.exit_code, 7);
  EXPECT_NE(outcome.err.find("faces 8, 9 lie on the same three vertices"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("faces 10, 11"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("not repaired: 2 more of this kind (duplicate_faces)"), std::string::npos);
}

TEST_F(Fix, float32_that_is_asked_for_is_binding) {
  const std::string in = file("near.obj",
                              "v 0 0 1\nv 1 0 1\nv 0 1 1\nv 0 0 1.0000000001\nv 1 0 1.0000000001\n"
                              "v 0 1 1.0000000001\nf 1 2 3\nf 4 5 6\n");
  const std::string all = file("all.txt", "0 1 2 3 4 5\n");
  EXPECT_EQ(run({"fix", in, "-o", folder / "out.obj", "--fix-vertices", all}).exit_code, 0);
  const Outcome asked = run({"fix", in, "-o", folder / "32.obj", "--fix-vertices", all, "--precision", "float32"});
  EXPECT_EQ(asked.exit_code, 1);
  EXPECT_NE(asked.err.find("in 32 bits, as asked for"), std::string::npos) << asked.err;
}

TEST_F(Fix, standard_input_and_output) {
  const Outcome outcome = run({"fix", "-", "--format", "obj", "-o", "-"}, {.input = crossing});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  write(folder / "out.obj", outcome.out);
  EXPECT_EQ(pairs_in(folder / "out.obj"), 0u);
  EXPECT_EQ(run({"fix", "-", "--format", "obj", "-o", "-"}, {.input = clean_cube}).out, clean_cube);
  EXPECT_EQ(run({"check", "-", "--format", "obj"}, {.input = crossing}).exit_code, 1);
  EXPECT_EQ(run({"fix", "-", "--format", "obj", "-o", "-", "--report", "-"}, {.input = crossing}).exit_code, 2);
}

TEST_F(Fix, same_bytes_at_any_thread_count) {
  const std::string in = file("in.obj", crossing);
  std::set<std::string> results;
  for (const char* threads : {"1", "2", "4"}) results.insert(run({"fix", in, "-o", "-", "--threads", threads}).out);
  EXPECT_EQ(results.size(), 1u);
}

}  // namespace
}  // namespace unsnarl::cli
