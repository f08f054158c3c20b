#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program_test.h"

namespace unsnarl::cli {
namespace {

using Allow = ProgramTest;

const std::string rock = crossing.substr(0, crossing.find("v 1.2"));
const std::string fish = crossing.substr(crossing.find("v 1.2"), crossing.find("f 1 3 2") - crossing.find("v 1.2"));
const std::string rock_faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n",
                  fish_faces = "f 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n";
/// Reaches into the rock, too, elsewhere.
const std::string gull = "v 0.2 0.3 -0.4\nv 0.9 0.2 -0.5\nv 0.4 0.9 -0.6\nv 0.5 0.5 0.3\n";
const std::string gull_faces = "f 9 10 11\nf 9 12 10\nf 10 12 11\nf 11 12 9\n";

std::string two() {
  return rock + fish + "o rock\nusemtl stone\n" + rock_faces + "o fish\nusemtl skin\n" + fish_faces;
}
std::string three() {
  return rock + fish + gull + "o rock\n" + rock_faces + "o fish\n" + fish_faces + "o gull\n" + gull_faces;
}

TEST_F(Allow, only_what_may_pass_comes_back_byte_for_byte_with8) {
  const std::string in = file("in.obj", two()), out = folder / "out.obj";
  for (const char* rule : {"rock:fish", "object=fish:object=rock", "stone:skin", "0:1", "component=1:rock"}) {
    const Outcome outcome = run({"fix", in, "-o", out, "--allow", rule, "--report", folder / "r.json"});
    EXPECT_EQ(outcome.exit_code, 8) << outcome.err;
    EXPECT_NE(outcome.err.find("allowed: no self-intersection is left but"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("embedded"), std::string::npos) << outcome.err;
    EXPECT_EQ(contents(out), two());
    const auto json = nlohmann::json::parse(contents(folder / "r.json"));
    EXPECT_EQ(json["status"], "allowed");
    EXPECT_EQ(json["exit_code"], 8);
    EXPECT_EQ(json["before"]["total"], 0);
    EXPECT_EQ(json["allowed"]["before"]["total"], pairs_in(in));
    EXPECT_EQ(json["allowed"]["after"]["total"], pairs_in(in));
    EXPECT_EQ(json["options"]["allowed_faces"], 8);
    fs::remove(out);
  }
}

TEST_F(Allow, check_counts_apart_and_exits_with8) {
  const std::string in = file("in.obj", two());
  const Outcome text = run({"check", in, "--allow", "rock:fish"});
  EXPECT_EQ(text.exit_code, 8);
  EXPECT_NE(text.out.find("that may (--allow)\nno other self-intersections"), std::string::npos) << text.out;
  const auto json = nlohmann::json::parse(run({"check", in, "--allow", "rock:fish", "--json"}).out);
  EXPECT_EQ(json["pairs"]["total"], 0);
  EXPECT_EQ(json["allowed"]["total"], pairs_in(in));
  EXPECT_EQ(run({"check", in, "--allow", "rock", "--quiet"}).exit_code, 1) << "the rock alone does not meet itself";
  EXPECT_EQ(run({"check", file("clean.obj", clean_cube), "--allow", "x"}).exit_code, 0);
}

TEST_F(Allow, other_pairs_are_resolved_as_without_it) {
  const std::string in = file("in.obj", three()), out = folder / "out.obj";
  const Outcome outcome = run({"fix", in, "-o", out, "--allow", "rock:fish", "--report", folder / "r.json", "--picture",
                               folder / "p.png", "--view", folder / "v.html"});
  EXPECT_EQ(outcome.exit_code, 8) << outcome.err;
  const auto json = nlohmann::json::parse(contents(folder / "r.json"));
  const std::string left = json["allowed"]["after"]["total"].dump();
  EXPECT_NE(contents(folder / "v.html").find("\"allowed\":{\"before\":" + left + ",\"after\":" + left + "}"),
            std::string::npos);
  EXPECT_GT(json["before"]["total"], 0);
  EXPECT_EQ(json["after"]["total"], 0);
  EXPECT_EQ(pairs_in(out), json["allowed"]["after"]["total"]);
  EXPECT_EQ(run({"check", out, "--allow", "rock:fish"}).exit_code, 8);
  EXPECT_EQ(run({"check", out, "--allow", "rock:gull"}).exit_code, 1);
}

TEST_F(Allow, files_of_a_scene) {
  const std::string one = file("one.obj", rock + rock_faces), two = file("two.obj", fish + rock_faces),
                    three = file("three.obj", gull + rock_faces);
  EXPECT_EQ(run({"check", one, two, "--allow", "one.obj:two.obj"}).exit_code, 8);
  const Outcome outcome = run(
      {"fix", one, two, three, "-o", folder / "out", "--allow", "file=one.obj:two.obj", "--report", folder / "r.json"});
  EXPECT_EQ(outcome.exit_code, 8) << outcome.err;
  EXPECT_NE(outcome.err.find("that may intersect)"), std::string::npos) << outcome.err;
  EXPECT_EQ(contents(folder / "out/two.obj"), fish + rock_faces);
  const auto json = nlohmann::json::parse(contents(folder / "r.json"));
  std::size_t allowed = 0;
  for (const auto& between : json["between_files"]) allowed += between["allowed"]["after"]["total"].get<std::size_t>();
  EXPECT_GT(allowed, 0u);
  EXPECT_EQ(allowed, json["allowed"]["after"]["total"]);
}

TEST_F(Allow, frames_of_a_sequence) {
  const std::string in = file("frame_0.obj", three());
  file("frame_1.obj", three());
  const std::vector<std::string> words = {"fix", "--sequence", in, folder / "frame_1.obj", "-o", folder / "out"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return run(more);
  };
  const Outcome outcome = with({"--allow", "rock:fish", "--report", folder / "r.json"});
  EXPECT_EQ(outcome.exit_code, 8) << outcome.err;
  EXPECT_NE(outcome.err.find("pairs that may intersect"), std::string::npos) << outcome.err;
  const auto json = nlohmann::json::parse(contents(folder / "r.json"));
  EXPECT_EQ(json["list"][1]["status"], "allowed");
  EXPECT_GT(json["list"][1]["allowed"]["after"]["total"], 0);
  EXPECT_NE(with({"--allow", "rock:fish"}).err.find("2 were done before"), std::string::npos);
  EXPECT_EQ(with({"--allow", "rock:gull"}).err.find("done before"), std::string::npos) << "other pairs, other frames";
}

TEST_F(Allow, meshes_of_a_batch) {
  fs::create_directory(folder / "in");
  file("in/two.obj", two());
  const std::vector<std::string> words = {"batch", folder / "in", "-o", folder / "out", "--", "--allow", "rock:fish"};
  EXPECT_EQ(run(words).exit_code, 8);
  const auto row = nlohmann::json::parse(contents(folder / "out/results.jsonl"));
  EXPECT_EQ(row["status"], "allowed");
  EXPECT_EQ(row["allowed_after"], pairs_in(folder / "in/two.obj"));
  EXPECT_NE(contents(folder / "out/results.csv").find("allowed_before,allowed_after"), std::string::npos);
  file("in/one.obj", two() + "o rest\n");
  file("in/clean.obj", "o rock\n" + clean_cube);
  EXPECT_EQ(run(words).exit_code, 1) << "a mesh without a fish does not fit the options";
}

TEST_F(Allow, goes_with_rigid_parts_and_each) {
  const std::string in = file("in.obj", three()), out = folder / "out.obj";
  EXPECT_EQ(
      run({"fix", in, "-o", out, "--allow", "rock:fish", "--rigid", "gull", "--rigid", "fish", "--fix-object", "rock"})
          .exit_code,
      8);
  EXPECT_EQ(run({"fix", in, "-o", out, "--allow", "rock:fish", "--each"}).exit_code, 7)
      << "what --each leaves is first";
  EXPECT_EQ(run({"fix", in, "-o", out, "--allow", "rock:fish", "--max-displacement", "1e-6"}).exit_code, 5);
}

TEST_F(Allow, what_makes_no_sense_is_refused) {
  const std::string in = file("in.obj", two()), out = folder / "out.obj";
  expect_refusal({"fix", in, "-o", out, "--allow", "rock:bird"}, 2,
                 "--allow: there is no part 'bird'; there are: objects 'rock', 'fish'; materials 'stone', 'skin'");
  expect_refusal({"check", in, "--allow", "object=stone"}, 2, "there is no object 'stone'");
  expect_refusal({"fix", in, "-o", out, "--allow", "rock", "--nested", "rock,fish"}, 2, "--nested cannot be combined");
  expect_refusal({"fix", in, "-o", out, "--allow", "rock", "--paper"}, 2, "leave --paper or --allow out");
}

}  // namespace
}  // namespace unsnarl::cli
