#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace unsnarl::cli {

/// tools/verify.py on whatever a call of `fix` writes: the input is kept before the call, the output judged after it.
class Verification {
 public:
  /// Larger meshes would take seconds each.
  static constexpr std::size_t largest_input = 400'000;

  /// `folder`: for copies, of its own. `standard_input`: what the program gets there.
  Verification(const std::vector<std::string>& arguments, const std::string& folder, const std::string& standard_input)
      : arguments_(arguments), folder_(folder) {
    if (arguments.size() < 2 || arguments[0] != "fix") return;
    const std::string input = arguments[1] == "-" ? standard_input : bytes_of(arguments[1]);
    const std::string named = value_of("--format");
    format_ = !named.empty() ? named : lower(std::filesystem::path(arguments[1]).extension().string());
    if (input.empty() || input.size() > largest_input || format_.empty()) return;
    if (format_[0] == '.') format_.erase(0, 1);
    is_in_place_ = has("--in-place");
    if (is_in_place_ && (format_ == "gltf" || format_ == "gii")) return;  // what lay beside it is gone then
    output_ = is_in_place_ ? arguments[1] : value_of("-o");
    if (output_.empty() || output_.starts_with("/dev/")) return;
    old_output_ = bytes_of(output_);
    // The buffers of a glTF and the numbers of a GIFTI lie beside it, so it is copied only where it must be.
    input_ = arguments[1] == "-" || is_in_place_ ? copy("before", input) : arguments[1];
  }

  void judge(int exit_code, const std::string& standard_output) const {
    if (input_.empty()) return;
    const std::string written = output_ == "-" ? standard_output : bytes_of(output_);
    const bool is_new = !written.empty() && (exit_code == 0 || written != old_output_);
    if (!is_new || written.size() > 2 * largest_input) return;
    std::string command = std::string(UNSNARL_VERIFY) + " --quiet --format " + format_;
    if (exit_code != 0) command += " --no-worse";
    if (value_of("--precision") == "float32") command += " --float32";
    for (const auto& [option, passed] : {std::pair("--weld", "--weld"),
                                         {"--weld-tolerance", "--weld-tolerance"},
                                         {"--goal", "--goal"},
                                         {"--fix-vertices", "--fixed"}})
      if (const std::string value = value_of(option); !value.empty())
        command += std::string(" ") + passed + " '" + value + "'";
    command += " '" + input_ + "' '" + (output_ == "-" ? copy("after", written) : output_) + "'";
    const std::string said = folder_ + "/verify.txt";
    EXPECT_EQ(std::system((command + " >'" + said + "' 2>&1").c_str()), 0) << command << '\n' << bytes_of(said);
  }

 private:
  static std::string bytes_of(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return {};
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  }
  std::string copy(const std::string& name, const std::string& bytes) const {
    const std::string path = folder_ + "/" + name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  bool has(const std::string& option) const {
    return std::find(arguments_.begin(), arguments_.end(), option) != arguments_.end();
  }
  std::string value_of(const std::string& option) const {
    const auto found = std::find(arguments_.begin(), arguments_.end(), option);
    return found == arguments_.end() || found + 1 == arguments_.end() ? std::string() : *(found + 1);
  }

  std::vector<std::string> arguments_;
  std::string folder_, format_, input_, output_, old_output_;
  bool is_in_place_ = false;
};

}  // namespace unsnarl::cli
