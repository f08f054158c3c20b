#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"

namespace unsnarl::cli {
namespace {

using Limits = ProgramTest;

TEST_F(Limits, the_time_limit_leaves_nothing_unless_asked) {
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

TEST_F(Limits, the_memory_limit_is_kept) {
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

TEST_F(Limits, limits_exit_with5) {
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

TEST_F(Limits, interrupted_exits_with6_and_leaves_nothing) {
  // Large enough to be at work when the signal comes, which is sent at the first sign of progress.
  const std::string in = sample("crumpled_sheet", {"--resolution", "200"}), out = folder / "out.obj";
  const auto before = folder.names();
  const Outcome once =
      run({"fix", in, "-o", out, "--progress", "json", "--no-partial"}, {.signal_after = {"fraction"}});
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

/// Two wavy sheets through each other, and two triangles through them that are 1e30 times as large.
std::string sheets_among_huge_triangles() {
  constexpr int n = 14;
  std::string vertices, faces;
  for (int sheet = 0; sheet < 2; ++sheet)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        vertices += fmt::format("v {} {} {}\n", i + 0.31 * sheet, j + 0.17 * sheet,
                                (sheet ? 0.3 : -0.3) * std::sin(0.5 * i) * std::cos(0.4 * j));
        const int a = (sheet * (n + 1) + i) * (n + 1) + j + 1;
        if (i < n && j < n) faces += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", a, a + n + 1, a + n + 2, a + 1);
      }
  const int next = 2 * (n + 1) * (n + 1) + 1;
  return vertices +
         "v 0.3 0.2 -1e30\nv 1e30 2e20 1e30\nv -1e30 -1e25 1e29\nv 0.1 0.7 -1e31\nv 1e32 -2e31 1e30\n"
         "v -1e30 1e25 1e30\n" +
         faces + fmt::format("f {} {} {}\nf {} {} {}\n", next, next + 1, next + 2, next + 3, next + 4, next + 5);
}

TEST_F(Limits, what_is_far_below_the_largest_numbers_takes_no_more_than_it_is_worth) {
  if (!memory_can_be_limited) GTEST_SKIP() << "the sanitizer needs all addresses";
  const std::string in = file("in.obj", sheets_among_huge_triangles()), out = folder / "out.obj";
  const Outcome outcome = run({"fix", in, "-o", out, "--memory-limit", "150", "--threads", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace
}  // namespace unsnarl::cli
