#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/program_test.h"
#include "unsnarl/document.h"
#include "unsnarl/intersections.h"
#include "unsnarl/point_cache.h"

namespace unsnarl::cli {
namespace {

using Json = nlohmann::json;

constexpr int frame_count = 10, side = 7;

/// A sheet, and above it a tent that comes down through it and goes up again: the first frame and the last are fine.
std::vector<float> positions(int t) {
  std::vector<float> p;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) p.insert(p.end(), {0.5F * i, 0.5F * j, 0.02F * (i * j % 3)});
  const auto z = static_cast<float>(0.5 - 0.75 * std::sin(3.14159 * t / (frame_count - 1)));
  for (const auto& [x, y, up] :
       {std::array{1.4F, 1.6F, 0.0F}, {0.9F, 1.1F, 1.0F}, {2.1F, 1.2F, 1.0F}, {1.5F, 2.2F, 1.0F}})
    p.insert(p.end(), {x, y, z + up});
  return p;
}

std::vector<std::array<int, 3>> faces() {
  std::vector<std::array<int, 3>> f;
  for (int i = 0; i + 1 < side; ++i)
    for (int j = 0; j + 1 < side; ++j) {
      const int a = i * side + j, b = a + side;
      f.push_back({a, b, b + 1});
      f.push_back({a, b + 1, a + 1});
    }
  const int tip = side * side;
  for (int k = 0; k < 3; ++k) f.push_back({tip, tip + 1 + k, tip + 1 + (k + 1) % 3});
  return f;
}

std::string obj(int t) {
  const std::vector<float> p = positions(t);
  std::string text = fmt::format("# frame {}\n", t);
  for (std::size_t i = 0; i < p.size(); i += 3) text += fmt::format("v {} {} {}\n", p[i], p[i + 1], p[i + 2]);
  for (const auto& [a, b, c] : faces()) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

template <class T>
void append(std::string& bytes, T value, bool little) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (!little) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string cache(bool pc2) {
  std::string bytes;
  const auto points = static_cast<std::int32_t>(positions(0).size() / 3);
  if (pc2) {
    bytes.assign("POINTCACHE2\0", 12);
    append(bytes, std::int32_t{1}, true);
    append(bytes, points, true);
    append(bytes, 0.0F, true);
    append(bytes, 1.0F, true);
    append(bytes, std::int32_t{frame_count}, true);
  } else {
    append(bytes, std::int32_t{frame_count}, false);
    append(bytes, points, false);
    for (int t = 0; t < frame_count; ++t) append(bytes, t / 24.0F, false);
  }
  for (int t = 0; t < frame_count; ++t)
    for (const float x : positions(t)) append(bytes, x, pc2);
  return bytes;
}

class Sequence : public ProgramTest {
 protected:
  Sequence() {
    fs::create_directory(folder / "in");
    for (int t = 0; t < frame_count; ++t) write(path(t), obj(t));
  }
  std::string path(int t) const { return folder / fmt::format("in/f{}.obj", t + 5); }  // f5 ... f14
  std::string result(int t) const { return out + fmt::format("/f{}.obj", t + 5); }
  Outcome repair(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"fix", "--sequence", pattern, "-o", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  std::vector<std::string> results() const {
    std::vector<std::string> all;
    for (int t = 0; t < frame_count; ++t) all.push_back(contents(result(t)));
    return all;
  }
  const std::string pattern = folder / "in/f*.obj", out = folder / "out";
};

TEST_F(Sequence, every_frame_is_embedded_and_corrections_go_on_smoothly) {
  const Outcome outcome = repair({"--report", folder / "r.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("10 of 10 frames written"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("10 frames of 53 vertices"), std::string::npos) << outcome.err;
  const Outcome one = run({"fix", "--sequence", pattern, "-o", folder / "one", "--frames", "0:1"});
  EXPECT_NE(one.err.find("1 frame of 53 vertices"), std::string::npos) << one.err;
  const Json report = Json::parse(contents(folder / "r.json"));
  ASSERT_EQ(report["list"].size(), std::size_t{frame_count});
  std::size_t crossing = 0;
  for (int t = 0; t < frame_count; ++t) {
    const Json& frame = report["list"][t];
    EXPECT_EQ(frame["name"], fmt::format("f{}.obj", t + 5));
    EXPECT_EQ(frame["status"], "embedded");
    EXPECT_EQ(pairs_in(result(t)), 0u);
    EXPECT_EQ(frame["before"]["total"], pairs_in(path(t)));
    if (pairs_in(path(t)) == 0)
      EXPECT_EQ(contents(result(t)), obj(t));  // clean: byte for byte
    else
      ++crossing;
  }
  EXPECT_GE(crossing, 4u);
  EXPECT_LT(crossing, std::size_t{frame_count});
  EXPECT_GT(report["smoothed"], 0);
  EXPECT_LT(report["jitter"]["mean_rel"], report["jitter_alone"]["mean_rel"]);
  EXPECT_TRUE(report["list"][0]["jitter"].is_null());
}

TEST_F(Sequence, what_is_done_is_not_done_again_and_ranges_make_the_whole) {
  ASSERT_EQ(repair().exit_code, 0);
  const std::vector<std::string> whole = results();
  const Outcome again = repair();
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find("10 were done before"), std::string::npos) << again.err;
  EXPECT_EQ(results(), whole);

  write(result(3), whole[3] + "# touched\n");  // is not what was certified
  const Outcome mended = repair();
  EXPECT_NE(mended.err.find("9 were done before"), std::string::npos) << mended.err;
  EXPECT_EQ(results(), whole);

  write(path(9), "# new\n" + obj(9));  // has an influence on the last five
  const Outcome changed = repair();
  EXPECT_NE(changed.err.find("5 were done before"), std::string::npos) << changed.err;
  write(path(9), obj(9));
  EXPECT_EQ(repair({"--min-gap", "0.001"}).err.find("done before"), std::string::npos);

  fs::remove_all(out);
  EXPECT_EQ(repair({"--frames", "6:"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(result(5)));
  EXPECT_EQ(repair({"--frames", ":6"}).exit_code, 0);
  EXPECT_EQ(results(), whole);
}

TEST_F(Sequence, an_interrupted_call_goes_on_from_where_it_was) {
  ASSERT_EQ(repair().exit_code, 0);
  const std::vector<std::string> whole = results();
  fs::remove_all(out);
  RunOptions stop;
  stop.signal_after = {"\"fraction\":0.2"};
  const Outcome stopped = run({"fix", "--sequence", pattern, "-o", out, "--progress", "json", "--threads", "1"}, stop);
  EXPECT_TRUE(stopped.exit_code == 6 || stopped.exit_code == 0) << stopped.err;
  // A line that was cut off on the way is no line.
  std::string record = contents(out + "/unsnarl-sequence.jsonl");
  ASSERT_FALSE(record.empty());
  write(out + "/unsnarl-sequence.jsonl", record.substr(0, record.size() - 20));
  const Outcome outcome = repair();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("done before"), std::string::npos) << outcome.err;
  EXPECT_EQ(results(), whole);
  EXPECT_NE(repair().err.find("10 were done before"), std::string::npos);
}

TEST_F(Sequence, point_caches_keep_all_but_positions) {
  ASSERT_EQ(repair().exit_code, 0);
  for (const bool pc2 : {true, false}) {
    const std::string name = pc2 ? "walk.pc2" : "walk.mdd", format = cache(pc2);
    write(folder / name, format);
    const std::vector<std::string> call = {"fix", "--sequence", path(0), folder / name, "-o", folder / "caches"};
    const Outcome outcome = run(call);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string bytes = contents(folder / ("caches/" + name));
    EXPECT_FALSE(fs::exists(folder / ("caches/" + name + ".part")));
    const PointCache before = PointCache::parse(format, *point_cache_format(name));
    const PointCache after = PointCache::parse(bytes, *point_cache_format(name));
    ASSERT_EQ(after.frames(), std::size_t{frame_count});
    const std::size_t header = bytes.size() - after.frames() * after.frame_bytes(0).size();
    EXPECT_EQ(bytes.substr(0, header), format.substr(0, header));
    EXPECT_EQ(after.frame_bytes(0), before.frame_bytes(0));  // clean
    Surface surface = Document::read(path(0)).surface();
    for (int t = 0; t < frame_count; ++t) {
      surface.positions = after.positions(t);
      EXPECT_TRUE(find_intersections(surface).empty()) << t;
    }
    EXPECT_NE(run(call).err.find("10 were done before"), std::string::npos);
    EXPECT_EQ(contents(folder / ("caches/" + name)), bytes);
  }
}

TEST_F(Sequence, a_point_cache_has_its_name_once_all_of_it_is_done_and_nothing_of_another_is_in_it) {
  const std::string in = folder / "walk.pc2", name = folder / "caches/walk.pc2", part = name + ".part";
  const auto repair_cache = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> call = {"fix", "--sequence", path(0), in, "-o", folder / "caches"};
    call.insert(call.end(), more.begin(), more.end());
    return run(call);
  };
  write(in, cache(true));
  ASSERT_EQ(repair_cache().exit_code, 0);
  const std::string whole = contents(name);
  fs::remove_all(folder / "caches");

  const Outcome half = repair_cache({"--frames", "0:5"});
  EXPECT_EQ(half.exit_code, 0);
  EXPECT_NE(half.err.find(".part until all 10 frames are done"), std::string::npos) << half.err;
  EXPECT_FALSE(fs::exists(name));
  ASSERT_EQ(repair_cache({"--frames", "5:"}).exit_code, 0);
  EXPECT_EQ(contents(name), whole);
  EXPECT_FALSE(fs::exists(part));

  // Another animation of as many points and frames: nothing of the old one gets into it.
  std::string other = cache(true);
  const std::size_t last_frame = other.size() - 4;
  other[last_frame + 1] = static_cast<char>(other[last_frame + 1] ^ 64);
  write(in, other);
  EXPECT_EQ(repair_cache({"--frames", "0:7"}).exit_code, 0);
  EXPECT_EQ(contents(name), whole);
  EXPECT_EQ(contents(part).substr(contents(part).size() - 4), other.substr(last_frame));
  ASSERT_EQ(repair_cache().exit_code, 0);
  EXPECT_EQ(contents(name).substr(last_frame), other.substr(last_frame));

  // Two calls at once take in what the other one has done.
  fs::remove_all(folder / "caches");
  write(in, cache(true));
  std::thread first([&] { EXPECT_EQ(repair_cache({"--frames", "0:5"}).exit_code, 0); });
  EXPECT_EQ(repair_cache({"--frames", "5:10"}).exit_code, 0);
  first.join();
  EXPECT_EQ(contents(name), whole);
  EXPECT_FALSE(fs::exists(part));
}

TEST_F(Sequence, the_number_that_changes_says_which_frame_it_is) {
  fs::create_directory(folder / "lod");
  for (const int t : {0, 1, 2}) write(folder / fmt::format("lod/f{}_lod0.obj", t), obj(0));
  const std::vector<std::string> call = {"fix", "--sequence", folder / "lod/*.obj", "-o", out};
  EXPECT_EQ(run(call).exit_code, 0);
  fs::remove_all(out);
  fs::rename(folder / "lod/f2_lod0.obj", folder / "lod/f7_lod0.obj");
  expect_refusal(call, 2, "is a frame missing");
  fs::rename(folder / "lod/f7_lod0.obj", folder / "lod/f01_lod0.obj");
  expect_refusal(call, 2, "have the same frame number");
}

TEST_F(Sequence, what_makes_no_sense_is_refused) {
  const std::vector<std::string> call = {"fix", "--sequence", pattern, "-o", out};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = call;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect_refusal(with({"--frames", "4:4"}), 2, "the sequence has 10 frames");
  expect_refusal(with({"--frames", "4"}), 2, "FIRST:LAST");
  expect_refusal(with({"--frames", "a:4"}), 2, "FIRST:LAST");
  expect_refusal(with({"--picture", folder / "p.png"}), 2, "--picture");
  expect_refusal(with({"--report", path(2)}), 2, "one of the frames");
  expect_refusal({"fix", "--sequence", pattern}, 2, "-o FOLDER");
  expect_refusal({"fix", path(0), "-o", folder / "o.obj", "--frames", "0:1"}, 2, "--sequence");
  expect_refusal({"fix", "--sequence", pattern, "-o", folder / "in"}, 2, "would be overwritten");
  expect_refusal({"fix", "--sequence", folder / "in/*.ply", "-o", out}, 3, "no such file");
  expect_refusal({"fix", "--sequence", path(0), "-o", out}, 2, "one frame is not a sequence");
  write(folder / "morph.glb", "glTF");
  expect_refusal({"fix", "--sequence", folder / "morph.glb", "-o", out}, 2, "morph targets");
  expect_refusal({"fix", "--sequence", folder / "none.pc2", "-o", out}, 2, "with its mesh");

  fs::rename(path(4), folder / "f9.obj");
  expect_refusal(call, 2, "from " + path(3) + " to " + path(5));
  write(path(4), obj(4) + "v 0 0 0\n");
  expect_refusal(call, 3, "f9.obj: 54 vertices and 75 faces, but f5.obj has 53");
  std::string turned = obj(4);
  turned.replace(turned.rfind("f "), 4, "f 51");
  write(path(4), turned);
  expect_refusal(call, 3, "f9.obj: face 74");
  fs::rename(folder / "f9.obj", path(4));
  write(folder / "cut.pc2", cache(true).substr(0, 999));
  expect_refusal({"fix", "--sequence", path(0), folder / "cut.pc2", "-o", out}, 3, "cut off");
  expect_refusal({"fix", "--sequence", path(0), folder / "none.pc2", "-o", out}, 3,
                 "none.pc2: cannot open: No such file or directory");
}

TEST_F(Sequence, no_point_of_a_cache_is_lost_or_invented) {
  const std::string bytes = cache(false);
  PointCache cache = PointCache::parse(bytes, PointCacheFormat::mdd);
  std::vector<double> moved = cache.positions(2);
  moved[4] += 0.125;
  cache.set_positions(2, moved);
  EXPECT_EQ(cache.positions(2), moved);
  EXPECT_EQ(cache.as_written(moved), moved);
  moved[4] -= 0.125;
  cache.set_positions(2, moved);
  EXPECT_EQ(cache.bytes(), bytes);
  moved[0] = 1e300;
  EXPECT_THROW(cache.set_positions(2, moved), WriteError);
  EXPECT_THROW(PointCache::parse(bytes.substr(0, 7), PointCacheFormat::mdd), FileError);
  EXPECT_THROW(PointCache::parse(bytes + "x", PointCacheFormat::mdd), FileError);
  EXPECT_THROW(PointCache::parse(bytes, PointCacheFormat::pc2), FileError);
}

TEST_F(Sequence, frames_that_are_taken_for_a_scene_are_named_at_once) {
  std::vector<std::string> arguments = {"fix"};
  for (int t = 0; t < 5; ++t) arguments.push_back(path(t));
  arguments.insert(arguments.end(), {"-o", out, "--time-limit", "0.001", "--threads", "1"});
  const Outcome outcome = run(arguments);
  const std::string command =
      fmt::format("unsnarl fix --sequence {} {} ... {} -o {}\n", path(0), path(1), path(4), out);
  EXPECT_TRUE(contains(outcome.err, "note: 5 of these files have the same faces.")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, command)) << outcome.err;
  // Other faces, or names without numbers, are no frames.
  const std::vector<std::string> parts = {file("part1.obj", crossing), file("part2.obj", clean_cube), path(0)};
  const std::vector<std::string> copies = {file("left.obj", crossing), file("right.obj", crossing),
                                           file("top.obj", crossing)};
  for (const std::vector<std::string>& scene : {parts, copies}) {
    const Outcome other = run({"fix", scene[0], scene[1], scene[2], "-o", folder / "scene", "--time-limit", "0.001"});
    EXPECT_FALSE(contains(other.err, "same faces")) << other.err;
  }
}

TEST_F(Sequence, progress_counts_frames) {
  const Outcome outcome = repair({"--progress", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.err);
  int done = -1;
  for (std::string line; std::getline(lines, line) && line.starts_with('{');) {
    const Json json = Json::parse(line);
    EXPECT_EQ(json["frames"]["total"], frame_count);
    EXPECT_GE(json["frames"]["done"], done);
    done = json["frames"]["done"];
  }
  EXPECT_EQ(done, frame_count);
}

TEST_F(Sequence, the_summary_names_the_worst_frame_and_those_that_are_not_smoothed) {
  const Outcome outcome = repair({"--report", folder / "r.json", "--no-recover"});  // so that none is smoothed
  const Json report = Json::parse(contents(folder / "r.json"));
  Json farthest = report["list"][0];
  std::string unsmoothed;
  for (const Json& frame : report["list"]) {
    if (frame["displacement_max_rel"] > farthest["displacement_max_rel"]) farthest = frame;
    if (frame["untouched_share"] < 1 && !frame["is_smoothed"])
      unsmoothed += (unsmoothed.empty() ? "" : ", ") + frame["name"].get<std::string>();
  }
  EXPECT_TRUE(contains(outcome.err, fmt::format("largest move: in {}, by ", farthest["name"].get<std::string>())))
      << outcome.err;
  EXPECT_FALSE(unsmoothed.empty());
  EXPECT_TRUE(contains(outcome.err, "not smoothed in time (repaired as single frames): " + unsmoothed + "\n"))
      << outcome.err;
}

}  // namespace
}  // namespace unsnarl::cli
