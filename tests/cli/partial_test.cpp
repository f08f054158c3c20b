#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "cli/two_tetrahedra.h"

/// What a repair reached that did not end clean.
namespace unsnarl::cli {
namespace {

using two_tetrahedra::corners;

/// Two tetrahedra, of which the second sticks into the first so deep, at least.
std::array<std::array<double, 3>, 8> tetrahedra(double x, double depth) {
  const double tip = (4 - depth * 1.7320508) / 3;
  return {{{x, 0, 0},
           {x + 4, 0, 0},
           {x, 4, 0},
           {x, 0, 4},
           {x + tip, tip, tip},
           {x + 2.6, 2.5, 2},
           {x + 2.5, 2.6, 2.2},
           {x + 2.4, 2.4, 2.7}}};
}

std::string obj(const std::vector<double>& depths) {
  std::string points, faces;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    for (const auto& p : tetrahedra(9.0 * static_cast<double>(i), depths[i]))
      points += fmt::format("v {:.6g} {:.6g} {:.6g}\n", p[0], p[1], p[2]);
    for (std::size_t k = 0; k < corners.size(); k += 3)
      faces +=
          fmt::format("f {} {} {}\n", 8 * i + corners[k] + 1, 8 * i + corners[k + 1] + 1, 8 * i + corners[k + 2] + 1);
  }
  return points + faces;
}

std::string buffer(const std::vector<double>& depths) {
  std::string bytes;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const auto points = tetrahedra(9.0 * static_cast<double>(i), depths[i]);
    for (const int c : corners)
      for (const double x : points[c]) {
        const auto word = std::bit_cast<std::uint32_t>(static_cast<float>(x));
        for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 255);
      }
  }
  return bytes;
}

std::string gltf(const std::string& uri, std::size_t vertices) {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{0},"type":"VEC3","min":[0,0,0],"max":[13,4,4]}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":{1}}}],"buffers":[{{"byteLength":{1},"uri":"{2}"}}]}})",
      vertices, 12 * vertices, uri);
}

/// One overlap that a motion of 0.05 resolves, and one that it does not.
const std::vector<double> shallow_and_deep = {0.02, 0.4};

