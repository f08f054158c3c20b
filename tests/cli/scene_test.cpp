#include <nlohmann/json.hpp>
#include <tuple>

#include "cli/program_test.h"
#include "unsnarl/document.h"
#include "unsnarl/intersections.h"
#include "unsnarl/scene_document.h"

namespace unsnarl::cli {
namespace {

using Json = nlohmann::json;

/// Tetrahedra, the second of which sticks into the first with its tip; each fine by itself.
const std::string large = "# large\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4 # top\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const std::string small =
    "ply\nformat ascii 1.0\ncomment small\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n1.2 1.2 1.1\n2.6 2.5 2\n2.5 2.6 2.2\n"
    "2.4 2.4 2.7\n3 0 1 3\n3 0 2 1\n3 1 2 3\n3 0 3 2\n";
/// Away from both.
const std::string apart = "OFF\n4 4 0\n9 9 9\n10 9 9\n9 10 9\n9 9 10\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

class SceneFiles : public ProgramTest {
 protected:
  SceneFiles() {
    write(a, large);
    write(b, small);
    write(c, apart);
  }
  std::size_t pairs_in(const std::vector<std::string>& paths) const {
    std::vector<Document> documents;
    for (const std::string& path : paths) documents.push_back(Document::read(path));
    return find_intersections(SceneDocument(std::move(documents), paths).surface()).size();
  }
  const std::string a = folder / "a.obj", b = folder / "b.ply", c = folder / "c.off", out = folder / "new/out";
};

TEST_F(SceneFiles, what_crosses_between_files_is_resolved_and_each_is_written_back) {
  const Outcome outcome = run({"fix", a, b, c, "-o", out, "--report", folder / "r.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("between a.obj and b.ply: "), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.names(), (std::set<std::string>{"a.obj", "b.ply", "c.off", "new", "new/out", "new/out/a.obj",
                                                   "new/out/b.ply", "new/out/c.off", "r.json"}));
  EXPECT_EQ(contents(out + "/c.off"), apart);
  EXPECT_TRUE(contents(out + "/a.obj").starts_with("# large\n"));
  EXPECT_TRUE(contents(out + "/b.ply").starts_with("ply\nformat ascii 1.0\ncomment small\n"));
  EXPECT_GT(pairs_in({a, b, c}), 0u);
  EXPECT_EQ(pairs_in({out + "/a.obj", out + "/b.ply", out + "/c.off"}), 0u);

