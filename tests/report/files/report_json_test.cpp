#include "unsnarl/report_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scene/shapes.h"
#include "unsnarl/sequence.h"
#include "unsnarl/stage_clock.h"

namespace unsnarl {
namespace {

nlohmann::json parsed(const std::string& text) {
  return nlohmann::json::parse(text);
}

TEST(ReportJson, holds_what_the_report_holds) {
  const Surface surface = shapes::crossing_bumps(8, 0.4).surface();
  const RepairResult result = repair(surface);
  ReportFiles files;
  files.faces = surface.view().face_count();
  files.before_repair.push_back({"read", 1, 2, 3});
  files.whole = {"fix", 4, 5, 6};
  const auto json = parsed(report_json(result, {}, files));
  EXPECT_EQ(json["schema"], "unsnarl-report");
  EXPECT_EQ(json["schema_version"], report_schema_version);
  EXPECT_EQ(json["status"], "embedded");
  EXPECT_EQ(json["exit_code"], 0);
  EXPECT_TRUE(json["input"]["path"].is_null());
  EXPECT_EQ(json["input"]["faces"], surface.view().face_count());
  EXPECT_EQ(json["input"]["triangulation"], result.report.triangulation);
  EXPECT_EQ(json["before"]["total"], result.report.before.total());
  ASSERT_EQ(json["regions"].size(), result.report.regions.size());
  EXPECT_EQ(json["regions"][0]["strategy"], result.report.regions[0].strategy);
  EXPECT_EQ(json["stages"].size(), result.report.stages.size() + 1);
  EXPECT_EQ(json["stages"][0]["cpu_seconds"], 2);
  EXPECT_EQ(json["seconds"], 4);
  EXPECT_EQ(json["peak_memory_mb"], 6);
  EXPECT_FALSE(json.contains("history"));
  EXPECT_FALSE(json.contains("before_recovery")) << "of --paper alone";
}

TEST(ReportJson, lengths_are_in_the_units_of_the_positions_too) {
  RepairResult result;
  result.report.diagonal = 8;
  result.report.displacement_max_rel = 0.25;
  result.report.area_change_rel = 0.5;
  result.report.regions.push_back({});
  result.report.regions[0].depth_rel = 0.125;
  result.report.before_recovery = PaperUntangling{true, 0.0625, 0.125};
  RigidPartReport part;
  part.translation_rel = 0.5;
  part.translation = {1, 2, 3};
  result.report.rigid_parts.push_back(part);
  ReportFiles files;
  files.clearance_before = Clearance{};
  const auto json = parsed(report_json(result, {}, files));
  EXPECT_EQ(json["displacement_max"], 2);
  EXPECT_EQ(json["regions"][0]["depth"], 1);
  EXPECT_EQ(json["rigid_parts"][0]["translation_length"], 4);
  EXPECT_EQ(json["rigid_parts"][0]["translation"], nlohmann::json({1.0, 2.0, 3.0}));
  EXPECT_EQ(json["before_recovery"]["clean"], true);
  EXPECT_EQ(json["before_recovery"]["displacement_mean"], 0.5);
  EXPECT_EQ(json["before_recovery"]["displacement_max"], 1);
  EXPECT_FALSE(json.contains("area_change")) << "a share of the area";
  const auto& clearance = json["clearance"]["before"];
  ASSERT_TRUE(clearance["gap_rel"].contains("value"));
  EXPECT_EQ(clearance["gap"].size(), clearance["gap_rel"].size());
}

// File names may hold any bytes.
TEST(ReportJson, what_is_not_utf_8_is_replaced) {
  ReportFiles files;
  files.input = "a\xff.obj";
  EXPECT_EQ(parsed(report_json({}, {}, files))["input"]["path"], "a\xef\xbf\xbd.obj");
  EXPECT_EQ(parsed(check_json({}, Goal::all, {}, files))["input"]["path"], "a\xef\xbf\xbd.obj");
}

TEST(CheckJson, holds_every_place) {
  const Surface surface = shapes::crossing_bumps(8, 0.4).surface();
  const CheckReport found = check(surface);
  const auto json = parsed(check_json(found, Goal::disjoint, {.weld = Weld::none}));
  EXPECT_EQ(json["schema"], "unsnarl-check");
  EXPECT_EQ(json["options"]["goal"], "disjoint");
  EXPECT_EQ(json["options"]["weld"], "none");
  EXPECT_EQ(json["pairs"]["total"], found.pairs.size());
  ASSERT_EQ(json["places"].size(), found.places.size());
  EXPECT_EQ(json["places"][0]["min"][0], found.places[0].bounds.min[0]);
  EXPECT_EQ(json["components"]["list"].size(), 2u);
}

TEST(StageClock, measures_from_its_construction_on) {
  const StageClock clock;
  const StageReport first = clock.stage("first"), second = clock.stage("second");
  EXPECT_EQ(first.name, "first");
  EXPECT_GE(first.seconds, 0);
  EXPECT_GE(second.seconds, first.seconds);
  EXPECT_GE(second.cpu_seconds, first.cpu_seconds);
  EXPECT_GT(first.peak_memory_mb, 0);
}

TEST(FrameJson, holds_what_became_of_a_frame) {
  FrameReport frame;
  frame.frame = 7;
  frame.status = Status::reduced;
  frame.before.by_class[0] = 3;
  frame.diagonal = 2;
  frame.displacement_max_rel = 0.25;
  frame.jitter = Jitter{0.5, 1};
  frame.changed_components = {
      {.component = 3, .name = "jaw", .has_shrunk = true, .is_closed = true, .size_change_rel = -0.5}};
  const auto json = parsed(frame_json(frame));
  EXPECT_EQ(json["frame"], 7);
  EXPECT_EQ(json["status"], "reduced");
  EXPECT_EQ(json["before"], parsed(pairs_json(frame.before)));
  EXPECT_EQ(json["before"]["total"], 3);
  EXPECT_EQ(json["displacement_max"], 0.5);
  EXPECT_TRUE(json["jitter_alone"].is_null());
  EXPECT_EQ(json["jitter"]["max_rel"], 1);
  ASSERT_EQ(json["changed_components"].size(), 1u);
  EXPECT_EQ(json["changed_components"][0]["message"], describe(frame.changed_components[0], frame.diagonal));
}

TEST(StatusFromName, finds_the_status_that_reports_call_so) {
  for (int i = 0; i <= static_cast<int>(Status::cancelled); ++i)
    EXPECT_EQ(status_from_name(to_string(static_cast<Status>(i))), static_cast<Status>(i));
  EXPECT_FALSE(status_from_name("crashed"));
  EXPECT_FALSE(status_from_name(""));
}

}  // namespace
}  // namespace unsnarl
