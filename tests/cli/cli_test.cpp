#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "cli/program.h"
#include "unsnarl/document.h"
#include "unsnarl/intersections.h"
#include "unsnarl/parts.h"

namespace unsnarl::cli {
namespace {

/// A cube of quads with unusual but legal writing, to see that every byte is kept.
const std::string clean_cube =
    "# a cube\r\nv 0 0 0\nv  1.000 0 0\nv 1 1 0 0.5\nv 0 1 0\nv 0 0 1e0\nv 1 0 1\nv 1 1 1\nv 0 1 +1\nvt 0 0\n"
    "f 4/1 3/1 2/1 1/1\nf 5 6 7 8\nusemtl x\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// A tetrahedron, and a small one whose tip sticks into it.
const std::string crossing =
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4 # top\nv 1.2 1.2 1.1\nv 2.6 2.5 2\nv 2.5 2.6 2.2\nv 2.4 2.4 2.7\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n";

/// All triangles of a vertex with two of five others: round it these would have to be joined without crossings, and the
/// complete graph on five vertices is not planar.
const std::string hopeless =
    "v 0 0 0\nv 1 0 0\nv 0 1 0.1\nv -1 0.2 0\nv 0.1 -1 0\nv 0.2 0.1 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6\nf 1 3 4\n"
    "f 1 3 5\nf 1 3 6\nf 1 4 5\nf 1 4 6\nf 1 5 6\n";

std::size_t pairs_in(const std::string& path) {
  return find_intersections(Document::read(path).surface()).size();
}

class Cli : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) {
    write(folder / name, bytes);
    return folder / name;
  }
  std::string sample(const std::string& name, const std::vector<std::string>& more = {}) {
    const std::string path = folder / (name + ".obj");
    std::vector<std::string> arguments = {"sample", name, "-o", path};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return path;
  }
  /// Runs and expects an exit code, a complaint that contains `words`, and no file but those that were there.
  void expect_refusal(const std::vector<std::string>& arguments, int exit_code, const std::string& words) {
    const auto before = folder.names();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder.names(), before);
  }
  Folder folder;
};

TEST_F(Cli, WhatIsNoNumberInTheRangeIsRefused) {
  const std::string in = file("in.obj", crossing);
  for (const char* value : {"90", "200", "-1", "nan", "inf", "x"})
    expect_refusal({"fix", in, "-o", folder / "out.obj", "--min-dihedral", value}, 2, "--min-dihedral");
  for (const char* option : {"--max-displacement", "--min-gap", "--time-limit", "--memory-limit", "--weld-tolerance"})
    for (const char* value : {"nan", "-1"})
      expect_refusal({"fix", in, "-o", folder / "out.obj", option, value}, 2, option);
}

