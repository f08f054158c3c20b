#include <gtest/gtest.h>

#include <sstream>

#include "cli/program_test.h"
#include "unsnarl/document.h"

namespace unsnarl::cli {
namespace {

using Samples = ProgramTest;

TEST_F(Samples, SamplesAreListedDescribedAndWritten) {
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

// run() verifies every file that was written.
TEST_F(Samples, EverySampleEndsAsTheExitCodeSays) {
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
