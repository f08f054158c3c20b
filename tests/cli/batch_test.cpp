#include <fmt/format.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program_test.h"

namespace unsnarl::cli {
namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
class BatchCli : public ProgramTest {
 protected:
  void mesh(const std::string& name, const std::string& bytes) {
    fs::create_directories(fs::path(folder / ("in/" + name)).parent_path());
    write(folder / ("in/" + name), bytes);
  }
  /// A program in place of `unsnarl fix` that notes the mesh, runs these shell commands and then the real one. $2 is
  /// the mesh.
  std::vector<std::string> worker(const std::string& commands) {
    const std::string path = folder / "worker";
    write(path, fmt::format("#!/bin/sh\necho $2 >> '{}'\n{}\nexec '{}' \"$@\"\n", folder / "calls", commands,
                            UNSNARL_PROGRAM));
    fs::permissions(path, fs::perms::owner_all);
    return {"--worker", path};
  }
  Outcome batch(const std::vector<std::string>& more = {}, const RunOptions& options = {}) {
    std::vector<std::string> arguments = {"batch", in, "-o", out, "--jobs", jobs, "--threads", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, options);
  }
  std::map<std::string, nlohmann::json> results() const {
    std::map<std::string, nlohmann::json> found;
    std::istringstream lines(contents(out + "/results.jsonl"));
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::json::parse(line);
      found[json["mesh"]] = json;
    }
    return found;
  }
  std::size_t calls() const {
    const std::string text = contents(folder / "calls");
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }
  std::string in = folder / "in", out = folder / "out", jobs = "2";
};

/// Sizes around the ends of the blocks of 64 bytes, and of the pieces in which files are read.
TEST_F(BatchCli, hashes_are_those_of_sha256sum) {
  for (const std::size_t size : {55, 56, 57, 63, 64, 65, 119, 120, 127, 128, 65536, 70001})
    mesh(fmt::format("{}.obj", size), triangle + std::string(size - triangle.size(), '#'));
  ASSERT_EQ(batch().exit_code, 0);
  ASSERT_EQ(std::system(fmt::format("cd '{}' && sha256sum *.obj > ../sums", in).c_str()), 0);
  std::istringstream sums(contents(folder / "sums"));
  std::size_t count = 0;
  const auto found = results();
  for (std::string sum, name; sums >> sum >> name; ++count) EXPECT_EQ(found.at(name)["input_sha256"], sum) << name;
  EXPECT_EQ(count, found.size());
}