TEST_F(Cli, HelpAndVersionGoToStandardOutput) {
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

TEST_F(Cli, VersionsOfAllLibraries) {
  for (const bool json_first : {false, true}) {
    const Outcome outcome = json_first ? run({"--json", "--version"}) : run({"--version", "--json"});
    EXPECT_EQ(outcome.exit_code, 0);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ("unsnarl " + json["unsnarl"].get<std::string>() + "\n", run({"--version"}).out);
    for (const char* name : {"CGAL", "CLI11", "GMP", "OpenSSL", "glibc", "oneTBB", "zlib", "{fmt}"})
      EXPECT_TRUE(std::regex_match(json["libraries"][name].get<std::string>(), std::regex(R"(\d+(\.\d+)+.*)"))) << name;
  }
}

TEST_F(Cli, UsageErrorsExitWith2) {
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

TEST_F(Cli, InputsThatMakeNoSenseExitWith3) {
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

TEST_F(Cli, OutputsThatCannotBeWrittenExitWith4) {
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

TEST_F(Cli, CleanInputComesBackByteForByte) {
  const std::string in = file("in.obj", clean_cube), out = folder / "out.obj";
  const Outcome outcome = run({"fix", in, "-o", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(contents(out), clean_cube);
  EXPECT_EQ(contents(in), clean_cube);
}

TEST_F(Cli, RepairsAndKeepsEverythingElse) {
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

TEST_F(Cli, QuietSaysNothing) {
  const std::string in = file("in.obj", crossing);
  const Outcome outcome = run({"fix", in, "-o", folder / "out.obj", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  const Outcome check = run({"check", in, "--quiet"});
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_EQ(check.out + check.err, "");
}

TEST_F(Cli, InPlaceReplacesTheInputAndKeepsItsPermissions) {
  const std::string in = file("in.obj", crossing);
  fs::permissions(in, fs::perms(0640));
  fs::create_symlink("in.obj", folder / "link.obj");
  EXPECT_EQ(run({"fix", folder / "link.obj", "--in-place"}).exit_code, 0);
  EXPECT_EQ(pairs_in(in), 0u);
  EXPECT_EQ(fs::status(in).permissions(), fs::perms(0640));
  EXPECT_TRUE(fs::is_symlink(folder / "link.obj"));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj", "link.obj"}));
}

TEST_F(Cli, OutputIsReplacedOnlyBySuccess) {
  const std::string in = file("in.obj", hopeless), out = file("out.obj", "precious");
  const std::string ids = file("ids.txt", "1 2 3 4 5\n");
  const Outcome outcome = run({"fix", in, "-o", out, "--fix-vertices", ids});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(contents(out), "precious");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj", "out.obj", "ids.txt"}));
}

TEST_F(Cli, NothingBetterThanTheInputExitsWith1) {
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

TEST_F(Cli, FixedVerticesKeepTheirTokens) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  EXPECT_EQ(run({"fix", in, "-o", out, "--fix-vertices", file("ids.txt", "0 1 2 3")}).exit_code, 0);
  const std::string fixed_part = crossing.substr(0, crossing.find("v 1.2"));
  EXPECT_EQ(contents(out).substr(0, fixed_part.size()), fixed_part);
  EXPECT_EQ(pairs_in(out), 0u);
}

TEST_F(Cli, NamedPartsStayWhereTheyAre) {
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
  expect_refusal({"fix", in, "-o", out, "--fix-group", "anker"}, 2, "'anchor heavy', 'swimmer'");
  expect_refusal({"fix", in, "-o", out, "--only-object", "bird"}, 2, "'rock', 'fish'");
  expect_refusal({"fix", in, "-o", out, "--fix-component", "2"}, 2, "the mesh has 2");
  // Several times, and everything: nothing is left that could move.
  const Outcome all = run({"fix", in, "-o", out, "--fix-group", "anchor", "--fix-group", "swimmer"});
  EXPECT_EQ(all.exit_code, 7) << all.err;
  EXPECT_NE(all.err.find("in what is fixed of them"), std::string::npos) << all.err;
  EXPECT_FALSE(fs::exists(out));
  // Closed bodies have no boundary to hold.
  EXPECT_EQ(run({"fix", in, "-o", out, "--fix-boundary"}).exit_code, 0);
}

TEST_F(Cli, BoundariesCanBeHeld) {
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

TEST_F(Cli, AnAnchorHoldsAndTheSceneGivesWay) {
  const std::string in = sample("anchored_balls", {"--resolution", "16"}), out = folder / "out.obj";
  const Outcome outcome = run({"fix", in, "-o", out, "--fix-group", "anchor"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(pairs_in(out), 0u);
  const std::string text = contents(in);
  std::size_t end = 0;  // of the anchor's vertices: 6 n^2 + 2 with n = 4, and the comment
  for (int line = 0; line < 6 * 16 + 2 + 1; ++line) end = text.find('\n', end) + 1;
  EXPECT_EQ(contents(out).substr(0, end), text.substr(0, end));
}

TEST_F(Cli, WhatLiesOutsideOfARegionIsLeftAndSaid) {
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
  EXPECT_NE(outcome.err.find("in what is fixed of them"), std::string::npos) << outcome.err;
}

TEST_F(Cli, EachComponentByItself) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  const Outcome outcome = run({"fix", in, "-o", out, "--each"});
  EXPECT_EQ(outcome.exit_code, 7) << outcome.err;
  EXPECT_NE(outcome.err.find("different components"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(run({"fix", in, "-o", out, "--together"}).exit_code, 0);
  EXPECT_EQ(run({"fix", in, "-o", out, "--each", "--together"}).exit_code, 2);
}

TEST_F(Cli, BothDiagonalsOfQuadsCountWhereAskedFor) {
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

TEST_F(Cli, TheTimeLimitLeavesNothingUnlessAsked) {
  const std::string in = sample("crumpled_sheet", {"--resolution", "60"}), out = folder / "out.obj";
  const std::size_t before = pairs_in(in);
  // From hardly begun to nearly done; which phase each ends in depends on the machine, what must hold does not.
  for (const char* limit : {"0.001", "0.05", "0.2", "0.8"}) {
    const Outcome outcome = run({"fix", in, "-o", out, "--time-limit", limit});
    EXPECT_TRUE(outcome.exit_code == 5 || outcome.exit_code == 0) << outcome.err;
    EXPECT_EQ(fs::exists(out), outcome.exit_code == 0) << limit;
    const std::string report = folder / "r.json";
    const Outcome kept = run({"fix", in, "-o", out, "--time-limit", limit, "--keep-partial", "--report", report});
    EXPECT_TRUE(kept.exit_code == 5 || kept.exit_code == 0) << kept.err;
    const std::size_t after = pairs_in(out);
    EXPECT_LE(after, before);
    EXPECT_EQ(after == 0, kept.exit_code == 0);
    EXPECT_EQ(nlohmann::json::parse(contents(report))["after"]["total"], after);
    fs::remove(out);
  }
}

TEST_F(Cli, TheMemoryLimitIsKept) {
  if (!memory_can_be_limited) GTEST_SKIP() << "the sanitizer needs all addresses";
  const std::string in = sample("crumpled_sheet", {"--resolution", "250"}), out = folder / "out.obj";
  for (const double limit : {72.0, 30.0}) {
    const std::string report = folder / "r.json";
    const Outcome outcome = run({"fix", in, "-o", out, "--memory-limit", fmt::format("{}", limit), "--time-limit", "2",
                                 "--keep-partial", "--report", report});
    EXPECT_EQ(outcome.exit_code, 5) << limit << outcome.err;
    if (fs::exists(report)) {
      EXPECT_LE(nlohmann::json::parse(contents(report))["peak_memory_mb"].get<double>(), limit);
      fs::remove(report);
    }
    if (fs::exists(out)) {
      EXPECT_LE(pairs_in(out), pairs_in(in));
      fs::remove(out);
    }
  }
}

TEST_F(Cli, LimitsExitWith5) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  for (const std::vector<std::string>& limit : {std::vector<std::string>{"--max-displacement", "1e-9"},
                                                {"--max-displacement", "1e-8", "--absolute"},
                                                {"--time-limit", "1e-9"}}) {
    std::vector<std::string> arguments = {"fix", in, "-o", out};
    arguments.insert(arguments.end(), limit.begin(), limit.end());
    EXPECT_EQ(run(arguments).exit_code, 5) << limit[0];
    EXPECT_FALSE(fs::exists(out));
    arguments.push_back("--keep-partial");
    EXPECT_EQ(run(arguments).exit_code, 5) << limit[0];
    EXPECT_TRUE(fs::exists(out));
    EXPECT_LE(pairs_in(out), pairs_in(in));
    fs::remove(out);
  }
}

TEST_F(Cli, InterruptedExitsWith6AndLeavesNothing) {
  // Large enough to be at work when the signal comes, which is sent at the first sign of progress.
  const std::string in = sample("crumpled_sheet", {"--resolution", "200"}), out = folder / "out.obj";
  const auto before = folder.names();
  const Outcome once = run({"fix", in, "-o", out, "--progress", "json"}, {.signal_after = {"fraction"}});
  EXPECT_EQ(once.exit_code, 6) << once.err;
  EXPECT_EQ(folder.names(), before);
  const Outcome kept =
      run({"fix", in, "-o", out, "--progress", "json", "--keep-partial"}, {.signal_after = {"fraction"}});
  EXPECT_EQ(kept.exit_code, 6) << kept.err;
  EXPECT_LE(pairs_in(out), pairs_in(in));
  fs::remove(out);
  const Outcome twice = run({"fix", in, "-o", out, "--progress", "json"}, {.signal_after = {"fraction", "stopping"}});
  EXPECT_EQ(twice.exit_code, 6) << twice.err;
  EXPECT_EQ(folder.names(), before);
}

TEST_F(Cli, ObstructedExitsWith7) {
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

/// As FreeSurfer stores a surface of triangles.
std::string freesurfer_surface(const Surface& surface, bool last_is_missing = false) {
  std::string bytes = "\xFF\xFF\xFEmade by a test\n\n";
  const auto append = [&](auto value) {
    std::array<char, 4> raw{};
    std::memcpy(raw.data(), &value, 4);
    bytes.append(raw.rbegin(), raw.rend());  // big-endian, on a little-endian machine
  };
  append(static_cast<std::int32_t>(surface.positions.size() / 3));
  append(static_cast<std::int32_t>(surface.corners.size() / 3));
  for (const double x : surface.positions) append(static_cast<float>(x));
  for (const std::int32_t v : surface.corners) append(v);
  if (last_is_missing) bytes.replace(bytes.size() - 4 * surface.corners.size() - 4, 4, "\x7F\xC0\0\0", 4);
  return bytes;
}

TEST_F(Cli, FreeSurferSurfacesNeedNoExtension) {
  Surface surface = Document::parse(crossing, Format::obj).surface();
  const std::string bytes = freesurfer_surface(surface);
  const std::string in = file("lh.pial_of_somebody", bytes), out = folder / "lh.pial.fixed";
  const Outcome outcome = run({"fix", in, "-o", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(pairs_in(out), 0u);
  EXPECT_EQ(contents(out).size(), bytes.size());
  EXPECT_EQ(run({"fix", "-", "--format", "freesurfer", "-o", "-", "--quiet"}, {.input = bytes}).out, contents(out));
  EXPECT_EQ(run({"check", out}).exit_code, 0);
  EXPECT_EQ(run({"fix", in, "-o", folder / "out.obj"}).exit_code, 2);
}

TEST_F(Cli, MissingVerticesAreReportedAndStay) {
  Surface surface = Document::parse(crossing + "v 9 9 9\nv 0 0 0\nf 4 9 10\n", Format::obj).surface();
  const std::string bytes = freesurfer_surface(surface, true);
  const std::string in = file("lh.white", bytes), out = folder / "out.white";
  const Outcome outcome = run({"fix", in, "-o", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("1 missing vertex (NaN) and the 1 face around stay as they are."), std::string::npos);
  EXPECT_EQ(pairs_in(out), 0u);
  const std::size_t faces = bytes.size() - 4 * surface.corners.size();
  EXPECT_EQ(contents(out).substr(faces - 12), bytes.substr(faces - 12));
  EXPECT_NE(contents(out), bytes);
}

TEST_F(Cli, ForeignFormatsAreRefusedWithAHint) {
  const std::string out = folder / "out.obj";
  expect_refusal({"fix", file("a.fbx", "Kaydara FBX Binary"), "-o", out}, 3,
                 "FBX files are not read; import it into Blender");
  expect_refusal({"check", file("b.blend", "")}, 3, "Blend files are not read");
}

TEST_F(Cli, StandardInputAndOutput) {
  const Outcome outcome = run({"fix", "-", "--format", "obj", "-o", "-"}, {.input = crossing});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  write(folder / "out.obj", outcome.out);
  EXPECT_EQ(pairs_in(folder / "out.obj"), 0u);
  EXPECT_EQ(run({"fix", "-", "--format", "obj", "-o", "-"}, {.input = clean_cube}).out, clean_cube);
  EXPECT_EQ(run({"check", "-", "--format", "obj"}, {.input = crossing}).exit_code, 1);
  EXPECT_EQ(run({"fix", "-", "--format", "obj", "-o", "-", "--report", "-"}, {.input = crossing}).exit_code, 2);
}

TEST_F(Cli, ReportPictureAndHighlight) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  const Outcome outcome = run({"fix", in, "-o", out, "--report", folder / "r.json", "--picture", folder / "p.png",
                               "--highlight", folder / "h.ply"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(contents(folder / "r.json"));
  EXPECT_EQ(json["schema"], "unsnarl-report");
  EXPECT_EQ(json["status"], "embedded");
  EXPECT_EQ(json["before"]["total"], pairs_in(in));
  EXPECT_EQ(json["after"]["total"], 0);
  EXPECT_EQ(json["topology"]["components"], 2);
  EXPECT_GT(json["displacement_max_rel"], 0);
  EXPECT_EQ(json["input"]["triangulation"], "8 triangles as they are");
  EXPECT_EQ(json["stages"].front()["name"], "read");
  EXPECT_EQ(json["stages"].back()["name"], "write");
  EXPECT_GT(json["peak_memory_mb"], 0);
  EXPECT_EQ(contents(folder / "p.png").substr(1, 3), "PNG");
  const Surface highlighted = Document::read(folder / "h.ply").surface();
  EXPECT_EQ(highlighted.positions, Document::read(out).surface().positions);
  EXPECT_EQ(highlighted.corners, Document::read(out).surface().corners);
  EXPECT_NE(contents(folder / "h.ply").find("property int pairs_before"), std::string::npos);
}

TEST_F(Cli, ReportsNameFilesWithAnyBytes) {
  const std::string in = file("in\xff.obj", crossing);
  EXPECT_EQ(run({"fix", in, "-o", folder / "out.obj", "--report", folder / "r.json"}).exit_code, 0);
  const std::string path = nlohmann::json::parse(contents(folder / "r.json"))["input"]["path"];
  EXPECT_TRUE(path.ends_with("in\xef\xbf\xbd.obj")) << path;
  EXPECT_EQ(run({"check", in, "--json"}).exit_code, 1);
}

TEST_F(Cli, ProgressAsJsonNeverGoesBack) {
  const std::string in = file("in.obj", crossing);
  const Outcome outcome = run({"fix", in, "-o", folder / "out.obj", "--progress", "json", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  std::istringstream lines(outcome.err);
  double last = 0;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_GE(json["fraction"].get<double>(), last);
    last = json["fraction"];
  }
  EXPECT_GT(count, 0);
  EXPECT_EQ(last, 1);
}

TEST_F(Cli, SameBytesAtAnyThreadCount) {
  const std::string in = file("in.obj", crossing);
  std::set<std::string> results;
  for (const char* threads : {"1", "2", "4"}) results.insert(run({"fix", in, "-o", "-", "--threads", threads}).out);
  EXPECT_EQ(results.size(), 1u);
}

TEST_F(Cli, CheckCountsAndLocates) {
  const std::string in = file("in.obj", crossing);
  const Outcome text = run({"check", in, "--pairs", folder / "pairs.csv"});
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_EQ(text.err, "");
  EXPECT_NE(text.out.find("disjoint"), std::string::npos);
  const Outcome outcome = run({"check", in, "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["schema"], "unsnarl-check");
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

TEST_F(Cli, CheckForTheGoalDisjointSeesNoOthers) {
  // Two faces of one fan pass through each other at their common vertex only.
  const std::string in = file("in.obj", "v 0 0 0\nv 2 -1 0\nv 2 1 0\nv 2 0 -1\nv 2 0 1\nf 1 2 3\nf 1 4 5\n");
  EXPECT_EQ(run({"check", in}).exit_code, 1);
  EXPECT_EQ(run({"check", in, "--goal", "disjoint"}).exit_code, 0);
}

TEST_F(Cli, WeldDecidesWhatTouchingMeans) {
  // Two triangles with a common side, written with corners of their own.
  const std::string in = file("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 0\nv 1 0 0\nv 1 1 1\nf 1 2 3\nf 4 5 6\n");
  EXPECT_EQ(run({"check", in}).exit_code, 0);
  EXPECT_EQ(run({"check", in, "--weld", "none"}).exit_code, 1);
  const std::string near =
      file("near.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0.001 1 0\nv 0.999 0 0\nv 1 1 0\nf 1 2 3\nf 4 5 6\n");
  EXPECT_EQ(run({"check", near}).exit_code, 1);
  EXPECT_EQ(run({"check", near, "--weld-tolerance", "0.01"}).exit_code, 0);
}

TEST_F(Cli, SamplesAreListedDescribedAndWritten) {
  const Outcome list = run({"sample", "--list"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_NE(list.out.find("whitney_umbrella"), std::string::npos);
  EXPECT_EQ(list.out.find("curve_star"), std::string::npos);  // a list of surfaces, for programs
  EXPECT_NE(list.err.find("'unsnarl curves': curve_waves, "), std::string::npos);
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

// What was written is verified by run().
TEST_F(Cli, EverySampleEndsAsTheExitCodeSays) {
  std::istringstream list(run({"sample", "--list"}).out);
  int samples = 0, left = 0;
  for (std::string line; std::getline(list, line);) {
    const std::string name = line.substr(0, line.find(' '));
    if (name.empty()) continue;
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
