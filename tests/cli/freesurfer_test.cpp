#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>

#include "cli/program_test.h"
#include "unsnarl/document.h"

namespace unsnarl::cli {
namespace {

using FreeSurfer = ProgramTest;

/// As FreeSurfer stores a surface of triangles.
std::string freesurfer_surface(const Surface& surface, bool last_is_missing = false) {
  std::string bytes = "\xFF\xFF\xFEmade by a test\n\n";
  const auto append = [&](auto value) {
    std::array<char, 4> raw{};
    std::memcpy(raw.data(), &value, 4);
    bytes.append(raw.rbegin(), raw.rend());  // big-endian, on a little-endian machine
  };
  append(static_cast<std::int32_t>(surface.positions.size() / 3));
  append(static_cast<std::int32_t>(surface.corners.size() / 3));
  for (const double x : surface.positions) append(static_cast<float>(x));
  for (const std::int32_t v : surface.corners) append(v);
  if (last_is_missing) bytes.replace(bytes.size() - 4 * surface.corners.size() - 4, 4, "\x7F\xC0\0\0", 4);
  return bytes;
}

TEST_F(FreeSurfer, free_surfer_surfaces_need_no_extension) {
  Surface surface = Document::parse(crossing, Format::obj).surface();
  const std::string bytes = freesurfer_surface(surface);
  const std::string in = file("lh.pial_of_somebody", bytes), out = folder / "lh.pial.fixed";
  const Outcome outcome = run({"fix", in, "-o", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(pairs_in(out), 0u);
  EXPECT_EQ(contents(out).size(), bytes.size());
  EXPECT_EQ(run({"fix", "-", "--format", "freesurfer", "-o", "-", "--quiet"}, {.input = bytes}).out, contents(out));
  EXPECT_EQ(run({"check", out}).exit_code, 0);
  expect_refusal({"fix", in, "-o", folder / "out.obj"}, 2, "name it *.surf");
  expect_refusal({"fix", file("lh.pial", bytes), "-o", folder / "lh.obj"}, 2, "name it *.pial");
}

TEST_F(FreeSurfer, missing_vertices_are_reported_and_stay) {
  Surface surface = Document::parse(crossing + "v 9 9 9\nv 0 0 0\nf 4 9 10\n", Format::obj).surface();
  const std::string bytes = freesurfer_surface(surface, true);
  const std::string in = file("lh.white", bytes), out = folder / "out.white";
  const Outcome outcome = run({"fix", in, "-o", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("1 missing vertex (NaN) and the 1 face around stay as they are."), std::string::npos);
  EXPECT_EQ(pairs_in(out), 0u);
  const std::size_t faces = bytes.size() - 4 * surface.corners.size();
  EXPECT_EQ(contents(out).substr(faces - 12), bytes.substr(faces - 12));
  EXPECT_NE(contents(out), bytes);
}

}  // namespace
}  // namespace unsnarl::cli