TEST_F(BatchCli, repairs_all_below_a_folder_as_fix_does) {
  mesh("a/crossing.obj", crossing);
  mesh("triangle.obj", triangle);
  mesh("b/wrong.obj", "v 0 0 0\nf 1 1 9\n");
  mesh("b/notes.txt", "no mesh");
  mesh(".hidden/crossing.obj", crossing);
  const Outcome outcome = batch({"--thumbnails", "--", "--precision", "float64"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(run({"fix", folder / "in/a/crossing.obj", "-o", folder / "alone.obj", "--precision", "float64"}).exit_code,
            0);
  EXPECT_EQ(contents(out + "/fixed/a/crossing.obj"), contents(folder / "alone.obj"));
  EXPECT_EQ(contents(out + "/fixed/triangle.obj"), triangle);
  EXPECT_FALSE(fs::exists(out + "/fixed/b/wrong.obj"));
  const auto found = results();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found.at("a/crossing.obj")["status"], "embedded");
  EXPECT_GT(found.at("a/crossing.obj")["pairs_before"], 0);
  EXPECT_EQ(found.at("a/crossing.obj")["thumbnail"], "thumbnails/a/crossing.obj.png");
  EXPECT_TRUE(fs::exists(out + "/thumbnails/a/crossing.obj.png"));
  EXPECT_EQ(found.at("b/wrong.obj")["status"], "invalid_input");
  EXPECT_NE(found.at("b/wrong.obj")["message"].get<std::string>().find("9"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(contents(out + "/reports/a/crossing.obj.json"))["status"], "embedded");
  EXPECT_EQ(contents(out + "/results.csv").rfind("mesh,status,exit_code,", 0), 0u);
  EXPECT_NE(contents(out + "/index.html").find("a/crossing.obj"), std::string::npos);
  EXPECT_FALSE(fs::exists(out + "/work"));
}

TEST_F(BatchCli, what_is_done_is_not_done_again_unless_something_changes) {
  mesh("crossing.obj", crossing);
  mesh("triangle.obj", triangle);
  const std::vector<std::string> arguments = worker("");
  const auto expect_calls = [&](std::size_t more, const std::vector<std::string>& options = {}) {
    const std::size_t before = calls();
    std::vector<std::string> all = arguments;
    all.insert(all.end(), options.begin(), options.end());
    EXPECT_EQ(batch(all).exit_code, 0);
    EXPECT_EQ(calls() - before, more);
  };
  expect_calls(2);
  const std::string page = contents(out + "/index.html");
  expect_calls(0);
  EXPECT_EQ(contents(out + "/index.html"), page);
  mesh("triangle.obj", triangle + "# another\n");
  expect_calls(1);
  write(out + "/fixed/crossing.obj", "damaged");
  expect_calls(1);
  fs::remove(out + "/fixed/crossing.obj");
  expect_calls(1);
  expect_calls(2, {"--", "--precision", "float64"});
  expect_calls(0, {"--", "--precision", "float64"});
  expect_calls(2, {"--thumbnails"});
  worker("# another program");
  expect_calls(2);
}

TEST_F(BatchCli, a_mesh_that_kills_its_worker_is_recorded_and_not_tried_for_ever) {
  mesh("deadly.obj", triangle);
  mesh("crossing.obj", crossing);
  std::vector<std::string> arguments = worker("case $2 in *deadly*) kill -SEGV $$;; esac");
  EXPECT_EQ(batch(arguments).exit_code, 1);
  EXPECT_EQ(results().at("deadly.obj")["status"], "killed");
  EXPECT_EQ(results().at("crossing.obj")["status"], "embedded");
  EXPECT_EQ(calls(), 4u);
  EXPECT_EQ(batch(arguments).exit_code, 1);
  EXPECT_EQ(calls(), 4u);
  arguments.insert(arguments.end(), {"--retry", "--attempts", "1"});
  EXPECT_EQ(batch(arguments).exit_code, 1);
  EXPECT_EQ(calls(), 5u);
}

TEST_F(BatchCli, a_worker_killed_once_is_started_again) {
  mesh("crossing.obj", crossing);
  const auto arguments = worker(fmt::format("mkdir '{}' && kill -KILL $$", folder / "was_here"));
  EXPECT_EQ(batch(arguments).exit_code, 0);
  EXPECT_EQ(calls(), 2u);
  EXPECT_EQ(results().at("crossing.obj")["status"], "embedded");
}

TEST_F(BatchCli, a_mesh_that_ends_the_batch_waits_for_all_others_and_is_given_up) {
  for (const char* name : {"a.obj", "b.obj", "c.obj"}) mesh(name, crossing);
  mesh("deadly.obj", crossing + "# long\n");  // the largest comes first
  auto arguments = worker("case $2 in *deadly*) kill -KILL $PPID; sleep 1;; esac");
  arguments.insert(arguments.end(), {"--attempts", "2"});
  jobs = "1";
  EXPECT_EQ(batch(arguments).exit_code, -SIGKILL);
  EXPECT_EQ(batch(arguments).exit_code, -SIGKILL);
  for (const char* name : {"a.obj", "b.obj", "c.obj"}) EXPECT_TRUE(fs::exists(out + "/fixed/" + name));
  EXPECT_EQ(batch(arguments).exit_code, 1);
  EXPECT_EQ(calls(), 5u);
  EXPECT_EQ(results().at("deadly.obj")["status"], "ended_the_batch");
  worker("# harmless now");
  EXPECT_EQ(batch(arguments).exit_code, 0);
}

TEST_F(BatchCli, an_interruption_keeps_what_is_done) {
  for (int i = 0; i < 6; ++i) mesh(fmt::format("{}.obj", i), crossing);
  const auto slow = worker("sleep 0.2");
  RunOptions interrupted;
  interrupted.signal_after_us = 300'000;
  interrupted.signal = SIGTERM;
  EXPECT_EQ(batch(slow, interrupted).exit_code, 6);
  EXPECT_FALSE(fs::exists(out + "/results.csv"));
  const std::size_t before = calls();
  EXPECT_LT(before, 6u);
  EXPECT_EQ(batch(slow).exit_code, 0);
  EXPECT_EQ(results().size(), 6u);
}

TEST_F(BatchCli, lists_name_meshes_and_their_results) {
  mesh("crossing.obj", crossing);
  mesh("other/crossing.obj", triangle);
  in = folder / "list.txt";
  write(in, fmt::format("{0}/in/crossing.obj\tfirst/one.obj\r\n\n{0}/in/other/crossing.obj\n", folder.string()));
  EXPECT_EQ(batch().exit_code, 0);
  EXPECT_TRUE(fs::exists(out + "/fixed/first/one.obj"));
  EXPECT_EQ(contents(out + "/fixed" + folder.string() + "/in/other/crossing.obj"), triangle);
  write(in, "");
  const Outcome empty = batch();
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_TRUE(contains(empty.err, "no mesh")) << empty.err;
  write(in, "missing.obj\n");
  EXPECT_EQ(batch().exit_code, 1);
  EXPECT_EQ(results().at("missing.obj")["status"], "invalid_input");
  in = "-";
  RunOptions from_stream;
  from_stream.input = folder / "in/crossing.obj" + std::string("\ta.obj\n");
  EXPECT_EQ(batch({}, from_stream).exit_code, 0);
  EXPECT_TRUE(fs::exists(out + "/fixed/a.obj"));
}

TEST_F(BatchCli, a_bad_line_of_a_list_is_a_row) {
  mesh("good.obj", crossing);
  in = folder / "list.txt";
  const std::string good = folder / "in/good.obj";
  write(in, good + "\tb.obj\n" + good + "\t../x.obj\nnotes.txt\n\tc.obj\nother.obj\tb.obj\nd.obj\tb.obj/d.obj\n");
  const Outcome outcome = batch();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "note: ../x.obj: ")) << outcome.err;
  const std::string table = contents(out + "/results.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7);
  for (const char* const words : {"list.txt:2: '../x.obj' cannot be the name of a result",
                                  "list.txt:3: 'notes.txt' has no extension of a supported format",
                                  "list.txt:4: there is no path of a mesh before the tab",
                                  "other.obj would both be written to b.obj", "and to a folder of that name"})
    EXPECT_TRUE(contains(table, words)) << words << '\n' << table;
  EXPECT_TRUE(fs::exists(out + "/fixed/b.obj"));
  EXPECT_EQ(results().at("../x.obj")["status"], "invalid_input");
}

TEST_F(BatchCli, folders_that_cannot_be_read_are_named) {
  mesh("good.obj", crossing);
  mesh("locked/bad.obj", crossing);
  fs::permissions(in + "/locked", fs::perms::none);
  const Outcome outcome = batch({}, {.in_child = respect_permissions});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "note: locked/: cannot list the folder: Permission denied")) << outcome.err;
  EXPECT_EQ(results().at("locked/")["status"], "invalid_input");
  EXPECT_EQ(results().at("good.obj")["status"], "embedded");
  fs::permissions(in + "/locked", fs::perms::owner_all);
  fs::permissions(in, fs::perms::none);
  const Outcome all = batch({}, {.in_child = respect_permissions});
  fs::permissions(in, fs::perms::owner_all);
  EXPECT_EQ(all.exit_code, 3) << all.err;
  EXPECT_TRUE(contains(all.err, "cannot list the folder: Permission denied")) << all.err;
}

