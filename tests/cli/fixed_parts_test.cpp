#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "unsnarl/document.h"
#include "unsnarl/parts.h"

namespace unsnarl::cli {
namespace {

using PartsHeld = ProgramTest;

TEST_F(PartsHeld, fixed_vertices_keep_their_tokens) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  EXPECT_EQ(run({"fix", in, "-o", out, "--fix-vertices", file("ids.txt", "0 1 2 3")}).exit_code, 0);
  const std::string fixed_part = crossing.substr(0, crossing.find("v 1.2"));
  EXPECT_EQ(contents(out).substr(0, fixed_part.size()), fixed_part);
  EXPECT_EQ(pairs_in(out), 0u);
}

TEST_F(PartsHeld, named_parts_stay_where_they_are) {
  // The same crossing, with names for its two bodies.
  std::string named = crossing;
  named.insert(named.find("f 1 3 2"), "o rock\ng anchor heavy\nusemtl stone\n");
  named.insert(named.find("f 5 7 6"), "o fish\ng swimmer\nusemtl skin\n");
  const std::string in = file("in.obj", named), out = folder / "out.obj";
  const std::string anchor = named.substr(0, named.find("v 1.2"));
  const std::string swimmer = named.substr(named.find("v 1.2"), named.find("o rock") - named.find("v 1.2"));
  for (const std::vector<std::string>& option : {std::vector<std::string>{"--fix-group", "anchor"},
                                                 {"--fix-group", "anchor heavy"},
                                                 {"--fix-object", "rock"},
                                                 {"--fix-material", "stone"},
                                                 {"--fix-component", "0"},
                                                 {"--only-group", "swimmer"},
                                                 {"--only-object", "fish"},
                                                 {"--only-material", "skin"},
                                                 {"--only-component", "1"}}) {
    const Outcome outcome = run({"fix", option[0], option[1], in, "-o", out});
    EXPECT_EQ(outcome.exit_code, 0) << option[0] << outcome.err;
    EXPECT_EQ(contents(out).substr(0, anchor.size()), anchor) << option[0];
    EXPECT_EQ(contents(out).find(swimmer), std::string::npos) << option[0];
    EXPECT_EQ(pairs_in(out), 0u) << option[0];
    fs::remove(out);
  }
  expect_refusal({"fix", in, "-o", out, "--fix-group", "anker"}, 2,
                 "--fix-group: there is no group 'anker'; there are: 'anchor heavy', 'swimmer'");
  expect_refusal({"fix", in, "-o", out, "--only-object", "bird"}, 2, "--only-object: there is no object 'bird'");
  expect_refusal({"fix", in, "-o", out, "--fix-component", "2"}, 2, "the mesh has 2");
  expect_refusal({"fix", in, "-o", out, "--fix-file", "in.obj"}, 2, "--fix-file needs several input files");
  // Several times, and everything: nothing is left that could move.
  const Outcome all = run({"fix", in, "-o", out, "--fix-group", "anchor", "--fix-group", "swimmer"});
  EXPECT_EQ(all.exit_code, 7) << all.err;
  EXPECT_NE(all.err.find("inside parts that you told unsnarl to keep fixed"), std::string::npos) << all.err;
  EXPECT_FALSE(fs::exists(out));
  // Closed bodies have no boundary to hold.
  EXPECT_EQ(run({"fix", in, "-o", out, "--fix-boundary"}).exit_code, 0);
}

TEST_F(PartsHeld, boundaries_can_be_held) {
  const std::string in = sample("crossing_tubes", {"--resolution", "16"}), out = folder / "out.obj";
  EXPECT_EQ(run({"fix", in, "-o", out, "--fix-boundary", "--report", folder / "r.json"}).exit_code, 0);
  const Surface before = Document::read(in).surface(), after = Document::read(out).surface();
  const std::vector<std::uint8_t> held = boundary_vertices(before);
  std::size_t count = 0;
  for (std::size_t v = 0; v < held.size(); ++v) {
    count += held[v];
    if (held[v]) {
      EXPECT_TRUE(std::equal(&before.positions[3 * v], &before.positions[3 * v] + 3, &after.positions[3 * v]));
    }
  }
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "r.json"))["options"]["fixed_vertices"], count);
  EXPECT_GT(count, 0u);
}

TEST_F(PartsHeld, an_anchor_holds_and_the_scene_gives_way) {
  const std::string in = sample("anchored_balls", {"--resolution", "16"}), out = folder / "out.obj";
  const Outcome outcome = run({"fix", in, "-o", out, "--fix-group", "anchor"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(pairs_in(out), 0u);
  const std::string text = contents(in);
  std::size_t end = 0;  // of the anchor's vertices: 6 n^2 + 2 with n = 4, and the comment
  for (int line = 0; line < 6 * 16 + 2 + 1; ++line) end = text.find('\n', end) + 1;
  EXPECT_EQ(contents(out).substr(0, end), text.substr(0, end));
}

TEST_F(PartsHeld, what_lies_outside_of_a_region_is_left_and_said) {
  // Two crossings; only one of them is to be repaired.
  const Document one = Document::parse(crossing, Format::obj);
  std::string two = crossing;
  for (std::size_t v = 0; v < 8; ++v)
    two += fmt::format("v {} {} {}\n", 100 + one.surface().positions[3 * v], one.surface().positions[3 * v + 1],
                       one.surface().positions[3 * v + 2]);
  for (std::size_t f = 0; f < 8; ++f)
    two += fmt::format("f {} {} {}\n", 9 + one.surface().view().face(f)[0], 9 + one.surface().view().face(f)[1],
                       9 + one.surface().view().face(f)[2]);
  const std::string in = file("in.obj", two), out = folder / "out.obj", report = folder / "r.json";
  const Outcome outcome =
      run({"fix", in, "-o", out, "--only-component", "0", "--only-component", "1", "--report", report});
  EXPECT_EQ(outcome.exit_code, 7) << outcome.err;
  EXPECT_EQ(pairs_in(out), pairs_in(in) / 2);
  const auto json = nlohmann::json::parse(contents(report));
  EXPECT_EQ(json["status"], "obstructed");
  EXPECT_EQ(json["obstructions"][0]["kind"], "fixed_faces");
  EXPECT_EQ(json["left"]["by_reason"]["fixed_faces"], json["after"]["total"]);
  ASSERT_EQ(json["left"]["pairs"].size(), json["after"]["total"]);
  EXPECT_EQ(json["left"]["pairs"][0]["reason"], "fixed_faces");
  EXPECT_GE(json["left"]["pairs"][0]["faces"][0], 8);
  EXPECT_NE(outcome.err.find("inside parts that you told unsnarl to keep fixed"), std::string::npos) << outcome.err;
}

TEST_F(PartsHeld, each_component_by_itself) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  const Outcome outcome = run({"fix", in, "-o", out, "--each"});
  EXPECT_EQ(outcome.exit_code, 7) << outcome.err;
  EXPECT_NE(outcome.err.find("different components"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(run({"fix", in, "-o", out, "--together"}).exit_code, 0);
  EXPECT_EQ(run({"fix", in, "-o", out, "--each", "--together"}).exit_code, 2);
}

}  // namespace
}  // namespace unsnarl::cli
