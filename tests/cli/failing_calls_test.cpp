#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <cstdlib>

#include "cli/program_test.h"
#include "cli/two_tetrahedra.h"

/// Whatever call of the system fails, all files that one call of the program writes are new, or all are as they were.
namespace unsnarl::cli {
namespace {

using two_tetrahedra::buffer;

std::string gltf(const std::string& uri) {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":24,"type":"VEC3","min":[0,0,0],"max":[4,4,4]}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":288}}],"buffers":[{{"byteLength":288,"uri":"{}"}}]}})",
      uri);
}

class FailingCalls : public ProgramTest {
 protected:
  using Files = std::map<std::string, std::string>;

  Files files_in(const std::string& name) const {
    Files files;
    for (const auto& entry : fs::recursive_directory_iterator(folder / name))
      if (entry.is_regular_file())
        files[entry.path().lexically_relative(folder / name).string()] = contents(entry.path());
    return files;
  }
  void put(const std::string& name, const Files& files) const {
    fs::remove_all(folder / name);
    fs::create_directory(folder / name);
    for (const auto& [path, bytes] : files) {
      fs::create_directories(fs::path(folder / name) / fs::path(path).parent_path());
      write(fs::path(folder / name) / path, bytes);
    }
  }
  static Outcome run_with(const std::vector<std::string>& arguments,
                          const std::map<std::string, std::string>& variables) {
    return run(arguments, {.in_child = [&variables] {
                 ::setenv("LD_PRELOAD", UNSNARL_FAIL_CALLS, 1);
                 for (const auto& [name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
               }});
  }
  static Files without_temporary(const Files& files) {
    Files some;
    for (const auto& [name, bytes] : files)
      if (!name.starts_with(".unsnarl-")) some[name] = bytes;
    return some;
  }

  /// Runs a call that writes to the folder `name`, again and again from `old`, with each of its calls of the system
  /// below that folder failing in turn, alone or with all later ones.
  void expect_all_or_none(const std::vector<std::string>& arguments, const std::string& name, const Files& old) {
    put(name, old);
    ASSERT_EQ(run(arguments).exit_code, 0);
    const Files done = files_in(name);
    ASSERT_NE(done, old);
    for (const std::string kind : {"rename", "link", "fsync", "write", "mkdir", "open", "close", "unlink"}) {
      const std::string count = folder / "count";
      const std::map<std::string, std::string> variables = {
          {"FAIL_WHAT", kind}, {"FAIL_BELOW", folder / name}, {"FAIL_COUNT", count}};
      put(name, old);
      fs::remove(count);
      run_with(arguments, variables);
      const std::size_t calls = fs::exists(count) ? fs::file_size(count) : 0;
      EXPECT_TRUE(calls > 0 || kind == "unlink" || kind == "mkdir") << kind << " is never called";
      for (const std::string mode : {"once", "after"})
        for (std::size_t at = 1; at <= calls; ++at) {
          put(name, old);
          auto failing = variables;
          failing["FAIL_AT"] = std::to_string(at);
          failing["FAIL_MODE"] = mode;
          failing.erase("FAIL_COUNT");
          const Outcome outcome = run_with(arguments, failing);
          const Files now = without_temporary(files_in(name));
          const std::string what =
              fmt::format("{} {} {}: exit code {}, {}", kind, at, mode, outcome.exit_code, outcome.err);
          EXPECT_TRUE(now == old || now == done) << what;
          EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3 || outcome.exit_code == 4 ||
                      outcome.exit_code == 9)
              << what;
          EXPECT_EQ(outcome.exit_code == 0, now == done) << what;
        }
    }
  }
};

std::string tetrahedra(double shift) {
  return fmt::format(
      "v {0} 0 0\nv {1} 0 0\nv {0} 4 0\nv {0} 0 4\nv {2} 1.2 1.1\nv {3} 2.5 2\nv {4} 2.6 2.2\nv {5} 2.4 2.7\n"
      "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n",
      shift, shift + 4, shift + 1.2, shift + 2.6, shift + 2.5, shift + 2.4);
}

TEST_F(FailingCalls, leave_all_files_of_a_scene_new_or_all_old) {
  for (int i = 0; i < 3; ++i) file(fmt::format("s{}.obj", i), tetrahedra(9 * i));
  // The third file is new.
  expect_all_or_none({"fix", folder / "s0.obj", folder / "s1.obj", folder / "s2.obj", "-o", folder / "out"}, "out",
                     {{"s0.obj", "old 0"}, {"s1.obj", "old 1"}});
}

TEST_F(FailingCalls, leave_both_files_of_a_gltf_in_place_new_or_old) {
  expect_all_or_none({"fix", folder / "in/g.gltf", "--in-place"}, "in",
                     {{"g.gltf", gltf("data/a.bin")}, {"data/a.bin", buffer()}});
}

TEST_F(FailingCalls, a_mesh_whose_report_or_picture_fails_is_not_replaced) {
  const std::string in = file("in.obj", crossing), out = file("out.obj", "precious");
  for (const auto& [option, name] :
       {std::pair("--report", "r.json"), {"--picture", "p.png"}, {"--highlight", "h.ply"}, {"--record", "c.json"}}) {
    fs::create_directory(folder / "said");
    const Outcome outcome =
        run_with({"fix", in, "-o", out, option, folder / (std::string("said/") + name)},
                 {{"FAIL_WHAT", "write"}, {"FAIL_BELOW", folder / "said"}, {"FAIL_AT", "1"}, {"FAIL_MODE", "after"}});
    EXPECT_EQ(outcome.exit_code, 9) << option << outcome.err;
    EXPECT_EQ(contents(out), "precious") << option;
    EXPECT_TRUE(fs::is_empty(folder / "said")) << option;
    fs::remove_all(folder / "said");
  }
}

TEST_F(FailingCalls, a_surface_whose_report_fails_is_not_replaced) {
  const std::string knot = file("k.xyz", "0 0 0\n1 0 0\n0 1 0\n"), out = file("out.obj", "precious");
  const std::string curves = file("c.json", R"({"curves": [{"closed": true, "points": [[0, 0], [9, 0], [0, 9]]}]})"),
                    drawn = file("drawn.json", "precious");
  fs::create_directory(folder / "said");
  const std::map<std::string, std::string> variables = {
      {"FAIL_WHAT", "write"}, {"FAIL_BELOW", folder / "said"}, {"FAIL_AT", "1"}};
  EXPECT_EQ(run_with({"seifert", knot, "-o", out, "--no-fair", "--report", folder / "said/r"}, variables).exit_code, 9);
  EXPECT_EQ(contents(out), "precious");
  EXPECT_EQ(run_with({"curves", curves, "-o", drawn, "--report", folder / "said/r"}, variables).exit_code, 9);
  EXPECT_EQ(contents(drawn), "precious");
}

TEST_F(FailingCalls, what_a_kill_between_two_moves_leaves_is_said) {
  // docs/promises.md: the files that are not new are old, and the old files are in the hidden folder.
  for (int i = 0; i < 3; ++i) file(fmt::format("s{}.obj", i), tetrahedra(9 * i));
  put("out", {{"s0.obj", "old 0"}, {"s1.obj", "old 1"}, {"s2.obj", "old 2"}});
  const Outcome outcome =
      run_with({"fix", folder / "s0.obj", folder / "s1.obj", folder / "s2.obj", "-o", folder / "out"},
               {{"FAIL_WHAT", "rename"}, {"FAIL_BELOW", folder / "out"}, {"FAIL_AT", "2"}, {"FAIL_MODE", "kill"}});
  EXPECT_EQ(outcome.exit_code, 137);
  std::size_t kept = 0;
  for (const auto& [name, bytes] : files_in("out"))
    if (name.find("/old/") != std::string::npos) {
      EXPECT_TRUE(bytes.starts_with("old ")) << name;
      ++kept;
    }
  EXPECT_EQ(kept, 3u);
}

TEST_F(FailingCalls, a_mount_point_is_refused_before_the_work) {
  for (int i = 0; i < 3; ++i) file(fmt::format("s{}.obj", i), tetrahedra(9 * i));
  put("out", {{"s0.obj", "old 0"}, {"s1.obj", "old 1"}, {"s2.obj", "old 2"}});
  const std::string mounted = file("mounted", "mounted"), target = folder / "out/s1.obj";
  if (::mount(mounted.c_str(), target.c_str(), nullptr, MS_BIND, nullptr) != 0)
    GTEST_SKIP() << "mounting needs rights that this process does not have";
  const Outcome outcome = run({"fix", folder / "s0.obj", folder / "s1.obj", folder / "s2.obj", "-o", folder / "out"});
  ::umount(target.c_str());
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("s1.obj: is a mount point"), std::string::npos) << outcome.err;
  EXPECT_EQ(files_in("out"), (Files{{"s0.obj", "old 0"}, {"s1.obj", "old 1"}, {"s2.obj", "old 2"}}));
}

}  // namespace
}  // namespace unsnarl::cli
