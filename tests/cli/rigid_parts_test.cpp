#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "unsnarl/document.h"

namespace unsnarl::cli {
namespace {

using RigidParts = ProgramTest;

/// The crossing, with names for its two bodies.
std::string named_crossing() {
  std::string named = crossing;
  named.insert(named.find("f 1 3 2"), "o rock\ng anchor heavy\nusemtl stone\n");
  named.insert(named.find("f 5 7 6"), "o fish\ng swimmer\nusemtl skin\n");
  return named;
}

TEST_F(RigidParts, move_as_bodies_however_named) {
  const std::string in = file("in.obj", named_crossing()), out = folder / "out.obj";
  for (const std::vector<std::string>& option : {std::vector<std::string>{"--rigid", "fish"},
                                                 {"--rigid-object", "fish"},
                                                 {"--rigid-group", "swimmer"},
                                                 {"--rigid-material", "skin"},
                                                 {"--rigid-component", "1"}}) {
    const Outcome outcome =
        run({"fix", in, "-o", out, option[0], option[1], "--fix-object", "rock", "--report", folder / "r.json"});
    EXPECT_EQ(outcome.exit_code, 0) << option[0] << outcome.err;
    EXPECT_NE(outcome.err.find("shifted by"), std::string::npos) << outcome.err;
    EXPECT_EQ(pairs_in(out), 0u);
    // Edges of the fish are as long as they were, to the digits of 32 bits.
    const Surface before = Document::read(in).surface(), after = Document::read(out).surface();
    const auto length = [](const Surface& surface, std::size_t v, std::size_t w) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        sum += std::pow(surface.positions[3 * v + k] - surface.positions[3 * w + k], 2);
      return std::sqrt(sum);
    };
    for (std::size_t v = 4; v < 8; ++v)
      for (std::size_t w = 4; w < v; ++w) EXPECT_NEAR(length(after, v, w), length(before, v, w), 2e-6);
    const auto json = nlohmann::json::parse(contents(folder / "r.json"));
    ASSERT_EQ(json["rigid_parts"].size(), 1u);
    const auto& part = json["rigid_parts"][0];
    EXPECT_EQ(part["name"], option[0] == "--rigid-component" ? "component 1" : option[1]);
    EXPECT_EQ(part["vertices"], 4);
    EXPECT_LT(part["residual_rel"], 4e-7);
    EXPECT_GT(part["translation_rel"].get<double>() + part["rotation_deg"].get<double>(), 0);
    EXPECT_EQ(part["rotation"].size(), 9u);
    EXPECT_EQ(json["options"]["rigid_vertices"], 4);
    // What is embedded stays, to the byte.
    const std::string first = contents(out), again = folder / "again.obj";
    EXPECT_EQ(run({"fix", out, "-o", again, option[0], option[1], "--fix-object", "rock"}).exit_code, 0);
    EXPECT_EQ(contents(again), first);
  }
}

TEST_F(RigidParts, files_of_a_scene_and_parts_of_a_glb) {
  const std::string one =
      file("one.obj", crossing.substr(0, crossing.find("v 1.2")) + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const std::string two = file("two.obj",
                               "v 1.2 1.2 1.1\nv 2.6 2.5 2\nv 2.5 2.6 2.2\nv 2.4 2.4 2.7\n"
                               "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const Outcome outcome =
      run({"fix", one, two, "-o", folder / "out", "--rigid-file", "two.obj", "--fix-file", "one.obj"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("rigid two.obj: shifted"), std::string::npos) << outcome.err;
  const std::string scene = folder / "scene.glb", out = folder / "out.glb";
  ASSERT_EQ(run({"sample", "anchor_scene", "--resolution", "16", "-o", scene}).exit_code, 0);
  const Outcome glb = run({"fix", scene, "-o", out, "--fix-object", "anchor", "--rigid", "crate", "--rigid", "hoop",
                           "--rigid", "link", "--rigid", "barrel", "--report", folder / "r.json"});
  EXPECT_EQ(glb.exit_code, 0) << glb.err;
  EXPECT_EQ(pairs_in(out), 0u);
  for (const auto& part : nlohmann::json::parse(contents(folder / "r.json"))["rigid_parts"])
    EXPECT_LT(part["residual_rel"], 4e-7) << part["name"];
}

TEST_F(RigidParts, what_makes_no_sense_is_refused) {
  const std::string in = file("in.obj", named_crossing()), out = folder / "out.obj";
  expect_refusal({"fix", in, "-o", out, "--rigid", "bird"}, 2, "there is no object 'bird'; there are: 'rock', 'fish'");
  expect_refusal({"fix", in, "-o", out, "--rigid", "fish", "--fix-object", "fish"}, 2,
                 "'fish' cannot move as a rigid body");
  expect_refusal({"fix", in, "-o", out, "--rigid", "fish", "--only-object", "rock"}, 2,
                 "'fish' cannot move as a rigid body");
  expect_refusal({"fix", in, "-o", out, "--rigid", "fish", "--rigid-component", "1"}, 2, "vertex 4 in common");
  expect_refusal({"fix", in, "-o", out, "--rigid", "fish", "--each"}, 2, "--each");
  expect_refusal({"fix", "--sequence", in, "-o", folder / "frames", "--rigid", "fish"}, 2,
                 "--rigid does not work with --sequence");
}

TEST_F(RigidParts, what_intersects_within_one_is_named) {
  const std::string out = folder / "out.obj";
  // As one part.
  const std::string together = file("one.obj", "o all\n" + crossing);
  const Outcome outcome = run({"fix", together, "-o", out, "--rigid", "all", "--report", folder / "r.json"});
  EXPECT_EQ(outcome.exit_code, 7) << outcome.err;
  EXPECT_NE(outcome.err.find("inside a rigid part"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(out));
  const auto json = nlohmann::json::parse(contents(folder / "r.json"));
  EXPECT_EQ(json["obstructions"][0]["kind"], "rigid_faces");
  EXPECT_EQ(json["left"]["by_reason"]["rigid_faces"], json["after"]["total"]);
}

}  // namespace
}  // namespace unsnarl::cli
