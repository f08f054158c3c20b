#include "platform/process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <thread>

#include "io/folder.h"

namespace unsnarl::platform {
namespace {

// The children are this program: each runs one of these.
TEST(Child, DISABLED_says_its_words) {
  for (const std::string& word : testing::internal::GetArgvs()) std::fprintf(stderr, "[%s]", word.c_str());
}
TEST(Child, DISABLED_fails) {
  FAIL();
}
TEST(Child, DISABLED_sleeps) {
  std::this_thread::sleep_for(std::chrono::seconds(60));
}

std::vector<std::string> words_for(const std::string& test, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"--gtest_filter=Child.DISABLED_" + test, "--gtest_also_run_disabled_tests"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class Process : public testing::Test {
 protected:
  std::string said() const {
    std::ifstream stream(log(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::filesystem::path log() const { return folder_.path() / "said"; }

  const std::string self_ = program_path().string();
  TestFolder folder_;
};

TEST_F(Process, gets_its_words_and_ends_with_its_code) {
  const std::vector<std::string> words = {"a b", "", "\"quoted\"", "back\\slash\\", "a\\\"b", "%PATH%", "*.cpp"};
  ChildProcess child(self_, words_for("says_its_words", words), log());
  child.wait();
  const ProcessEnd end = child.end();
  EXPECT_TRUE(end.has_started);
  EXPECT_EQ(end.exit_code, 0);
  std::string wanted;
  for (const std::string& word : words) wanted += "[" + word + "]";
  EXPECT_TRUE(said().ends_with(wanted)) << said();
  ChildProcess failing(self_, words_for("fails"), log());
  failing.wait();
  EXPECT_EQ(failing.end().exit_code, 1);
}

TEST_F(Process, can_be_killed) {
  ChildProcess child(self_, words_for("sleeps"), log());
  child.kill();
  child.wait();
  const ProcessEnd end = child.end();
  EXPECT_LT(end.exit_code, 0);
  EXPECT_NE(reason_of_death(end.exit_code), "");
}

TEST_F(Process, that_is_no_program_does_not_start) {
  ChildProcess child((folder_.path() / "none").string(), {}, log());
  child.wait();
  EXPECT_FALSE(child.end().has_started);
}

TEST_F(Process, knows_its_program) {
  EXPECT_TRUE(std::filesystem::equivalent(program_file(), program_path()));
  EXPECT_NE(process_number(), 0);
}

}  // namespace
}  // namespace unsnarl::platform