class Partial : public ProgramTest {
 protected:
  static std::vector<std::string> limited(std::vector<std::string> words, const std::string& limit = "0.05") {
    words.insert(words.end(), {"--max-displacement", limit, "--absolute"});
    return words;
  }
  /// The environment of tests/cli/fail_calls.c.
  static RunOptions with(const std::map<std::string, std::string>& variables) {
    return {.in_child = [variables] {
      ::setenv("LD_PRELOAD", UNSNARL_FAIL_CALLS, 1);
      for (const auto& [name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
    }};
  }
  static std::string last_line(std::string text) {
    while (text.ends_with('\n')) text.pop_back();
    return text.substr(text.rfind('\n') + 1);
  }
  void expect_better(const std::string& path, const std::string& than) const {
    ASSERT_TRUE(fs::exists(path)) << path;
    EXPECT_LT(pairs_in(path), pairs_in(than));
    EXPECT_GT(pairs_in(path), 0u);
  }
};

TEST_F(Partial, what_was_reached_is_kept_beside_the_target) {
  const std::string in = file("in.obj", obj(shallow_and_deep)), out = file("out.obj", "precious");
  const std::string partial = folder / "out.partial.obj", report = folder / "r.json";
  const Outcome outcome = run(limited({"fix", in, "-o", out, "--report", report}));
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
  EXPECT_EQ(contents(out), "precious");
  expect_better(partial, in);
  EXPECT_NE(last_line(outcome.err).find(partial), std::string::npos) << outcome.err;
  const auto json = nlohmann::json::parse(contents(report));
  EXPECT_EQ(json["output"], (nlohmann::json{{"written", false}, {"path", nullptr}, {"partial", {partial}}}));
  EXPECT_EQ(json["after"]["total"], pairs_in(partial));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj", "out.obj", "out.partial.obj", "r.json"}));
}

TEST_F(Partial, nothing_is_kept_that_nobody_wants) {
  const std::string in = file("in.obj", obj(shallow_and_deep)), out = folder / "out.obj";
  EXPECT_EQ(run(limited({"fix", in, "-o", out, "--no-partial"})).exit_code, 5);
  EXPECT_EQ(run(limited({"fix", in, "-o", "-"})).out, "");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj"}));
  EXPECT_EQ(run(limited({"fix", in, "-o", out, "--keep-partial"})).exit_code, 5);
  expect_better(out, in);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj", "out.obj"}));
  expect_refusal({"fix", in, "-o", out, "--keep-partial", "--no-partial"}, 2, "--no-partial");
  // Nor what is not better than the input.
  fs::remove(out);
  EXPECT_EQ(run(limited({"fix", in, "-o", out}, "1e-9")).exit_code, 5);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj"}));
}

TEST_F(Partial, a_call_that_goes_on_from_it_keeps_both) {
  const std::string in = file("in.obj", obj({0.02, 0.15, 0.6})), out = folder / "out.obj";
  ASSERT_EQ(run(limited({"fix", in, "-o", out}, "0.03")).exit_code, 5);
  const std::string first = folder / "out.partial.obj", second = folder / "out.partial.2.obj";
  const std::string kept = contents(first);
  ASSERT_EQ(run(limited({"fix", first, "-o", out}, "0.2")).exit_code, 5);
  EXPECT_EQ(contents(first), kept);
  expect_better(second, first);
  EXPECT_EQ(run({"fix", second, "-o", out}).exit_code, 0);
}

TEST_F(Partial, in_place_the_input_stays) {
  const std::string in = file("in.obj", obj(shallow_and_deep)), before = contents(in);
  EXPECT_EQ(run(limited({"fix", in, "--in-place"})).exit_code, 5);
  EXPECT_EQ(contents(in), before);
  expect_better(folder / "in.partial.obj", in);
}

TEST_F(Partial, a_gltf_keeps_its_buffers) {
  fs::create_directory(folder / "data");
  const std::string in = file("g.gltf", gltf("data/a%20b.bin", 48)),
                    data = file("data/a b.bin", buffer(shallow_and_deep));
  const std::string before = contents(in);
  EXPECT_EQ(run(limited({"fix", in, "--in-place"})).exit_code, 5);
  EXPECT_EQ(contents(in), before);
  EXPECT_EQ(contents(data), buffer(shallow_and_deep));
  expect_better(folder / "g.partial.gltf", in);
  EXPECT_TRUE(contains(contents(folder / "g.partial.gltf"), R"("uri":"data/a%20b.partial.bin")"));
  EXPECT_TRUE(fs::exists(folder / "data/a b.partial.bin"));
}

TEST_F(Partial, of_a_scene_all_files_are_kept) {
  const std::string a = file("a.obj", obj(shallow_and_deep)), b = file("b.obj", obj({0.4, 0.02}));
  // The second lies elsewhere.
  write(b, "v 90 0 0\nv 91 0 0\nv 90 1 0\nf 1 2 3\n");
  const Outcome outcome = run(limited({"fix", a, b, "-o", folder / "out"}));
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
  expect_better(folder / "out/a.partial.obj", a);
  EXPECT_EQ(contents(folder / "out/b.partial.obj"), contents(b));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"a.obj", "b.obj", "out", "out/a.partial.obj", "out/b.partial.obj"}));
}

TEST_F(Partial, of_a_sequence_each_frame_is_kept) {
  const std::string a = file("f0.obj", obj(shallow_and_deep)), b = file("f1.obj", obj({0.02, 0.02}));
  const Outcome outcome =
      run(limited({"fix", "--sequence", a, b, "-o", folder / "out", "--report", folder / "r.json"}));
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
  EXPECT_FALSE(fs::exists(folder / "out/f0.obj"));
  expect_better(folder / "out/f0.partial.obj", a);
  EXPECT_EQ(pairs_in(folder / "out/f1.obj"), 0u);
  EXPECT_NE(last_line(outcome.err).find("f0.partial.obj"), std::string::npos) << outcome.err;
  const auto list = nlohmann::json::parse(contents(folder / "r.json"))["list"];
  EXPECT_EQ(list[0]["partial"], folder / "out/f0.partial.obj");
  EXPECT_TRUE(list[1]["partial"].is_null());
}

