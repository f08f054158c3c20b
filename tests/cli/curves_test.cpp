#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "oracle/crossings_by_brute_force.h"

namespace unsnarl::cli {
namespace {

class Curves : public ::testing::Test {
 protected:
  Folder folder;
  const std::string in = folder / "in.svg", out = folder / "out.svg";

  /// By the oracle, on what is read from the file anew.
  static std::size_t crossings_of(const std::string& path) {
    return oracle::count_crossings(CurveDocument::read(path).curves(), {});
  }
};

TEST_F(Curves, a_drawing_is_opened_and_all_else_kept) {
  write(in,
        "<!-- kept --><svg xmlns=\"http://www.w3.org/2000/svg\">\n<g transform=\"rotate(7)\"><circle id=\"a\" r=\"10\" "
        "class=\"k\"/></g>\n<circle cx=\"12\" r=\"9\"/><path d=\"M 90 90 c 1 0 1 1 0 1\"/></svg>\n");
  const Outcome outcome = run({"curves", in, "-o", out, "--report", folder / "r.json", "--picture", folder / "p.svg"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(crossings_of(in), 2U);
  EXPECT_EQ(crossings_of(out), 0U);
  const std::string text = contents(out);
  EXPECT_TRUE(text.starts_with("<!-- kept --><svg"));
  EXPECT_TRUE(contains(text, "<g transform=\"rotate(7)\"><path id=\"a\" d=\"M "));
  EXPECT_TRUE(contains(text, "class=\"k\"/></g>"));
  EXPECT_TRUE(contains(text, "<path d=\"M 90 90 c 1 0 1 1 0 1\"/>"));
  const auto report = nlohmann::json::parse(contents(folder / "r.json"));
  EXPECT_EQ(report["status"], "embedded");
  EXPECT_EQ(report["crossings_before"], 2);
  EXPECT_EQ(report["crossings_after"], 0);
  EXPECT_TRUE(contains(contents(folder / "p.svg"), "before: 2 crossings"));
  // Once more: nothing to do, the same bytes.
  const std::string again = folder / "again.svg";
  EXPECT_EQ(run({"curves", out, "-o", again, "-q"}).exit_code, 0);
  EXPECT_EQ(contents(again), text);
}

TEST_F(Curves, streams_and_samples) {
  const Outcome sample = run({"sample", "curve_spiral", "--set", "seed=3", "--set", "points=300", "-o", "-"});
  ASSERT_EQ(sample.exit_code, 0) << sample.err;
  const std::vector<std::string> arguments{"curves", "-", "--format", "json", "-o", "-"};
  const Outcome first = run(arguments, {.input = sample.out}), second = run(arguments, {.input = sample.out});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out, second.out);
  const CurveDocument document = CurveDocument::parse(first.out, CurveFormat::json);
  EXPECT_EQ(oracle::count_crossings(document.curves(), {}), 0U);
  EXPECT_GE(document.curves()[0].size(), 300U);
}

TEST_F(Curves, an_end_on_another_curve_is_on_it_in_the_file_too) {
  const std::string json = folder / "in.json", result = folder / "out.json";
  write(json, R"({"curves": [{"points": [[0.1, 0.2], [7.123456789123, 1.987654321987]]},
      {"points": [[3.6117283945615, 1.0938271609935], [3.3, 5.1], [6.6, 5.2], [2.9, 5.3]]},
      {"closed": true, "points": [[2.123, 3.217], [4.731, 3.111], [4.633, 4.419], [2.017, 4.523]]}]})");
  ASSERT_EQ(run({"curves", json, "-o", result}).exit_code, 0);
  const std::vector<Curve> curves = CurveDocument::read(result).curves();
  ASSERT_EQ(curves[0].size(), 3U);
  EXPECT_EQ(curves[0].points[2], curves[1].points[0]);
  EXPECT_EQ(curves[0].points[3], curves[1].points[1]);
  EXPECT_EQ(oracle::count_crossings(curves, {{{{0, 1}, {1, 0}}}}), 0U);
}

TEST_F(Curves, fixed_curves_that_cross_exit_with7) {
  const std::string json = folder / "in.json", result = folder / "out.json";
  write(json,
        "{\"curves\": [{\"name\": \"a\", \"points\": [[0, 0], [9, 9]]}, {\"points\": [[0, 9], [9, 0]]},\n"
        "{\"closed\": true, \"points\": [[20, 0], [29, 9], [29, 0], [20, 9]]}]}");
  const Outcome outcome = run({"curves", json, "-o", result, "--fix", "a", "--fix", "1"});
  EXPECT_EQ(outcome.exit_code, 7) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "cannot be repaired: segment 0 of curve 0 'a' and segment 0 of curve 1 cross"));
  EXPECT_EQ(crossings_of(json), 2U);
  EXPECT_EQ(crossings_of(result), 1U);
}

