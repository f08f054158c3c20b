#include <gtest/gtest.h>
#include <string.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "cli/program_test.h"

namespace unsnarl::cli {
namespace {

using Usage = ProgramTest;

TEST_F(Usage, help_and_version_go_to_standard_output) {
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

TEST_F(Usage, versions_of_all_libraries) {
  for (const bool json_first : {false, true}) {
    const Outcome outcome = json_first ? run({"--json", "--version"}) : run({"--version", "--json"});
    EXPECT_EQ(outcome.exit_code, 0);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ("unsnarl " + json["unsnarl"].get<std::string>() + "\n", run({"--version"}).out);
    for (const char* name : {"Boost", "CLI11", "Eigen", "glibc", "oneTBB", "zlib", "{fmt}"})
      EXPECT_TRUE(std::regex_match(json["libraries"][name].get<std::string>(), std::regex(R"(\d+(\.\d+)+.*)"))) << name;
  }
}

TEST_F(Usage, usage_errors_exit_with2) {
  const std::string in = file("in.obj", clean_cube);
  expect_refusal({}, 2, "");
  expect_refusal({"mend"}, 2, "fix, batch, check, view, sample, curves, isotopy, seifert, knot-isotopy, routes");
  expect_refusal({"fxi", in}, 2, "Unknown command 'fxi'. Did you mean fix? Commands: fix, ");
  expect_refusal({"version"}, 2, "Unknown command 'version'. Did you mean --version?");
  expect_refusal({in}, 2, "'unsnarl check " + in + "'");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--max-displacment", "1"}, 2, "Did you mean --max-displacement?");
  expect_refusal({"fix", in, folder / "o.obj"}, 2, "unsnarl fix " + in + " -o " + (folder / "o.obj"));
  expect_refusal({"fix"}, 2, "IN");
  expect_refusal({"fix", in}, 2, "-o");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--frobnicate"}, 2, "frobnicate");
  expect_refusal({"batch", in, "-o", folder / "o", "--max-displacement", "1"}, 2,
                 "'unsnarl batch' has no option --max-displacement. Options of 'unsnarl fix' go after '--'.");
  expect_refusal({"batch", in, "--", "--max-displacement", "1"}, 2, "-o");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--goal", "al"}, 2,
                 "--goal must be 'all' or 'disjoint', not 'al'");
  expect_refusal({"fix", in, "-o"}, 2, "-o needs a file name, as in -o out.obj");
  expect_refusal({"isotopy", in, in, "-o"}, 2, "-o needs the name of a folder");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--goal"}, 2, "--goal needs a value: --goal all|disjoint");
  expect_refusal({"view", in}, 2, "'unsnarl view' needs -o PAGE.html");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--frames", "0:2"}, 2, "--frames needs --sequence");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--each", "--together"}, 2, "exclude each other");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--time-limit", "-1"}, 2, "time-limit");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--in-place"}, 2, "--in-place");
  expect_refusal({"fix", in, "-o", folder / "o.stl"}, 2, "keeps the format");
  expect_refusal({"fix", in, "-o", in}, 2, "--in-place");
  expect_refusal({"fix", in, "-o", folder.string() + "/./in.obj"}, 2, "--in-place");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--report", in}, 2, "the same");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--report", folder / "o.obj"}, 2, "the same");
  expect_refusal({"fix", "-", "-o", folder / "o.obj"}, 2, "--format");
  expect_refusal({"fix", "-", "--in-place", "--format", "obj"}, 2, "--in-place");
  expect_refusal({"fix", in, "-o", folder / "o.obj", "--format", "doc"}, 2, "--format must be obj, off, ");
  expect_refusal({"sample"}, 2, "--list");
  expect_refusal({"sample", "no_such_thing", "-o", folder / "o.obj"}, 2, "no_such_thing");
  expect_refusal({"sample", "book", "-o", folder / "o.gltf"}, 2, "gltf");
  expect_refusal({"sample", "book", "-o", folder / "o.obj", "--set", "pages"}, 2, "NAME=NUMBER");
  EXPECT_EQ(contents(in), clean_cube);
}