TEST_F(BatchCli, files_of_other_formats_are_counted) {
  mesh("good.obj", triangle);
  mesh("a/model.fbx", "Kaydara");
  mesh("b/model.fbx", "Kaydara");
  mesh("readme", "text");
  const Outcome outcome = batch();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err,
                       "formats are not supported: 2 *.fbx (such as a/model.fbx), 1 without an extension (readme)"))
      << outcome.err;
}

TEST_F(BatchCli, an_error_of_the_system_is_tried_again) {
  if (!calls_can_fail) GTEST_SKIP() << "calls cannot be made to fail here";
  mesh("bad.obj", crossing);
  mesh("good.obj", crossing);
  for (const auto& [call, error_number] :
       {std::pair("open", EMFILE), std::pair("open", ENFILE), std::pair("read", EIO)}) {
    const Outcome failed = batch({}, {.in_child = with_failing(call, "bad.obj", error_number)});
    EXPECT_EQ(failed.exit_code, 1) << failed.err;
    EXPECT_EQ(results().at("bad.obj")["status"], "system_error") << failed.err;
    EXPECT_EQ(results().at("bad.obj")["exit_code"], 9);
    EXPECT_EQ(results().at("good.obj")["status"], "embedded");
    EXPECT_TRUE(contains(results().at("bad.obj")["message"], ::strerror(error_number)));
  }
  const Outcome again = batch();
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(contains(again.err, "1 done before")) << again.err;
}

