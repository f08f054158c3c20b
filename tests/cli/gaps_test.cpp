// --min-gap and --gap-near-conflicts: what is written, said and returned.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program_test.h"

namespace unsnarl::cli {
namespace {

using Gaps = ProgramTest;

/// Two tetrahedra whose faces in the planes z = 0 and z = -0.001 lie one above the other.
const std::string near =
    "o upper\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
    "o lower\nv 0 0 -0.001\nv 1 0 -0.001\nv 0 1 -0.001\nv 0 0 -1\nf 5 6 7\nf 5 8 6\nf 6 8 7\nf 5 7 8\n";

TEST_F(Gaps, that_are_too_small_are_opened_and_named) {
  const std::string in = file("in.obj", near), out = folder / "out.obj", report = folder / "report.json";
  const Outcome fix = run({"fix", in, "-o", out, "--min-gap", "0.02", "--absolute", "--report", report});
  EXPECT_EQ(fix.exit_code, 0) << fix.err;
  EXPECT_NE(fix.err.find("smallest gap 0.02"), std::string::npos) << fix.err;
  EXPECT_NE(fix.err.find(", asked for 0.02: between faces "), std::string::npos) << fix.err;
  const auto json = nlohmann::json::parse(contents(report));
  EXPECT_EQ(json["status"], "embedded");
  EXPECT_TRUE(json["gap"]["met"]);
  EXPECT_NEAR(json["gap"]["asked"], 0.02, 1e-12);
  EXPECT_GE(json["gap"]["smallest"], 0.99 * 0.02);
  EXPECT_NEAR(json["gap"]["smallest_rel"], json["clearance"]["after"]["component_gap_rel"]["value"], 1e-9);
  EXPECT_EQ(run({"check", out, "--min-gap", "0.0199", "--absolute"}).exit_code, 0);
}

TEST_F(Gaps, that_are_not_met_exit_with10_and_the_result_is_written) {
  const std::string in = file("in.obj", near), out = folder / "out.obj", report = folder / "report.json";
  const Outcome fix = run({"fix", in, "-o", out, "--min-gap", "0.02", "--absolute", "--fix-object", "upper",
                           "--fix-object", "lower", "--report", report});
  EXPECT_EQ(fix.exit_code, 10) << fix.err;
  EXPECT_NE(fix.err.find("smallest gap 0.001, asked for 0.02: between faces "), std::string::npos) << fix.err;
  EXPECT_NE(fix.err.find("; neither may move\n"), std::string::npos) << fix.err;
  EXPECT_NE(fix.err.find("gap not met: "), std::string::npos) << fix.err;
  EXPECT_EQ(contents(out), near);
  const auto json = nlohmann::json::parse(contents(report));
  EXPECT_EQ(json["status"], "gap_not_met");
  EXPECT_EQ(json["exit_code"], 10);
  EXPECT_FALSE(json["gap"]["met"]);
  EXPECT_TRUE(json["gap"]["between_held"]);
  EXPECT_NEAR(json["gap"]["position"][2], -0.0005, 1e-12);
}

TEST_F(Gaps, near_conflicts_alone_leave_the_others) {
  const std::string in = file("in.obj", near), out = folder / "out.obj", report = folder / "report.json";
  const Outcome fix =
      run({"fix", in, "-o", out, "--min-gap", "0.02", "--absolute", "--gap-near-conflicts", "--report", report});
  EXPECT_EQ(fix.exit_code, 0) << fix.err;
  EXPECT_EQ(fix.err.find("smallest gap"), std::string::npos);
  EXPECT_EQ(contents(out), near);
  const auto json = nlohmann::json::parse(contents(report));
  EXPECT_TRUE(json["gap"].is_null());
  EXPECT_TRUE(json["options"]["gap_near_conflicts"]);
  const Outcome alone = run({"fix", in, "-o", out, "--gap-near-conflicts"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("--gap-near-conflicts has an effect only with --min-gap"), std::string::npos);
}

TEST_F(Gaps, are_measured_by_check) {
  const std::string in = file("in.obj", near);
  const Outcome small = run({"check", in, "--min-gap", "0.02", "--absolute"});
  EXPECT_EQ(small.exit_code, 10);
  EXPECT_NE(small.out.find("smallest gap 0.001, asked for 0.02: between faces "), std::string::npos) << small.out;
  EXPECT_EQ(run({"check", in, "--min-gap", "0.0009", "--absolute"}).exit_code, 0);
  EXPECT_EQ(run({"check", in}).exit_code, 0);
  const Outcome json = run({"check", in, "--min-gap", "0.01", "--json"});
  EXPECT_EQ(json.exit_code, 10);
  EXPECT_FALSE(nlohmann::json::parse(json.out)["gap"]["met"]);
  EXPECT_TRUE(nlohmann::json::parse(run({"check", in, "--json"}).out)["gap"].is_null());
  EXPECT_EQ(run({"check", file("crossing.obj", crossing), "--min-gap", "0.01"}).exit_code, 1);
  EXPECT_EQ(run({"check", in, "--absolute"}).exit_code, 2);
}

TEST_F(Gaps, of_what_may_pass_do_not_count) {
  const std::string third =
      "o lowest\nv 0 0 -1.001\nv 1 0 -1.001\nv 0 1 -1.001\nv 0 0 -2\n"
      "f 9 10 11\nf 9 12 10\nf 10 12 11\nf 9 11 12\n";
  const std::string in = file("in.obj", near + third), out = folder / "out.obj";
  const std::vector<std::string> gap = {"--min-gap", "0.02", "--absolute", "--allow", "upper:lower"};
  const auto with_gap = [&](std::vector<std::string> words) {
    words.insert(words.end(), gap.begin(), gap.end());
    return run(words);
  };
  EXPECT_EQ(with_gap({"check", in}).exit_code, 10);
  const Outcome fix = with_gap({"fix", in, "-o", out});
  EXPECT_EQ(fix.exit_code, 0) << fix.err;
  EXPECT_EQ(contents(out).substr(0, contents(out).find("o lower")), near.substr(0, near.find("o lower")));
  EXPECT_EQ(with_gap({"check", out}).exit_code, 0);
  EXPECT_EQ(run({"check", out, "--min-gap", "0.02", "--absolute"}).exit_code, 10);
}

TEST_F(Gaps, are_kept_between_files_of_a_scene_too) {
  const std::string split = "o lower\n";
  const std::string upper = near.substr(0, near.find(split));
  std::string lower = "v 0 0 -0.001\nv 1 0 -0.001\nv 0 1 -0.001\nv 0 0 -1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n";
  const Outcome fix = run({"fix", file("upper.obj", upper), file("lower.obj", lower), "-o", folder / "out", "--min-gap",
                           "0.02", "--absolute", "--fix-file", "upper.obj"});
  EXPECT_EQ(fix.exit_code, 0) << fix.err;
  EXPECT_EQ(contents(folder / "out/upper.obj"), upper);
  EXPECT_NE(contents(folder / "out/lower.obj"), lower);
}

TEST_F(Gaps, of_frames_and_of_a_batch_are_met_or_said) {
  for (const char* name : {"f1.obj", "f2.obj"}) file(name, near);
  const auto sequence = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        "fix",       "--sequence", folder / "f1.obj", folder / "f2.obj", "-o", folder / more.back().substr(2),
        "--min-gap", "0.02"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words).exit_code;
  };
  EXPECT_EQ(sequence({"--absolute"}), 0);
  EXPECT_EQ(sequence({"--absolute", "--fix-component", "0", "--fix-component", "1", "--quiet"}), 10);
  const Outcome batch = run({"batch", file("list.txt", (folder / "f1.obj") + "\n"), "-o", folder / "batch", "--",
                             "--min-gap", "0.02", "--absolute", "--fix-component", "0", "--fix-component", "1"});
  EXPECT_EQ(batch.exit_code, 10);
  EXPECT_NE(batch.err.find("1 gap_not_met"), std::string::npos) << batch.err;
}

}  // namespace
}  // namespace unsnarl::cli
