#include <gtest/gtest.h>

#include <sstream>

#include "cli/program_test.h"
#include "unsnarl/document.h"

namespace unsnarl::cli {
namespace {

using Samples = ProgramTest;

TEST_F(Samples, samples_are_listed_described_and_written) {
  const Outcome list = run({"sample", "--list"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_NE(list.out.find("whitney_umbrella"), std::string::npos);
  for (const char* others :
       {"\n\nRandom closed curves, for 'unsnarl curves': curve_waves, ", "\nKnots, for 'unsnarl sei",
        "\nUnknots, for 'unsnarl kn", "\nPlans, for 'unsnarl routes': routes_"})
    EXPECT_NE(list.out.find(others), std::string::npos) << others;
  EXPECT_EQ(list.err, "");
  const Outcome one = run({"sample", "book", "--list"});
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_NE(one.out.find("--set"), std::string::npos);
  const std::string obj = sample("book");
  for (const std::string format : {"off", "ply"}) {
    const std::string path = folder / ("book." + format);
    EXPECT_EQ(run({"sample", "book", "-o", path}).exit_code, 0);
    const Surface written = Document::read(path).surface(), expected = Document::read(obj).surface();
    EXPECT_EQ(written.positions, expected.positions);
    EXPECT_EQ(written.corners, expected.corners);
  }
  EXPECT_EQ(run({"sample", "book", "-o", "-"}).out, contents(obj));
}

TEST_F(Samples, unknown_ones_are_named_before_all_else) {
  for (const auto& [name, meant] : {std::pair("crossing_tube", "crossing_tubes"),
                                    {"curve_stars", "curve_star"},
                                    {"knot_99_1", "knot_9_1"},
                                    {"routes_rings", "routes_ring"}})
    for (const char* output : {"s.obj", "s.xyz"})
      expect_refusal({"sample", name, "-o", folder / output}, 2,
                     "there is no sample '" + std::string(name) + "'. Did you mean " + meant +
                         "? 'unsnarl sample --list' names all samples");
  expect_refusal({"sample", "nope", "-o", folder / "s.obj"}, 2, "there is no sample 'nope'. 'unsnarl sample --list'");
  expect_refusal({"sample", "nope", "--list"}, 2, "there is no sample 'nope'. 'unsnarl sample --list'");
}

TEST_F(Samples, knots_and_plans_have_one_format_and_nothing_to_set) {
  expect_refusal({"sample", "knot_3_1", "-o", folder / "k.obj"}, 2, "k.obj: name it *.xyz, or add --format xyz");
  expect_refusal({"sample", "knot_3_1", "-o", folder / "k.xyz", "--format", "off"}, 2, "knots are written as xyz");
  expect_refusal({"sample", "routes_ring", "-o", folder / "r.obj"}, 2, "r.obj: name it *.json, or add --format json");
  expect_refusal({"sample", "knot_3_1", "-o", folder / "k.xyz", "--resolution", "9"}, 2, "--resolution: knots");
  expect_refusal({"sample", "routes_ring", "-o", folder / "r.json", "--resolution", "9"}, 2, "--resolution: plans");
  expect_refusal({"sample", "curve_star", "-o", folder / "c.svg", "--resolution", "9"}, 2, "--resolution: curves have");
  EXPECT_EQ(run({"sample", "knot_3_1", "-o", folder / "k", "--format", "xyz"}).exit_code, 0);
  EXPECT_EQ(run({"sample", "knot_3_1", "-o", "-"}).out, contents(folder / "k"));
}

// run() verifies every file that was written.
TEST_F(Samples, every_sample_ends_as_the_exit_code_says) {
  std::istringstream list(run({"sample", "--list"}).out);
  int samples = 0, left = 0;
  for (std::string line; std::getline(list, line);) {
    const std::string name = line.substr(0, line.find(' '));
    if (name.empty()) break;  // those that follow are no surfaces
    SCOPED_TRACE(name);
    const std::string in = sample(name, {"--resolution", "10"}), out = folder / "out.obj";
    const Outcome outcome = run({"fix", in, "-o", out, "--keep-partial", "--quiet"});
    ++samples;
    if (name == "klein_bottle" || name == "boy_surface") {
      EXPECT_EQ(outcome.exit_code, 7);
    } else if (outcome.exit_code == 0) {
      EXPECT_EQ(pairs_in(out), 0u);
    } else {
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_GT(pairs_in(out), 0u);
      ++left;
    }
    fs::remove(out);
  }
  EXPECT_GT(samples, 30);
  EXPECT_LE(left, 3) << "so coarse, a few keep crossings";
}

}  // namespace
}  // namespace unsnarl::cli