TEST_F(BatchCli, an_error_of_the_system_in_the_worker_is_tried_again) {
  if (!calls_can_fail) GTEST_SKIP() << "calls cannot be made to fail here";
  mesh("bad.obj", crossing);
  auto arguments = worker("test -e ran || export LD_PRELOAD=" UNSNARL_FAILING_READS
                          " UNSNARL_FAIL_CALL=read UNSNARL_FAIL_FILE=bad.obj UNSNARL_FAIL_ERRNO=5; touch ran");
  const RunOptions in_folder = {.in_child = [this] { fs::current_path(folder.string()); }};
  EXPECT_EQ(batch(arguments, in_folder).exit_code, 1);
  EXPECT_EQ(results().at("bad.obj")["status"], "system_error");
  EXPECT_EQ(batch(arguments, in_folder).exit_code, 0);
  EXPECT_EQ(calls(), 2u);
}

TEST_F(BatchCli, a_worker_that_is_no_program_is_named) {
  mesh("triangle.obj", triangle);
  write(folder / "worker", "no program");
  const Outcome outcome = batch({"--worker", folder / "worker"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "cannot be started; --worker needs a program")) << outcome.err;
}

TEST_F(BatchCli, cells_of_tables_are_no_formulas) {
  const std::vector<std::string> names = {"=1+1.obj", "+1.obj",  "-1.obj", "@SUM(1).obj",
                                          "\t1.obj",  "\r1.obj", "'1.obj"};
  for (const std::string& name : names) mesh(name, triangle);
  EXPECT_EQ(batch().exit_code, 0);
  for (const char* const table : {"/results.csv", "/timing.csv"}) {
    const std::string text = contents(out + table);
    for (const std::string& name : names)
      EXPECT_TRUE(contains(text, "\n'" + name) || contains(text, "\n\"'" + name)) << name << '\n' << text;
  }
  EXPECT_EQ(results().count("=1+1.obj"), 1u);
}