TEST_F(Curves, left_crossings_exit_with1_and_write_nothing) {
  const std::string json = folder / "in.json", result = folder / "out.json";
  write(json, "{\"curves\": [{\"points\": [[0, 0], [9, 9]]}, {\"points\": [[0, 9], [4, 6], [9, 0]]}]}");
  const Outcome outcome = run({"curves", json, "-o", result, "--fix-ends"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(contains(outcome.err, "still crossing: segment 0 of curve 0"));
  EXPECT_FALSE(fs::exists(result));
  EXPECT_EQ(run({"curves", json, "-o", result, "--fix-ends", "--keep-partial"}).exit_code, 1);
  EXPECT_TRUE(fs::exists(result));
}

TEST_F(Curves, a_time_limit_exits_with5) {
  const std::string json = folder / "in.json";
  ASSERT_EQ(run({"sample", "curve_noise", "--set", "points=2000", "-o", json}).exit_code, 0);
  EXPECT_EQ(run({"curves", json, "-o", folder / "out.json", "--time-limit", "0.000001"}).exit_code, 5);
}

TEST_F(Curves, what_makes_no_sense_is_refused_and_the_place_named) {
  write(in, "<svg>\n<path id=\"p\" d=\"M0 0 L oops\"/></svg>");
  const Outcome data = run({"curves", in, "-o", out});
  EXPECT_EQ(data.exit_code, 0);
  EXPECT_TRUE(contains(data.err, "<path> 'p' on line 2 is left as it is: 'oops' at character 7")) << data.err;
  EXPECT_EQ(contents(out), contents(in));
  fs::remove(out);
  write(in, "<svg>\n<path></svg>");
  EXPECT_EQ(run({"curves", in, "-o", out}).exit_code, 3);
  EXPECT_EQ(run({"curves", folder / "none.svg", "-o", out}).exit_code, 3);
  write(in, "<svg><path id=\"p\" d=\"M0 0L1 1\"/></svg>");
  EXPECT_EQ(run({"curves", in}).exit_code, 2);
  EXPECT_EQ(run({"curves", in, "-o", in}).exit_code, 2);
  EXPECT_EQ(run({"curves", in, "-o", folder / "out.json"}).exit_code, 2);
  EXPECT_EQ(run({"curves", in, "-o", out, "--fix", "q"}).exit_code, 2);
  EXPECT_EQ(run({"curves", in, "-o", out, "--gap", "0"}).exit_code, 2);
  EXPECT_EQ(run({"curves", in, "-o", folder / "no/such/folder.svg"}).exit_code, 4);
  EXPECT_EQ(run({"curves", in, "--integrand", folder / "i.png", "--integrand-curve", "1"}).exit_code, 2);
  EXPECT_EQ(run({"curves", in, "--integrand", folder / "i.png"}).exit_code, 0);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"i.png", "in.svg"}));
}

}  // namespace
}  // namespace unsnarl::cli
