#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "unsnarl/document.h"

namespace unsnarl::cli {
namespace {

TEST(SeifertCommand, a_knot_is_spanned_and_certified) {
  Folder folder;
  const std::string knot = folder / "knot.xyz", surface = folder / "surface.obj";
  ASSERT_EQ(run({"sample", "knot_3_1", "-o", knot}).exit_code, 0);
  const Outcome made =
      run({"seifert", knot, "-o", surface, "--report", folder / "r.json", "--picture", folder / "p.png"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(contains(made.err, "Alexander polynomial 1 - t + t^2"));
  const auto report = nlohmann::json::parse(contents(folder / "r.json"));
  EXPECT_EQ("unsnarl " + report["version"].get<std::string>() + "\n", run({"--version"}).out);
  EXPECT_EQ(report["hold"], true);
  EXPECT_EQ(report["genus"], 1);
  EXPECT_EQ(report["determinant"], "3");
  EXPECT_EQ(std::abs(report["signature"].get<int>()), 2);
  EXPECT_EQ(report["genus_is_least"], true);
  EXPECT_EQ(run({"seifert", knot, "--check", surface}).exit_code, 0);
  const Outcome handles = run({"seifert", knot, "-o", folder / "h.obj", "--handles", "2", "--no-fair"});
  ASSERT_EQ(handles.exit_code, 0) << handles.err;
  EXPECT_TRUE(contains(handles.err, "genus 3, Euler characteristic -5 (the diagram's with its handles: -5)"));
  EXPECT_EQ(run({"seifert", knot, "--check", folder / "h.obj", "--handles", "2"}).exit_code, 0);
  EXPECT_EQ(run({"seifert", knot, "--check", folder / "h.obj"}).exit_code, 1);
  ASSERT_EQ(run({"sample", "knot_4_1", "-o", knot}).exit_code, 0);
  EXPECT_EQ(run({"seifert", knot, "--check", surface, "-q"}).exit_code, 1);
}

TEST(SeifertCommand, a_surface_that_is_brought_is_untangled) {
  Folder folder;
  const std::string start = folder / "start.obj", out = folder / "s.obj";
  // A square with a bump that hangs over.
  write(start,
        "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 2 0\nv 3 2 0\nv 2 1 0\nv 2 3 0\nv 3.4 2 0.5\n"
        "f 1 2 7\nf 2 6 7\nf 2 3 6\nf 3 8 6\nf 3 4 8\nf 4 5 8\nf 4 1 5\nf 1 7 5\n"
        "f 7 6 9\nf 6 8 9\nf 8 5 9\nf 5 7 9\n");
  const Outcome made = run({"seifert", "--surface", start, "-o", out, "--report", folder / "r.json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(contains(made.err, "4 points, 1 component on the boundary, which was held")) << made.err;
  EXPECT_TRUE(contains(made.err, "genus 0, Euler characteristic 1 (that of the start: 1)")) << made.err;
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "r.json"))["hold"], true);
  EXPECT_EQ(run({"seifert", "--surface", start, "-o", out, "--handles", "1"}).exit_code, 2);
  EXPECT_EQ(run({"seifert", "-o", out}).exit_code, 2);
}

TEST(SeifertCommand, a_relaxed_wire_and_a_tube) {
  Folder folder;
  const std::string knot = folder / "knot.xyz", out = folder / "s.obj", wire = folder / "w.xyz",
                    tube = folder / "t.obj";
  ASSERT_EQ(run({"sample", "knot_3_1", "-o", knot}).exit_code, 0);
  const Outcome made =
      run({"seifert", knot, "--relax", "--wire", wire, "--tube", tube, "-o", out, "--report", folder / "r.json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(contains(made.err, "the knot came to rest")) << made.err;
  EXPECT_TRUE(contains(made.err, "meets the surface in a single band of faces along each component")) << made.err;
  const auto report = nlohmann::json::parse(contents(folder / "r.json"));
  EXPECT_EQ(report["at_rest"], true);
  EXPECT_EQ(report["points"], 200);
  EXPECT_GT(report["tube_radius"], 0);
  EXPECT_EQ(run({"seifert", wire, "--check", out}).exit_code, 0);
  EXPECT_EQ(run({"seifert", knot, "--check", out}).exit_code, 1);
  EXPECT_EQ(run({"check", tube}).exit_code, 0);
  EXPECT_EQ(run({"knot-isotopy", knot, wire, "-o", folder / "way"}).exit_code, 0);
  EXPECT_EQ(run({"seifert", "--surface", out, "--relax", "-o", folder / "x.obj"}).exit_code, 2);
  EXPECT_EQ(run({"seifert", wire, "--check", out, "--tube", folder / "x.obj"}).exit_code, 2);
  EXPECT_EQ(run({"seifert", wire, "-o", folder / "x.obj", "--tube", folder / "x.stl"}).exit_code, 2);
  const Outcome link = run({"seifert", "-", "--relax", "-o", folder / "x.obj"}, {.input = "braid 2: 1 1\n"});
  EXPECT_EQ(link.exit_code, 3);
  EXPECT_TRUE(contains(link.err, "has 2 components")) << link.err;
}

TEST(SeifertCommand, an_interruption_cancels_it) {
  Folder folder;
  const Outcome ended = run({"seifert", "-", "-o", folder / "s.obj", "--progress", "json"},
                            {.input = "braid 3: 1 -2 1 -2 1 -2\n", .signal_after = {"\"fair\""}});
  EXPECT_EQ(ended.exit_code, 6) << ended.err;
  EXPECT_TRUE(contains(ended.err, "cancelled: nothing was written")) << ended.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(SeifertCommand, streams_and_errors) {
  Folder folder;
  const Outcome hopf =
      run({"seifert", "-", "--format", "off", "-o", "-", "--no-fair", "-q"}, {.input = "braid 2: 1 1\n"});
  EXPECT_EQ(hopf.exit_code, 0) << hopf.err;
  EXPECT_TRUE(hopf.out.starts_with("OFF"));
  const Outcome crossing = run({"seifert", "-", "-o", folder / "s.obj"}, {.input = "0 0 0\n2 2 0\n2 0 0\n0 2 0\n"});
  EXPECT_EQ(crossing.exit_code, 3);
  EXPECT_TRUE(contains(crossing.err, "edge 0 of component 0 and edge 2 of component 0 touch"));
  EXPECT_EQ(run({"seifert", "-"}, {.input = "braid 2: 1 1\n"}).exit_code, 2);
  for (const char* name : {"s.stl", "s.glb"}) {
    const Outcome refused = run({"seifert", "-", "-o", folder / name}, {.input = "braid 2: 1 1\n"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_TRUE(contains(refused.err, "name it *.obj, *.off or *.ply, or add --format")) << refused.err;
  }
  EXPECT_EQ(run({"seifert", folder / "none", "-o", folder / "s.obj"}).exit_code, 3);
  EXPECT_EQ(run({"seifert", "-", "-o", folder / "no/s.obj"}, {.input = "braid 2: 1 1\n"}).exit_code, 4);
  EXPECT_TRUE(folder.names().empty());
}

TEST(IsotopyCommand, a_curve_moves_to_another) {
  Folder folder;
  write(folder / "a.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"><circle r=\"5\"/></svg>\n");
  write(folder / "b.json", "{\"curves\": [{\"points\": [[0, 0], [9, 0], [9, 1], [1, 1], [1, 9], [0, 9], [0, 0]]}]}");
  const Outcome made = run({"isotopy", folder / "a.svg", folder / "b.json", "-o", folder / "way", "--frames", "3"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(contains(made.err, "at every time no curve crosses itself or another"));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"a.svg", "b.json", "way", "way/animation.svg",
                                                   "way/correspondence.json", "way/frame_0000.svg",
                                                   "way/frame_0001.svg", "way/frame_0002.svg", "way/surface.obj"}));
  EXPECT_EQ(run({"check", folder / "way/surface.obj", "-q"}).exit_code, 0);
  EXPECT_EQ(run({"isotopy", folder / "a.svg", folder / "b.json", "-o", folder / "way"}).exit_code, 2);  // not empty
  write(folder / "c.json", "{\"curves\": [{\"closed\": true, \"points\": [[0, 0], [0, 9], [9, 0]]}]}");
  const Outcome other_way = run({"isotopy", folder / "a.svg", folder / "c.json", "-o", folder / "back"});
  EXPECT_EQ(other_way.exit_code, 3);
  EXPECT_TRUE(contains(other_way.err, "runs around the other way"));
  EXPECT_EQ(run({"isotopy", folder / "a.svg", folder / "c.json", "-o", folder / "back", "--reverse", "-q"}).exit_code,
            0);
  // Far from the origin, squares that are small: products of their coordinates say nothing about their areas.
  write(folder / "far.json", R"({"curves": [{"closed": true, "points":
      [[1000000, 1000000], [1000000.001, 1000000], [1000000.001, 1000000.001], [1000000, 1000000.001]]}]})");
  const Outcome far =
      run({"isotopy", folder / "far.json", folder / "far.json", "-o", folder / "stay", "--reverse", "-q"});
  EXPECT_EQ(far.exit_code, 0) << far.err;
  const Outcome no_curves = run({"isotopy", folder / "a.xyz", folder / "a.svg", "-o", folder / "new"});
  EXPECT_EQ(no_curves.exit_code, 3);
  EXPECT_TRUE(contains(no_curves.err, "name it *.svg or *.json")) << no_curves.err;
  EXPECT_FALSE(contains(no_curves.err, "--format")) << no_curves.err;
  const Outcome full = run({"isotopy", folder / "a.svg", folder / "a.svg", "-o", folder / "way"});
  EXPECT_TRUE(contains(full.err, "-o ")) << full.err;
  EXPECT_FALSE(contains(full.err, "--picture")) << full.err;
}

TEST(KnotIsotopyCommand, an_unknot_moves_to_a_circle) {
  Folder folder;
  const std::string knot = folder / "knot.xyz", circle = folder / "circle.xyz", way = folder / "way";
  ASSERT_EQ(run({"sample", "knot_kinks_2", "-o", knot}).exit_code, 0);
  ASSERT_EQ(run({"sample", "knot_circle", "-o", circle}).exit_code, 0);
  const Outcome made =
      run({"knot-isotopy", knot, circle, "-o", way, "--frames", "3", "--report", folder / "report.json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(contains(made.err, "no two triangles of the cylinder in R^4 intersect"));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"knot.xyz", "circle.xyz", "report.json", "way", "way/isotopy.json",
                                                   "way/animation.gif", "way/picture.png", "way/frame_0000.xyz",
                                                   "way/frame_0001.xyz", "way/frame_0002.xyz"}));
  const auto report = nlohmann::json::parse(contents(folder / "report.json"));
  EXPECT_EQ(report["hold"], true);
  EXPECT_EQ(report["status"], "embedded");
  EXPECT_EQ(contents(way + "/frame_0000.xyz"), contents(knot));
  EXPECT_EQ(contents(way + "/frame_0002.xyz"), contents(circle));
  const std::string isotopy = way + "/isotopy.json";
  EXPECT_EQ(run({"knot-isotopy", knot, circle, "--check", isotopy}).exit_code, 0);
  EXPECT_EQ(run({"knot-isotopy", circle, knot, "--check", isotopy, "-q"}).exit_code, 1);
  EXPECT_EQ(run({"knot-isotopy", knot, circle, "-o", way}).exit_code, 2);  // not empty
}

TEST(KnotIsotopyCommand, what_is_not_found_is_said_and_nothing_written) {
  Folder folder;
  write(folder / "left.xyz", "braid 2: -1 -1 -1\n");
  write(folder / "right.xyz", "braid 2: 1 1 1\n");
  const Outcome none = run({"knot-isotopy", folder / "left.xyz", folder / "right.xyz", "-o", folder / "way", "--report",
                            folder / "report.json"});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_TRUE(contains(none.err, "does not prove that there is none"));
  EXPECT_TRUE(contains(none.err, ", sign "));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"left.xyz", "right.xyz", "report.json"}));
  const auto report = nlohmann::json::parse(contents(folder / "report.json"));
  EXPECT_EQ(report["hold"], false);
  EXPECT_FALSE(report["straight_double_points"].empty());