TEST_F(BatchCli, parts_are_disjoint_and_complete_and_the_tasks_of_slurm) {
  for (int i = 0; i < 5; ++i) mesh(fmt::format("{}.obj", i), crossing);
  const auto slow = worker("");
  const auto part = [&](const char* shard) {
    std::vector<std::string> arguments = slow;
    arguments.insert(arguments.end(), {"--shard", shard});
    return batch(arguments).exit_code;
  };
  EXPECT_EQ(part("1/3"), 0);
  EXPECT_EQ(calls(), 2u);
  EXPECT_FALSE(fs::exists(out + "/results.csv"));
  auto summary = slow;
  summary.push_back("--summary");
  EXPECT_EQ(batch(summary).exit_code, 1);
  EXPECT_EQ(results().at("0.obj")["status"], "pending");
  EXPECT_EQ(part("0/3"), 0);
  EXPECT_EQ(calls(), 4u);
  RunOptions task;
  task.in_child = [] {
    ::setenv("SLURM_ARRAY_TASK_ID", "6", 1);
    ::setenv("SLURM_ARRAY_TASK_MIN", "2", 1);
    ::setenv("SLURM_ARRAY_TASK_STEP", "2", 1);
    ::setenv("SLURM_ARRAY_TASK_COUNT", "3", 1);
  };
  EXPECT_EQ(batch(slow, task).exit_code, 0);
  EXPECT_EQ(calls(), 5u);
  EXPECT_EQ(batch(summary).exit_code, 0);
  for (const char* wrong : {"3/3", "x", "1", "-1/3", "1/0"}) EXPECT_EQ(part(wrong), 2) << wrong;
  task.in_child = [] {
    ::setenv("SLURM_ARRAY_TASK_ID", "9", 1);
    ::setenv("SLURM_ARRAY_TASK_COUNT", "2", 1);
  };
  EXPECT_EQ(batch(slow, task).exit_code, 2);
}

TEST_F(BatchCli, buffers_of_gltf_come_along_and_count) {
  const auto gltf = [](const std::string& buffer) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
           R"({"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
           R"("min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,)"
           R"("uri":")" +
           buffer + "\"}]}";
  };
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bytes(reinterpret_cast<const char*>(positions), sizeof(positions));
  mesh("one.gltf", gltf("the%20one.bin"));
  mesh("two.gltf", gltf("the%20one.bin"));
  const auto arguments = worker("");
  EXPECT_EQ(batch(arguments).exit_code, 1);
  mesh("the one.bin", bytes);
  EXPECT_EQ(batch(arguments).exit_code, 0);
  EXPECT_EQ(calls(), 4u);
  EXPECT_EQ(contents(out + "/fixed/two.gltf/the one.bin"), bytes);
  EXPECT_TRUE(fs::exists(out + "/fixed/two.gltf/two.gltf"));
  EXPECT_EQ(batch(arguments).exit_code, 0);
  EXPECT_EQ(calls(), 4u);
  // Names of buffers may hold any byte.
  mesh("three.gltf", gltf("%e9%2525.bin"));
  mesh("\xe9%25.bin", bytes);
  EXPECT_EQ(batch(arguments).exit_code, 0);
  EXPECT_EQ(contents(out + "/fixed/three.gltf/\xe9%25.bin"), bytes);
  EXPECT_EQ(calls(), 5u);
  EXPECT_EQ(batch(arguments).exit_code, 0);
  EXPECT_EQ(calls(), 5u);
}

TEST_F(BatchCli, external_files_of_gifti_come_along_and_count) {
  const auto array = [](const std::string& intent, const std::string& type, int rows) {
    return "<DataArray Intent=\"NIFTI_INTENT_" + intent + "\" DataType=\"NIFTI_TYPE_" + type +
           "\" Dimensionality=\"2\" Dim0=\"" + std::to_string(rows) +
           "\" Dim1=\"3\" Encoding=\"ExternalFileBinary\" Endian=\"LittleEndian\" ExternalFileName=\"" + intent +
           ".dat\"/>";
  };
  mesh("a.surf.gii", "<GIFTI>" + array("POINTSET", "FLOAT32", 3) + array("TRIANGLE", "INT32", 1) + "</GIFTI>");
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::int32_t corners[] = {0, 1, 2};
  const std::string points(reinterpret_cast<const char*>(positions), sizeof(positions));
  const auto arguments = worker("");
  EXPECT_EQ(batch(arguments).exit_code, 1);
  mesh("POINTSET.dat", points);
  mesh("TRIANGLE.dat", std::string(reinterpret_cast<const char*>(corners), sizeof(corners)));
  EXPECT_EQ(batch(arguments).exit_code, 0);
  EXPECT_EQ(calls(), 2u);
  EXPECT_EQ(contents(out + "/fixed/a.surf.gii.data"), points);
  EXPECT_TRUE(fs::exists(out + "/fixed/a.surf.gii.2.data"));
  EXPECT_EQ(batch(arguments).exit_code, 0);
  EXPECT_EQ(calls(), 2u);
  mesh("POINTSET.dat", std::string(points).replace(3, 1, 1, '\x40'));
  EXPECT_EQ(batch(arguments).exit_code, 0);
  EXPECT_EQ(calls(), 3u);
  fs::remove(out + "/fixed/a.surf.gii.data");
  EXPECT_EQ(batch(arguments).exit_code, 0);
  EXPECT_EQ(calls(), 4u);
}