  const Json report = Json::parse(contents(folder / "r.json"));
  EXPECT_TRUE(report["input"]["path"].is_null());
  ASSERT_EQ(report["files"].size(), 3u);
  EXPECT_EQ(report["files"][1]["name"], "b.ply");
  EXPECT_EQ(report["files"][1]["format"], "ply");
  EXPECT_EQ(report["files"][1]["first_vertex"], 4);
  EXPECT_EQ(report["files"][1]["output"], out + "/b.ply");
  EXPECT_EQ(report["files"][2]["untouched_share"], 1.0);
  ASSERT_EQ(report["between_files"].size(), 1u);
  EXPECT_EQ(report["between_files"][0]["files"], Json({"a.obj", "b.ply"}));
  EXPECT_EQ(report["between_files"][0]["before"], report["before"]);
  EXPECT_EQ(report["between_files"][0]["after"]["total"], 0);
}

TEST_F(SceneFiles, files_can_be_held_or_alone_be_moved) {
  for (const auto& [option, name, held, moved] :
       {std::tuple{"--fix-file", "a.obj", "a.obj", "b.ply"}, {"--only-file", "a.obj", "b.ply", "a.obj"}}) {
    const Outcome outcome = run({"fix", a, b, "-o", out, option, name});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(contents(out + "/" + held), contents(folder / held));
    EXPECT_NE(contents(out + "/" + moved), contents(folder / moved));
    EXPECT_EQ(pairs_in({out + "/a.obj", out + "/b.ply"}), 0u);
    fs::remove_all(out);
  }
  expect_refusal({"fix", a, b, "-o", out, "--fix-file", "d.obj"}, 2, "there are: 'a.obj', 'b.ply'");
}

TEST_F(SceneFiles, the_inner_file_goes_in) {
  const std::string report = folder / "r.json";
  // The small one has only its tip in the large one: without --nested it is pushed out.
  const auto nested = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"fix", a, b, c, "-o", out, "--report", report};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const Outcome outcome = nested({"--nested", "b.ply,a.obj"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("b.ply lies inside a.obj: 3 vertices on the wrong side before, 0 after"),
            std::string::npos)
      << outcome.err;
  const Json json = Json::parse(contents(report));
  EXPECT_EQ(json["status"], "embedded");
  ASSERT_EQ(json["nested"].size(), 1u);
  EXPECT_EQ(json["nested"][0], Json({{"inner", "b.ply"},
                                     {"outer", "a.obj"},
                                     {"wrong_before", 3},
                                     {"wrong_after", 0},
                                     {"nested", true},
                                     {"apart", Json::array()}}));
  EXPECT_EQ(pairs_in({out + "/a.obj", out + "/b.ply"}), 0u);
  EXPECT_EQ(contents(out + "/c.off"), apart);

  // Without the option nothing is said of it; c is beside a, and stays there.
  EXPECT_EQ(nested({}).exit_code, 0);
  EXPECT_FALSE(Json::parse(contents(report)).contains("nested"));
  const Outcome beside = nested({"--nested", "c.off,a.obj", "--nested", "b.ply,a.obj"});
  EXPECT_EQ(beside.exit_code, 7);
  EXPECT_NE(beside.err.find("c.off does not lie inside a.obj: 4 vertices on the wrong side before, 4 after"),
            std::string::npos)
      << beside.err;
  EXPECT_NE(beside.err.find("4 after; one component (at vertex 8) is entirely on the wrong side"), std::string::npos)
      << beside.err;
  EXPECT_NE(beside.err.find("not nested as asked"), std::string::npos) << beside.err;
  const Json left = Json::parse(contents(report));
  EXPECT_EQ(left["status"], "not_nested");
  EXPECT_EQ(left["exit_code"], 7);
  EXPECT_EQ(left["nested"][0]["apart"], Json({8}));
  EXPECT_TRUE(left["nested"][1]["nested"]);
  EXPECT_TRUE(left["output"]["written"]);

  nested({"--nested", "a.obj,b.ply", "--time-limit", "1"});
  ASSERT_EQ(Json::parse(contents(report))["input"]["notes"].size(), 1u);
  EXPECT_TRUE(contains(Json::parse(contents(report))["input"]["notes"][0], "--nested: "));
}

TEST_F(SceneFiles, nesting_that_makes_no_sense_is_refused) {
  write(folder / "open.off", "OFF\n3 1 0\n0 0 9\n1 0 9\n0 1 9\n3 0 1 2\n");
  expect_refusal({"fix", a, b, "-o", out, "--nested", "b.ply,d.obj"}, 2, "there are: 'a.obj', 'b.ply'");
  expect_refusal({"fix", a, b, "-o", out, "--nested", "b.ply"}, 2, "two surfaces");
  expect_refusal({"fix", a, b, "-o", out, "--nested", "b.ply,a.obj,b.ply"}, 2, "b.ply would have to lie inside itself");
  expect_refusal({"fix", a, b, "-o", out, "--nested", "b.ply,a.obj", "--nested", "a.obj,b.ply"}, 2, "inside itself");
  write(folder / "held.off",
        "OFF\n4 4 0\n.1 .1 .1\n.2 .1 .1\n.1 .2 .1\n.1 .1 .2\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  expect_refusal({"fix", a, folder / "held.off", "-o", out, "--nested", "a.obj,held.off"}, 2, "the wrong way round");
  expect_refusal({"fix", a, folder / "open.off", "-o", out, "--nested", "a.obj,open.off"}, 2, "open.off is not closed");
  expect_refusal({"fix", a, b, "-o", out, "--nested", "b.ply,a.obj", "--rigid-file", "a.obj"}, 2, "--nested");
  expect_refusal({"fix", a, b, "-o", out, "--nested", "b.ply,a.obj", "--each"}, 2, "--nested");
  expect_refusal({"fix", a, "-o", out, "--nested", "b.ply,a.obj"}, 2, "no object 'b.ply'");
}

TEST_F(SceneFiles, objects_of_one_file_are_nested) {
  const std::string in = sample("crossing_shells", {"--resolution", "24"});
  const Outcome outcome = run({"fix", in, "-o", folder / "fixed.obj", "--nested", "inner,outer,skin"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("inner lies inside outer: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("outer lies inside skin: "), std::string::npos) << outcome.err;
}

TEST_F(SceneFiles, check_counts_within_and_between_files) {
  const Outcome text = run({"check", a, b, c});
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_NE(text.out.find("3 files: 12 vertices"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("between a.obj and b.ply"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("within a.obj"), std::string::npos) << text.out;
  const Json json = Json::parse(run({"check", a, b, c, "--json"}).out);
  EXPECT_EQ(json["files"][0]["pairs"]["total"], 0);
  EXPECT_EQ(json["between_files"][0]["pairs"], json["pairs"]);
  EXPECT_EQ(run({"check", a, c}).exit_code, 0);
}

TEST_F(SceneFiles, all_appear_or_none) {
  fs::create_directories(out);
  fs::create_directories(out + "/b.ply");  // cannot be replaced
  expect_refusal({"fix", a, b, "-o", out}, 4, "is a folder");
  fs::remove(out + "/b.ply");
  expect_refusal({"fix", a, b, "-o", out, "--fix-file", "a.obj", "--fix-file", "b.ply"}, 7, "no file written");
}

TEST_F(SceneFiles, links_in_the_folder_are_replaced) {
  fs::create_directories(out);
  write(folder / "precious.obj", "precious");
  fs::create_symlink(folder / "precious.obj", out + "/a.obj");
  EXPECT_EQ(run({"fix", a, b, "-o", out}).exit_code, 0);
  EXPECT_EQ(contents(folder / "precious.obj"), "precious");
  EXPECT_EQ(pairs_in({out + "/a.obj", out + "/b.ply"}), 0u);
}

TEST_F(SceneFiles, what_makes_no_sense_is_refused) {
  fs::create_directory(folder / "other");
  write(folder / "other/a.obj", large);
  expect_refusal({"fix", a, folder / "other/a.obj", "-o", out}, 2, "same name");
  expect_refusal({"fix", a, a, "-o", out}, 2, "same name");
  expect_refusal({"fix", a, b, "-o", folder.string()}, 2, "use another folder");
  expect_refusal({"fix", a, b, "--in-place"}, 2, "one file");
  expect_refusal({"fix", a, b, "-o", "-"}, 2, "folder");
  expect_refusal({"fix", a, "-", "-o", out, "--format", "obj"}, 2, "standard input");
  expect_refusal({"fix", a, b, "-o", c}, 4, "cannot make this folder");
  expect_refusal({"fix", a, folder / "missing.obj", "-o", out}, 3, "missing.obj");
  expect_refusal({"fix", a, b, "-o", "/proc/no/such"}, 4, "/proc/no/such");
  expect_refusal({"check", a, "-", "--format", "obj"}, 2, "standard input");
}

TEST_F(SceneFiles, other_units_are_pointed_out) {
  write(folder / "mm.off", "OFF\n3 1 0\n0 0 9000\n90000 0 9000\n0 70000 9000\n3 0 1 2\n");
  const Outcome outcome = run({"check", a, folder / "mm.off"});
  EXPECT_NE(outcome.err.find("mm.off is 16457 times"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("same units"), std::string::npos) << outcome.err;
  write(folder / "m.off",
        "OFF\n3 1 0\n0 0 0\n0.009 0 0\n0 0.007 0\n3 0 1 2\n");  // a is somewhat smaller, in millimetres
  EXPECT_NE(run({"check", a, folder / "m.off"}).err.find("a.obj is 608 times"), std::string::npos);
  EXPECT_EQ(run({"check", a, c}).err, "");
}

TEST_F(SceneFiles, pictures_show_each_in_its_colour) {
  EXPECT_EQ(run({"fix", a, b, "-o", out, "--picture", folder / "two.png"}).exit_code, 0);
  write(folder / "both.obj", large +
                                 "v 1.2 1.2 1.1\nv 2.6 2.5 2\nv 2.5 2.6 2.2\nv 2.4 2.4 2.7\nf 5 7 6\nf 5 6 8\n"
                                 "f 6 7 8\nf 5 8 7\n");
  EXPECT_EQ(run({"fix", folder / "both.obj", "-o", folder / "o.obj", "--picture", folder / "one.png"}).exit_code, 0);
  EXPECT_NE(contents(folder / "two.png"), contents(folder / "one.png"));
}

TEST_F(SceneFiles, the_page_shows_all_files_before_and_after) {
  ASSERT_EQ(run({"fix", a, b, "-o", out}).exit_code, 0);
  EXPECT_EQ(run({"view", a, b, out, "-o", folder / "p.html"}).exit_code, 0);
  EXPECT_NE(contents(folder / "p.html").find("\"files\":[{\"name\":\"a.obj\""), std::string::npos);
  EXPECT_EQ(run({"view", a, b, "--scene", "-o", folder / "p.html"}).exit_code, 0);
  EXPECT_EQ(run({"view", a, b, "-o", folder / "p.html"}).exit_code, 3);  // no repaired version of a
}

}  // namespace
}  // namespace unsnarl::cli