TEST_F(Usage, help_and_version_are_found_however_asked_for) {
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  EXPECT_EQ(run({"help", "fix"}).out, run({"fix", "--help"}).out);
  EXPECT_EQ(run({"fix", "--version"}).out, run({"--version"}).out);
  EXPECT_EQ(run({"-V"}).out, run({"--version"}).out);
}

TEST_F(Usage, files_are_named_by_what_is_written_to_them) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  for (const char* name : {"x.jpg", "x.mp4", "x"})
    expect_refusal({"fix", in, "-o", out, "--picture", folder / name}, 2, "must be named *.png or *.gif");
  expect_refusal({"fix", in, "-o", out, "--view", folder / "x.png"}, 2, "must be named *.html");
  expect_refusal({"fix", in, "-o", out, "--highlight", folder / "x.obj"}, 2, "must be named *.ply");
  expect_refusal({"view", in, "-o", folder / "x.png"}, 2, "must be named *.html");
  expect_refusal({"sample", "book", "-o", folder / "x.vtk"}, 2, "vtk");
  expect_refusal({"fix", in, "-o", folder / "x.vtk"}, 2, "keeps the format");
  const std::string grid = file(
      "g.vtu",
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points>"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 "
      "0</DataArray></Points><Cells>"
      "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5</DataArray></Cells></Piece></UnstructuredGrid>"
      "</VTKFile>\n");
  expect_refusal({"fix", grid, "-o", folder / "x.vtp"}, 2, "keeps the format of the input, vtp; name it *.vtu");
}

TEST_F(Usage, what_is_no_number_in_the_range_is_refused) {
  const std::string in = file("in.obj", crossing);
  for (const char* value : {"90", "200", "-1", "nan", "inf", "x"})
    expect_refusal({"fix", in, "-o", folder / "out.obj", "--min-dihedral", value}, 2, "--min-dihedral");
  for (const char* option : {"--max-displacement", "--min-gap", "--time-limit", "--memory-limit", "--weld-tolerance"})
    for (const char* value : {"nan", "-1"})
      expect_refusal({"fix", in, "-o", folder / "out.obj", option, value}, 2, option);
  expect_refusal({"fix", in, "-o", folder / "out.obj", "--max-displacement", "1%"}, 2,
                 "'1%' is not a number; 1% is 0.01");
  expect_refusal({"fix", in, "-o", folder / "out.obj", "--min-dihedral", "90"}, 2,
                 "--min-dihedral is in degrees, as in 0.1; '90' is not less than 90");
  expect_refusal({"fix", in, "-o", folder / "out.obj", "--threads", "-3"}, 2,
                 "--threads must be a whole number from 0 to 1024, not '-3'");
  for (const char* option : {"--fix-component", "--only-component", "--rigid-component"})
    for (const char* value : {"x", "1.5", "-1"})
      expect_refusal({"fix", in, "-o", folder / "out.obj", option, value}, 2,
                     option + (" must be a whole number, 0 or more, not '" + std::string(value)) + "'");
}

TEST_F(Usage, numbers_have_the_unit_that_the_message_names) {
  const std::string in = file("in.obj", crossing);
  struct Case {
    const char *option, *value, *words;
  };
  for (const auto& [option, value, words] :
       {Case{"--time-limit", "1h", "--time-limit is in seconds, as in 3600; '1h' is not a number"},
        {"--time-limit", "-1", "--time-limit is in seconds, as in 3600; '-1' is less than 0"},
        {"--time-limit", "inf", "'inf' is infinite"},
        {"--memory-limit", "4G", "--memory-limit is in MB, as in 4000; '4G' is not a number"},
        {"--max-displacement", "0,1", "'0,1' is not a number; use a decimal point: 0.1"},
        {"--min-gap", "1mm", "with --absolute, a length in the units of the file; '1mm' is not a number"},
        {"--weld-tolerance", "1e-3m", "is a length in the units of the file"}}) {
    const Outcome outcome = run({"fix", in, "-o", folder / "out.obj", option, value});
    EXPECT_EQ(outcome.exit_code, 2) << option;
    EXPECT_TRUE(contains(outcome.err, words)) << outcome.err;
  }
  expect_refusal({"batch", in, "-o", folder / "b", "--time-limit", "2min"}, 2, "--time-limit is in seconds");
  expect_refusal({"check", in, "--memory-limit", "1GB"}, 2, "--memory-limit is in MB");
}

