// Runs one target over kept files and deeply nested texts, without a fuzzer: replay TARGET FILE_OR_FOLDER...
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/nested_shapes.h"
#include "fuzz/targets.h"

namespace fs = std::filesystem;

int main(int argc, char** argv) {
  const auto target = std::find_if(unsnarl::fuzz::targets.begin(), unsnarl::fuzz::targets.end(),
                                   [&](const auto& t) { return argc > 1 && t.name == argv[1]; });
  if (target == unsnarl::fuzz::targets.end()) {
    std::fprintf(stderr, "usage: replay TARGET FILE_OR_FOLDER...\n");
    return 2;
  }
  std::vector<fs::path> files;
  for (int i = 2; i < argc; ++i) {
    if (!fs::is_directory(argv[i]))
      files.emplace_back(argv[i]);
    else
      for (const auto& entry : fs::directory_iterator(argv[i])) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& path : files) {
    std::fprintf(stderr, "%s\n", path.c_str());  // the last one named is the one that fails
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    target->run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  }
  for (const std::string& text : unsnarl::fuzz::nested_shapes()) {
    std::fprintf(stderr, "nested: %s ...\n", text.substr(0, 60).c_str());
    target->run({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  std::printf("%zu files\n", files.size());
  return files.empty() ? 1 : 0;
}