TEST_F(BatchCli, names_need_not_be_utf8) {
  mesh("\xe9\"<script>.obj", crossing);
  EXPECT_EQ(batch().exit_code, 0);
  EXPECT_TRUE(fs::exists(out + "/fixed/\xe9\"<script>.obj"));
  EXPECT_EQ(contents(out + "/index.html").find("<script>.obj"), std::string::npos);
  EXPECT_EQ(results().count("\\xe9\"<script>.obj"), 1u);
  const Outcome again = batch();
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_TRUE(contains(again.err, "1 done before")) << again.err;
  write(out + "/fixed/\xe9\"<script>.obj", "changed");
  EXPECT_FALSE(contains(batch().err, "done before"));
  EXPECT_TRUE(contains(contents(out + "/fixed/\xe9\"<script>.obj"), "v 0 0 0"));
}

TEST_F(BatchCli, refuses_what_makes_no_sense) {
  mesh("crossing.obj", crossing);
  const auto expect_refusal = [&](const std::vector<std::string>& more, int exit_code, const std::string& words) {
    const Outcome outcome = batch(more);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(out + "/fixed"));
  };
  expect_refusal({"--", "--frobnicate"}, 2, "frobnicate");
  expect_refusal({"--", "--report", "x.json"}, 2, "--report after '--'");
  expect_refusal({"--", "-o", "x.obj"}, 2, "results go to the folder");
  expect_refusal({"--", "--time-limit", "3"}, 2, "before '--'");
  expect_refusal({"--worker", folder / "none"}, 3, "--worker");
  in = folder / "in/crossing.obj";
  expect_refusal({}, 2, "use 'unsnarl fix'");
  in = folder / "none";
  expect_refusal({}, 3, "cannot open");
  in = folder / "in";
}

TEST_F(BatchCli, replaces_and_deletes_nothing_that_no_batch_has_written) {
  mesh("crossing.obj", crossing);
  for (const char* const name : {"fixed", "reports", "thumbnails", "work"}) {
    const std::string thesis = out + "/" + name + "/0-of-1/thesis.txt";
    fs::create_directories(fs::path(thesis).parent_path());
    write(thesis, "precious");
    fs::create_directories(out + "/journal");  // somebody's own
    const Outcome outcome = batch();
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_NE(outcome.err.find("was not written by 'unsnarl batch'"), std::string::npos) << outcome.err;
    EXPECT_EQ(contents(thesis), "precious");
    fs::remove_all(out);
  }
  fs::create_directories(out);
  write(out + "/index.html", "my page");
  EXPECT_EQ(batch().exit_code, 2);
  EXPECT_EQ(contents(out + "/index.html"), "my page");
}

TEST_F(BatchCli, results_may_go_to_the_folder_of_the_meshes) {
  mesh("crossing.obj", crossing);
  out = in;
  for (int k = 0; k < 2; ++k) {
    const Outcome outcome = batch();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(results().size(), 1u);
  }
}

TEST_F(BatchCli, results_are_no_meshes_of_the_same_batch) {
  mesh("crossing.obj", crossing);
  EXPECT_EQ(batch().exit_code, 0);
  in = out + "/fixed";
  const Outcome outcome = batch();
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("a result of a batch"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace unsnarl::cli