/// Lines of help that are not to be copied: those of examples and lists begin with two blanks and stay whole.
std::size_t longest_line(const std::string& help) {
  std::size_t longest = 0;
  std::istringstream lines(help.substr(0, help.find("Classes of pairs:")));
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  return longest;
}

TEST_F(Usage, help_is_as_wide_as_the_terminal) {
  const auto help_with = [&](const char* columns) {
    return run({"check", "--help"}, {.in_child = [=] { ::setenv("COLUMNS", columns, 1); }}).out;
  };
  EXPECT_LE(longest_line(help_with("60")), 60u);
  EXPECT_GT(longest_line(help_with("90")), 80u);
  EXPECT_LE(longest_line(help_with("90")), 90u);
  EXPECT_LE(longest_line(help_with("500")), 100u);
  for (const char* unknown : {"", "0", "wide"}) EXPECT_LE(longest_line(help_with(unknown)), 80u) << unknown;
  EXPECT_NE(help_with("60").find("unsnarl check - --format stl < part.stl --pairs pairs.csv\n"), std::string::npos);
}

TEST_F(Usage, usual_options_come_first_and_those_of_research_last) {
  const std::string help = run({"fix", "--help"}).out;
  std::vector<std::size_t> places;
  for (const char* const words :
       {"--output", "--max-displacement", "--report", "--fix-group", "--no-recover", "--paper "})
    places.push_back(help.find(words));
  places.push_back(help.find("--paper-bandwidth"));
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
  EXPECT_NE(places.back(), std::string::npos);
  EXPECT_EQ(help.find("\n\n\n"), std::string::npos);
}

TEST_F(Usage, options_that_do_nothing_beside_the_others_are_refused) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  expect_refusal({"fix", in, "-o", out, "--absolute"}, 2,
                 "--absolute has an effect only with --max-displacement or --min-gap");
  for (const std::vector<std::string>& call : {std::vector<std::string>{"fix", in, "-o", out}, {"check", in}}) {
    std::vector<std::string> words = call;
    words.insert(words.end(), {"--weld-tolerance", "0.5", "--weld", "none"});
    expect_refusal(words, 2, "--weld-tolerance has no effect with --weld none");
  }
}

TEST_F(Usage, a_gap_many_times_as_wide_as_the_faces_is_refused) {
  const std::string in = folder / "tubes.obj";
  ASSERT_EQ(run({"sample", "crossing_tubes", "-o", in, "--resolution", "12"}).exit_code, 0);
  expect_refusal({"fix", in, "-o", folder / "out.obj", "--min-gap", "0.6"}, 2, "--min-gap: a gap of");
  EXPECT_EQ(run({"fix", in, "-o", folder / "out.obj", "--min-gap", "0.002", "--absolute"}).exit_code, 0);
}

