#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "cli/program.h"
#include "unsnarl/document.h"
#include "unsnarl/intersections.h"

namespace unsnarl::cli {

/// A cube of quads with unusual but legal writing, to see that every byte is kept.
inline const std::string clean_cube =
    "# a cube\r\nv 0 0 0\nv  1.000 0 0\nv 1 1 0 0.5\nv 0 1 0\nv 0 0 1e0\nv 1 0 1\nv 1 1 1\nv 0 1 +1\nvt 0 0\n"
    "f 4/1 3/1 2/1 1/1\nf 5 6 7 8\nusemtl x\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// A tetrahedron, and a small one whose tip sticks into it.
inline const std::string crossing =
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4 # top\nv 1.2 1.2 1.1\nv 2.6 2.5 2\nv 2.5 2.6 2.2\nv 2.4 2.4 2.7\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n";

/// All triangles of a vertex with two of five others: round it these would have to be joined without crossings, and the
/// complete graph on five vertices is not planar.
inline const std::string hopeless =
    "v 0 0 0\nv 1 0 0\nv 0 1 0.1\nv -1 0.2 0\nv 0.1 -1 0\nv 0.2 0.1 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6\nf 1 3 4\n"
    "f 1 3 5\nf 1 3 6\nf 1 4 5\nf 1 4 6\nf 1 5 6\n";

inline std::size_t pairs_in(const std::string& path) {
  return find_intersections(Document::read(path).surface()).size();
}

/// Tests of the program, with a folder for the files of each.
class ProgramTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) const {
    write(folder / name, bytes);
    return folder / name;
  }
  std::string sample(const std::string& name, const std::vector<std::string>& more = {}) const {
    const std::string path = folder / (name + ".obj");
    std::vector<std::string> arguments = {"sample", name, "-o", path};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return path;
  }
  /// Runs and expects an exit code, a complaint that contains `words`, and every file as it was.
  void expect_refusal(const std::vector<std::string>& arguments, int exit_code, const std::string& words) const {
    const auto before = files();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before);
  }
  const Folder folder;

 private:
  /// Bytes by name; folders have none.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const std::string& name : folder.names())
      all[name] = fs::is_regular_file(folder / name) ? contents(folder / name) : "";
    return all;
  }
};

}  // namespace unsnarl::cli
