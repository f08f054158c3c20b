#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "cli/program_test.h"
#include "unsnarl/document.h"

namespace unsnarl::cli {
namespace {

using Report = ProgramTest;

TEST_F(Report, report_picture_and_highlight) {
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
  EXPECT_NE(contents(folder / "h.ply").find("property double displacement"), std::string::npos);
}

TEST_F(Report, reports_name_files_with_any_bytes) {
  const std::string in = file("in\xff.obj", crossing);
  EXPECT_EQ(run({"fix", in, "-o", folder / "out.obj", "--report", folder / "r.json"}).exit_code, 0);
  const std::string path = nlohmann::json::parse(contents(folder / "r.json"))["input"]["path"];
  EXPECT_TRUE(path.ends_with("in\xef\xbf\xbd.obj")) << path;
  EXPECT_EQ(run({"check", in, "--json"}).exit_code, 1);
}

TEST_F(Report, an_input_that_is_refused_has_one_too) {
  const std::string in = file("in.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), report = folder / "r.json";
  const Outcome outcome = run({"fix", in, "-o", folder / "out.obj", "--report", report});
  EXPECT_EQ(outcome.exit_code, 3);
  const auto json = nlohmann::json::parse(contents(report));
  EXPECT_EQ(json["schema"], "unsnarl-report");
  EXPECT_EQ(json["status"], "invalid_input");
  EXPECT_EQ(json["exit_code"], 3);
  EXPECT_TRUE(contains(json["error"], "'nan'")) << json["error"];
  write(folder / "scene.bin", "precious");
  EXPECT_EQ(run({"fix", in, "-o", folder / "out.obj", "--report", folder / "scene.bin"}).exit_code, 3);
  EXPECT_EQ(contents(folder / "scene.bin"), "precious");
}

TEST_F(Report, notes_are_those_that_were_printed) {
  const std::string in = file("in.obj", crossing), report = folder / "r.json";
  const std::string note = "--recompute-normals: in.obj has no vertex normals to update";
  const Outcome outcome = run({"fix", in, "-o", folder / "out.obj", "--recompute-normals", "--report", report});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "note: " + note + "\n")) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(contents(report))["input"]["notes"], nlohmann::json({note}));
}

TEST_F(Report, every_file_that_was_written_is_named) {
  const std::string in = file("in.obj", crossing);
  std::vector<std::string> call = {"fix", in, "-o", folder / "out.obj"};
  for (const auto& [option, name] :
       {std::pair("--report", "r.json"), {"--picture", "p.png"}, {"--record", "c.json"}, {"--highlight", "h.ply"}})
    call.insert(call.end(), {option, folder / name});
  const Outcome outcome = run(call);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name : {"out.obj", "r.json", "p.png", "c.json", "h.ply"})
    EXPECT_TRUE(contains(outcome.err, "wrote " + (folder / name) + "\n")) << outcome.err;
}

TEST_F(Report, progress_counts_faces_as_the_report_does) {
  const std::string in = sample("crossing_tubes");  // quads, some of which both triangles of are hit
  const Outcome fixed = run({"fix", in, "-o", folder / "out.obj", "--progress", "json", "--report", folder / "r.json"});
  ASSERT_EQ(fixed.exit_code, 0) << fixed.err;
  std::istringstream lines(fixed.err);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(nlohmann::json::parse(line)["pairs_left"],
            nlohmann::json::parse(contents(folder / "r.json"))["before"]["total"]);
}

TEST_F(Report, progress_is_shown_while_the_input_is_read) {
  const std::string slow = folder / "slow";
  ASSERT_EQ(::mkfifo(slow.c_str(), 0600), 0);
  RunOptions options;
  options.input = crossing;
  options.in_child = [&] { ::dup2(::open(slow.c_str(), O_RDONLY), STDIN_FILENO); };
  std::thread writer([&] {
    std::ofstream out(slow);
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    out << crossing;
  });
  const Outcome outcome = run({"fix", "-", "--format", "obj", "-o", folder / "out.obj", "--progress", "json"}, options);
  writer.join();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto first = nlohmann::json::parse(outcome.err.substr(0, outcome.err.find('\n')));
  EXPECT_EQ(first["phase"], "read");
  EXPECT_TRUE(first["pairs_left"].is_null()) << first;
  EXPECT_LE(first["seconds"], 1.2);
}

TEST_F(Report, a_log_gets_a_line_each_half_minute) {
  const std::string slow = folder / "slow";
  ASSERT_EQ(::mkfifo(slow.c_str(), 0600), 0);
  const auto from_slow = [&] { ::dup2(::open(slow.c_str(), O_RDONLY), STDIN_FILENO); };
  std::thread writer([&] {
    std::ofstream out(slow);
    std::this_thread::sleep_for(std::chrono::seconds(32));
    out << crossing;
  });
  const Outcome outcome = run({"check", "-", "--format", "obj"}, {.input = crossing, .in_child = from_slow});
  writer.join();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(std::regex_match(outcome.err, std::regex("read +0 % +3[0-9] s\n"))) << outcome.err;
}

TEST_F(Report, progress_as_json_never_goes_back) {
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
