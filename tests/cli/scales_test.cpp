// The same mesh at any power of two, in every format whose numbers reach so far: the same result, times that.
#include <fmt/core.h>

#include <cmath>

#include "cli/program_test.h"
#include "unsnarl/samples.h"

namespace unsnarl::cli {
namespace {

Surface scaled(Surface surface, int exponent) {
  for (double& x : surface.positions) x = std::ldexp(x, exponent);
  return surface;
}

/// One line a vertex, or a face after `before_face`.
std::string lines(const Surface& surface, const std::string& before_vertex, const std::string& before_face,
                  std::int32_t first_id, bool with_size) {
  std::string text;
  for (std::size_t v = 0; v < surface.view().vertex_count(); ++v)
    text += fmt::format("{}{} {} {}\n", before_vertex, surface.positions[3 * v], surface.positions[3 * v + 1],
                        surface.positions[3 * v + 2]);
  for (std::size_t f = 0; f < surface.view().face_count(); ++f) {
    text += before_face;
    if (with_size) text += fmt::format("{} ", surface.view().face(f).size());
    for (const std::int32_t v : surface.view().face(f)) text += fmt::format("{} ", v + first_id);
    text.back() = '\n';
  }
  return text;
}

std::string obj(const Surface& s) {
  return lines(s, "v ", "f ", 1, false);
}
std::string off(const Surface& s) {
  return fmt::format("OFF\n{} {} 0\n", s.view().vertex_count(), s.view().face_count()) + lines(s, "", "", 0, true);
}
std::string ply(const Surface& s) {
  return fmt::format(
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
             "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
             s.view().vertex_count(), s.view().face_count()) +
         lines(s, "", "", 0, true);
}
std::string stl(const Surface& s) {
  std::string text = "solid a\n";
  for (std::size_t f = 0; f < s.view().face_count(); ++f) {
    const auto corners = s.view().face(f);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const std::int32_t v : {corners[0], corners[k], corners[k + 1]})
        text += fmt::format("vertex {} {} {}\n", static_cast<float>(s.positions[3 * v]),
                            static_cast<float>(s.positions[3 * v + 1]), static_cast<float>(s.positions[3 * v + 2]));
      text += "endloop\nendfacet\n";
    }
  }
  return text + "endsolid a\n";
}

struct Case {
  const char* extension;
  std::string (*write)(const Surface&);
  std::vector<int> exponents;
  bool is_float32 = false;
};

class AnyScale : public testing::TestWithParam<Case> {};

TEST_P(AnyScale, gives_the_same_result) {
  const Case& c = GetParam();
  Surface surface = make_sample(c.is_float32 ? "crossing_tubes" : "overlapping_quads", 8);
  // Digits of float32, so that every format holds the input exactly.
  for (double& x : surface.positions) x = static_cast<float>(x);
  const auto repaired = [&](int exponent) {
    const Folder folder;
    const std::string in = folder / fmt::format("in.{}", c.extension),
                      out = folder / fmt::format("out.{}", c.extension);
    write(in, c.write(scaled(surface, exponent)));
    std::vector<std::string> arguments = {"fix", in, "-o", out, "--quiet"};
    if (!c.is_float32) arguments.insert(arguments.end(), {"--precision", "float64"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << c.extension << " at 2^" << exponent << ": " << outcome.err;
    EXPECT_EQ(run({"check", out}).exit_code, 0);
    EXPECT_EQ(run({"check", in}).exit_code, 1);
    return outcome.exit_code == 0 ? Document::read(out).surface().positions : std::vector<double>();
  };
  const std::vector<double> usual = repaired(0);
  for (const int exponent : c.exponents) {
    std::vector<double> positions = repaired(exponent);
    for (double& x : positions) x = std::ldexp(x, -exponent);
    EXPECT_EQ(positions, usual) << c.extension << " at 2^" << exponent;
  }
}

const std::vector<int> of_double = {-900, -300, 300, 900}, of_float = {-90, 120};

INSTANTIATE_TEST_SUITE_P(Program, AnyScale,
                         testing::Values(Case{"obj", obj, of_double}, Case{"off", off, of_double},
                                         Case{"ply", ply, of_double}, Case{"stl", stl, of_float, true}),
                         [](const auto& info) { return std::string(info.param.extension); });

using ScaleTest = ProgramTest;

TEST_F(ScaleTest, a_vertex_that_leaves_the_range_of_float32_is_written_in_float64) {
  std::string text;
  for (const char* line : {"v 0 0 0", "v 2.8e38 0 0", "v 0 2.8e38 0", "v 0 0 2.8e38", "v 0.5e38 0.4e38 0.3e38",
                           "v 3.4e38 0.4e38 0.3e38", "v 0.5e38 3.3e38 0.3e38", "v 0.5e38 0.4e38 3.4e38", "f 1 3 2",
                           "f 1 2 4", "f 2 3 4", "f 1 4 3", "f 5 7 6", "f 5 6 8", "f 6 7 8", "f 5 8 7"})
    text += std::string(line) + "\n";
  const Outcome outcome = run({"fix", file("near.obj", text), "-o", folder / "out.obj"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace
}  // namespace unsnarl::cli