TEST_F(Usage, inputs_that_make_no_sense_exit_with3) {
  const std::string out = folder / "out.obj";
  expect_refusal({"fix", folder / "missing.obj", "-o", out}, 3, "missing.obj");
  expect_refusal({"check", folder / "missing.obj"}, 3, "missing.obj");
  expect_refusal({"check", folder.string()}, 3, "");
  const std::string wrong = file("wrong.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  expect_refusal({"fix", wrong, "-o", out}, 3, "9");
  expect_refusal({"fix", file("nan.obj", "v 0 0 nan\nf 1 1 1\n"), "-o", out}, 3, "1");
  const std::string in = file("in.obj", crossing);
  expect_refusal({"fix", in, "-o", out, "--fix-vertices", folder / "none.txt"}, 3,
                 "none.txt: cannot open: No such file or directory; --fix-vertices needs");
  expect_refusal({"fix", in, "-o", out, "--fix-vertices", folder.string()}, 3, "cannot read: Is a directory");
  expect_refusal({"fix", in, "-o", out, "--fix-vertices", file("ids.txt", "0 1\n8 # too large\n")}, 3, "ids.txt:2");
  expect_refusal({"fix", in, "-o", out, "--fix-vertices", file("ids.txt", "0 -1\n")}, 3, "ids.txt:1");
}

TEST_F(Usage, foreign_formats_are_refused_with_a_hint) {
  const std::string out = folder / "out.obj";
  expect_refusal({"fix", file("a.fbx", "Kaydara FBX Binary"), "-o", out}, 3,
                 "FBX files are not read; import it into Blender");
  expect_refusal({"check", file("b.blend", "")}, 3, "Blend files are not read");
  for (const auto& [name, advice] : {std::pair("a.dae", "assimp export IN OUT.glb"),
                                     {"a.step", "gmsh -2 IN -o OUT.msh"},
                                     {"a.mesh", "meshio convert IN OUT.ply"},
                                     {"a.nii", "3D Slicer"},
                                     {"a.xyz", "points have no faces"},
                                     {"a.smesh", "save the surface as OFF, PLY or STL"},
                                     {"a.tri", "mne.read_tri"},
                                     {"a.zip", "unpack it first"}})
    expect_refusal({"check", file(name, "x")}, 3, advice);
  expect_refusal({"check", file("a.unknown", crossing)}, 3,
                 "neither the extension nor the content tells the format; add --format: obj, off");
}

TEST_F(Usage, content_and_name_are_of_one_format) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_refusal({"check", file("a.obj", ply)}, 3, "by its content this is ply, not obj; name it *.ply");
  expect_refusal({"check", file("a.stl", ply)}, 3, "by its content this is ply, not stl");
  EXPECT_EQ(run({"check", file("a", ply)}).exit_code, 0);
  EXPECT_EQ(run({"check", file("b.obj", ply), "--format", "ply"}).exit_code, 0);
  // Two gigabytes of nothing are refused by the first bytes.
  fs::resize_file(file("sparse.stl", ""), std::uintmax_t{2} << 30);
  const auto before = folder.names();
  RunOptions little_memory;
  if (memory_can_be_limited)
    little_memory.in_child = [] {
      const rlimit both = {rlim_t{1} << 30, rlim_t{1} << 30};
      ::setrlimit(RLIMIT_AS, &both);
    };
  const Outcome outcome = run({"check", folder / "sparse.stl", "--threads", "1"}, little_memory);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "the first 4096 bytes are zero")) << outcome.err;
}

TEST_F(Usage, outputs_that_cannot_be_written_exit_with4) {
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

/// No terminal does anything but show this text.
void expect_visible(const std::string& text) {
  const auto acts = [](unsigned char c) { return (c < ' ' && c != '\n') || c == 0x7f; };
  EXPECT_FALSE(std::any_of(text.begin(), text.end(), acts)) << text;
  EXPECT_FALSE(contains(text, "\xc2\x9b") || contains(text, "\xe2\x80\xae")) << text;
}

TEST_F(Usage, names_of_files_are_shown_not_obeyed) {
  const std::string name = "a\x1b[31m\r\n\xc2\x9b\xe9\x7f\xe2\x80\xae",
                    shown = "a\\x1b[31m\\x0d\\x0a\\x9b\\xe9\\x7f\\u{202e}";
  const std::string missing = folder / name, plain = file("plain.obj", crossing);
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"fix", missing, "-o", folder / "o"},
                                                    {"fix", plain, "-o", missing + "/o.obj"},
                                                    {"fix", plain, "-o", folder / "o.obj", "--fix-vertices", missing},
                                                    {"fix", plain, "-o", folder / "o.obj", "--fix-group", name},
                                                    {"fix", "--sequence", missing, "-o", folder / "o"},
                                                    {"check", missing},
                                                    {"view", missing, "-o", folder / "o.html"},
                                                    {"batch", missing, "-o", folder / "b"},
                                                    {"sample", name, "-o", folder / "o.obj"},
                                                    {"curves", missing + ".svg", "-o", folder / "o.svg"},
                                                    {"isotopy", missing + ".svg", missing + ".svg", "-o", folder / "i"},
                                                    {"seifert", missing, "-o", folder / "o.obj"},
                                                    {"knot-isotopy", missing, missing, "-o", folder / "k"},
                                                    {"routes", missing, "-o", folder / "r"},
                                                    {"fix", plain, "-o", folder / "o.obj", "--weld", name},
                                                    {name}}) {
    const Outcome outcome = run(arguments);
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.exit_code, 70);
    expect_visible(outcome.err + outcome.out);
    EXPECT_TRUE(contains(outcome.err, shown)) << arguments[0] << '\n' << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  const std::string there = file(name + ".obj", crossing);
  const Outcome checked = run({"check", there}), fixed = run({"fix", there, "-o", folder / (name + ".o.obj")});
  EXPECT_EQ(checked.exit_code, 1) << checked.err;
  EXPECT_EQ(fixed.exit_code, 0) << fixed.err;
  for (const std::string& text : {checked.out, fixed.err}) {
    expect_visible(text);
    EXPECT_TRUE(contains(text, shown + ".obj")) << text;
  }
}