TEST_F(Partial, in_a_batch_it_is_beside_the_results_and_in_the_table) {
  fs::create_directory(folder / "in");
  file("in/a.obj", obj(shallow_and_deep));
  file("in/a.partial.obj", obj({0.02}));  // another mesh, whose result has the name
  fs::create_directory(folder / "in/data");
  file("in/g.gltf", gltf("data/a.bin", 48));
  file("in/data/a.bin", buffer(shallow_and_deep));
  const Outcome outcome =
      run({"batch", folder / "in", "-o", folder / "out", "--", "--max-displacement", "0.05", "--absolute"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_better(folder / "out/fixed/a.partial.2.obj", folder / "in/a.obj");
  EXPECT_EQ(pairs_in(folder / "out/fixed/a.partial.obj"), 0u);
  expect_better(folder / "out/fixed/g.gltf/g.partial.gltf", folder / "in/g.gltf");
  EXPECT_TRUE(contains(contents(folder / "out/results.csv"), "fixed/a.partial.2.obj"));
  EXPECT_TRUE(contains(contents(folder / "out/results.csv"), "fixed/g.gltf/g.partial.gltf"));
}

TEST_F(Partial, an_interrupted_call_keeps_what_it_reached) {
  // The first overlap of all is resolved long before the others are.
  const std::string sheet = sample("crumpled_sheet", {"--resolution", "160"}), out = folder / "out.obj";
  std::string in = folder / "in.obj";
  write(in, contents(sheet));
  Outcome outcome;
  for (int wait_us = 1'000'000; wait_us < 30'000'000; wait_us *= 2) {
    outcome = run({"fix", in, "-o", out}, {.signal_after_us = wait_us});
    if (outcome.exit_code != 6 || fs::exists(folder / "out.partial.obj")) break;
  }
  EXPECT_EQ(outcome.exit_code, 6) << outcome.err;
  EXPECT_FALSE(fs::exists(out));
  expect_better(folder / "out.partial.obj", in);
}

TEST_F(Partial, an_edit_saved_meanwhile_is_left_and_the_result_kept) {
  // Saved when the program tests its places, after it has read the input.
  const std::string in = file("in.obj", crossing);
  // With the option first, run() does not take what is edited for a result and judge it.
  const Outcome outcome = run({"fix", "--in-place", in}, with({{"FAIL_WHAT", "mkdir"},
                                                               {"FAIL_BELOW", folder.string()},
                                                               {"FAIL_AT", "1"},
                                                               {"FAIL_MODE", "edit"},
                                                               {"FAIL_EDIT", in}}));
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("in.partial.obj"), std::string::npos) << outcome.err;
  EXPECT_EQ(contents(in), crossing + "# edited\n");
  EXPECT_EQ(pairs_in(folder / "in.partial.obj"), 0u);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.obj", "in.partial.obj"}));

  fs::create_directory(folder / "data");
  const std::string mesh = file("g.gltf", gltf("data/a.bin", 48)), data = file("data/a.bin", buffer({0.02, 0.03}));
  const Outcome buffered = run({"fix", mesh, "--in-place"}, with({{"FAIL_WHAT", "mkdir"},
                                                                  {"FAIL_BELOW", folder.string()},
                                                                  {"FAIL_AT", "1"},
                                                                  {"FAIL_MODE", "edit"},
                                                                  {"FAIL_EDIT", data}}));
  EXPECT_EQ(buffered.exit_code, 4) << buffered.err;
  EXPECT_EQ(contents(mesh), gltf("data/a.bin", 48));
  EXPECT_EQ(contents(data), buffer({0.02, 0.03}) + "# edited\n");
  EXPECT_EQ(pairs_in(folder / "g.partial.gltf"), 0u);
}

}  // namespace
}  // namespace unsnarl::cli