  const Outcome late =
      run({"knot-isotopy", folder / "left.xyz", folder / "right.xyz", "-o", folder / "way", "--time-limit", "0.001"});
  EXPECT_EQ(late.exit_code, 5);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"left.xyz", "right.xyz", "report.json"}));
}

TEST(KnotIsotopyCommand, bad_input_is_named) {
  Folder folder;
  write(folder / "circle.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  const auto refuse = [&](const std::string& text, const std::string& says, int exit_code = 3) {
    write(folder / "bad.xyz", text);
    const Outcome outcome = run({"knot-isotopy", folder / "circle.xyz", folder / "bad.xyz", "-o", folder / "way"});
    EXPECT_EQ(outcome.exit_code, exit_code) << text;
    EXPECT_TRUE(contains(outcome.err, says)) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "bad.xyz")) << outcome.err;
  };
  refuse("0 0 0\n2 2 0\n2 0 0\n0 2 0\n", "edge 0 of component 0 and edge 2 of component 0 touch");
  refuse("0 0 0\n1 0 0\n1 0 0\n0 2 0\n", "points 1 and 2 of component 0 are one");
  refuse("0 0 0\n1 0 0\n", "has 2 points");
  refuse("0 0 0\n1 0\n", "line 2: 2 numbers");
  refuse("0 0 0\n1 0 x\n", "line 2: 'x' is not a coordinate");
  refuse("", "nothing in it");
  refuse("braid 2: 1 1\n", "has 2 components");
  write(folder / "isotopy.json", "{\"rings\": [{\"time\": 0}]}");
  const Outcome wrong =
      run({"knot-isotopy", folder / "circle.xyz", folder / "circle.xyz", "--check", folder / "isotopy.json"});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_TRUE(contains(wrong.err, "isotopy.json: rings[0]: \"points\" is missing")) << wrong.err;
  EXPECT_EQ(run({"knot-isotopy", folder / "circle.xyz", folder / "circle.xyz"}).exit_code, 2);
  EXPECT_EQ(run({"knot-isotopy", folder / "none", folder / "circle.xyz", "-o", folder / "way"}).exit_code, 3);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"circle.xyz", "bad.xyz", "isotopy.json"}));
}

}  // namespace
}  // namespace unsnarl::cli
