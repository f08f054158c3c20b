#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program_test.h"
#include "unsnarl/document.h"

namespace unsnarl::cli {
namespace {

using Report = ProgramTest;

TEST_F(Report, ReportPictureAndHighlight) {
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

TEST_F(Report, ReportsNameFilesWithAnyBytes) {
  const std::string in = file("in\xff.obj", crossing);
  EXPECT_EQ(run({"fix", in, "-o", folder / "out.obj", "--report", folder / "r.json"}).exit_code, 0);
  const std::string path = nlohmann::json::parse(contents(folder / "r.json"))["input"]["path"];
  EXPECT_TRUE(path.ends_with("in\xef\xbf\xbd.obj")) << path;
  EXPECT_EQ(run({"check", in, "--json"}).exit_code, 1);
}

TEST_F(Report, ProgressAsJsonNeverGoesBack) {
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

}  // namespace
}  // namespace unsnarl::cli
