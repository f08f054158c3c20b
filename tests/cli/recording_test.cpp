// `fix --record` and the animations of `fix --picture`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace unsnarl::cli {
namespace {

class Recordings : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run({"sample", "crossing_tubes", "-o", in, "--resolution", "16"}).exit_code, 0);
    ASSERT_EQ(run({"fix", in, "-o", folder / "plain.obj", "-q"}).exit_code, 0);
  }
  Folder folder;
  std::string in = folder / "in.obj";
};

TEST_F(Recordings, are_json_and_change_no_byte_of_the_result) {
  const std::string recording = folder / "recording.json", report = folder / "report.json";
  ASSERT_EQ(run({"fix", in, "-o", folder / "out.obj", "--record", recording, "--report", report, "-q"}).exit_code, 0);
  EXPECT_EQ(contents(folder / "out.obj"), contents(folder / "plain.obj"));
  const auto json = nlohmann::json::parse(contents(recording));
  EXPECT_EQ(json["schema"], "unsnarl-recording");
  EXPECT_EQ(json["frames"].front()["phase"], "input");
  EXPECT_EQ(json["frames"].back()["phase"], "result");
  EXPECT_EQ(json["frames"].back()["pairs"], 0);
  EXPECT_FALSE(json["history"].empty());
  EXPECT_EQ(nlohmann::json::parse(contents(report))["history"], json["history"]);
}

TEST_F(Recordings, become_a_gif) {
  const std::string gif = folder / "out.gif";
  ASSERT_EQ(run({"fix", in, "-o", folder / "out.obj", "--picture", gif, "-q"}).exit_code, 0);
  EXPECT_EQ(contents(folder / "out.obj"), contents(folder / "plain.obj"));
  EXPECT_TRUE(contents(gif).starts_with("GIF89a"));
  EXPECT_TRUE(contents(gif).ends_with('\x3b'));
}

TEST_F(Recordings, become_a_folder_of_png) {
  ASSERT_EQ(run({"fix", in, "-o", folder / "out.obj", "--picture", folder / "frames/", "-q"}).exit_code, 0);
  std::size_t pictures = 0;
  for (const std::string& name : folder.names()) {
    if (!name.starts_with("frames/")) continue;
    EXPECT_TRUE(name.ends_with(".png"));
    EXPECT_TRUE(contents(folder / name).starts_with("\x89PNG"));
    ++pictures;
  }
  EXPECT_GE(pictures, 3u);
  EXPECT_TRUE(fs::exists(folder / "frames/0000.png"));
}

TEST_F(Recordings, do_not_mix_with_other_files) {
  fs::create_directory(folder / "frames");
  write(folder / "frames/mine.txt", "");
  for (const std::string& path : {folder / "frames", folder / "frames/"}) {
    const Outcome outcome = run({"fix", in, "-o", folder / "out.obj", "--picture", path});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("not empty"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder / "out.obj"));
  }
  const Outcome into_file = run({"fix", in, "-o", folder / "out.obj", "--picture", in + "/"});
  EXPECT_EQ(into_file.exit_code, 4) << into_file.err;
  EXPECT_FALSE(fs::exists(folder / "out.obj"));
  const Outcome same = run({"fix", in, "-o", folder / "out.obj", "--record", folder / "out.obj"});
  EXPECT_EQ(same.exit_code, 2) << same.err;
}

}  // namespace
}  // namespace unsnarl::cli