TEST_F(Usage, names_in_files_are_shown_not_obeyed) {
  const std::string name =
                        "a\x1b]0;owned\a\xc2\x9b"
                        "2J",
                    shown = "a\\x1b]0;owned\\x07\\x9b2J";
  const std::string in =
      file("in.obj", "mtllib " + name + "\ng " + name + "\no " + name + "\nusemtl " + name + "\n" + crossing);
  for (const char* const option : {"--fix-group", "--fix-object", "--fix-material"}) {
    const Outcome outcome = run({"fix", in, "-o", folder / "o.obj", option, "x"});
    EXPECT_EQ(outcome.exit_code, 2);
    expect_visible(outcome.err);
    EXPECT_TRUE(contains(outcome.err, shown)) << outcome.err;
  }
  const Outcome broken = run({"check", file("broken.obj", "v 0 0 " + name + "\n")});
  EXPECT_EQ(broken.exit_code, 3);
  expect_visible(broken.err);
  expect_visible(run({"check", in}).out);
}

TEST_F(Usage, an_error_of_the_system_exits_with9) {
  if (!calls_can_fail) GTEST_SKIP() << "calls cannot be made to fail here";
  const std::string in = file("in.obj", crossing);
  const std::string svg = file("in.svg", "<svg><path d='M0 0 10 10 10 0 0 10z'/></svg>");
  const std::string knot = file("in.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  const std::string plan = file("in.json", "{}"), frame = file("f1.obj", crossing);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"fix", in, "-o", folder / "o.obj"},
        {"check", in},
        {"view", in, "-o", folder / "o.html"},
        {"fix", "--sequence", frame, file("f2.obj", crossing), "-o", folder / "s"},
        {"curves", svg, "-o", folder / "o.svg"},
        {"isotopy", svg, svg, "-o", folder / "i"},
        {"seifert", knot, "-o", folder / "o.obj"},
        {"knot-isotopy", knot, knot, "-o", folder / "k"},
        {"routes", plan, "-o", folder / "r"}})
    for (const auto& [call, error_number] : {std::pair("open", EMFILE), std::pair("read", EIO)}) {
      const std::string input = arguments[1] == "--sequence" ? arguments[2] : arguments[1];
      const RunOptions failing = {.in_child = with_failing(call, fs::path(input).filename(), error_number)};
      const Outcome outcome = run(arguments, failing);
      EXPECT_EQ(outcome.exit_code, 9) << arguments[0] << ' ' << outcome.err;
      EXPECT_TRUE(contains(outcome.err, ::strerror(error_number))) << outcome.err;
      EXPECT_FALSE(fs::exists(folder / "o.obj"));
    }
  const std::string report = folder / "report.json";
  const RunOptions failing = {.in_child = with_failing("read", "in.obj", EIO)};
  EXPECT_EQ(run({"fix", in, "-o", folder / "o.obj", "--report", report}, failing).exit_code, 9);
  const auto json = nlohmann::json::parse(contents(report));
  EXPECT_EQ(json["status"], "system_error");
  EXPECT_EQ(json["exit_code"], 9);
}

}  // namespace
}  // namespace unsnarl::cli
