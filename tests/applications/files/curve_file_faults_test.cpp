#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>

#include "geometry/splitmix.h"
#include "oracle/crossings_by_brute_force.h"
#include "unsnarl/curves.h"

namespace unsnarl {
namespace {

/// A wavy ring and two curves of which one ends on the ring, the other on the ring and on the first: all numbers are as
/// long as doubles are.
std::vector<std::vector<double>> random_net(std::uint64_t seed) {
  std::uint64_t state = seed * 1000;
  const auto random = [&](double from, double to) {
    return from + (to - from) * splitmix_number(++state * splitmix_step);
  };
  std::vector<double> ring;
  const double phase = random(0, 6);
  for (int k = 0; k < 24; ++k) {
    const double t = 2 * std::numbers::pi * k / 24, r = 30 * (1 + 0.4 * std::sin(3 * t + phase));
    ring.insert(ring.end(), {50 + r * std::cos(t), 50 + r * std::sin(t)});
  }
  const auto on = [&](const std::vector<double>& curve, std::size_t k) {
    const double t = random(0.2, 0.8);
    return std::array{(1 - t) * curve[2 * k] + t * curve[2 * k + 2], (1 - t) * curve[2 * k + 1] + t * curve[2 * k + 3]};
  };
  const auto wiggle = [&](std::array<double, 2> a, std::array<double, 2> b) {
    std::vector<double> curve{a[0], a[1]};
    for (int k = 1; k < 12; ++k)
      for (int axis = 0; axis < 2; ++axis) curve.push_back(a[axis] + (b[axis] - a[axis]) * k / 12 + random(-4, 4));
    curve.insert(curve.end(), {b[0], b[1]});
    return curve;
  };
  const std::array<double, 2> begin = on(ring, 3), end = {random(0, 100), random(0, 100)};
  const std::vector<double> first = wiggle(begin, end);
  const std::array<double, 2> on_ring = on(ring, 14), on_first = on(first, 6);
  return {ring, first, wiggle(on_ring, on_first)};
}

std::string points_json(const std::vector<double>& points) {
  std::string text;
  for (std::size_t k = 0; k < points.size(); k += 2)
    text += fmt::format("{}[{}, {}]", k == 0 ? "" : ", ", points[k], points[k + 1]);
  return "[" + text + "]";
}

CurveDocument as_json(const std::vector<std::vector<double>>& net) {
  return CurveDocument::parse(fmt::format(R"({{"curves": [{{"points": {}, "closed": true}}, {{"points": {}}}, )"
                                          R"({{"points": {}}}]}})",
                                          points_json(net[0]), points_json(net[1]), points_json(net[2])),
                              CurveFormat::json);
}

/// The second curve in an element that is turned, the third in one that is shifted and drawn larger.
CurveDocument as_svg(const std::vector<std::vector<double>>& net) {
  const double turn = 33 * std::numbers::pi / 180;
  const std::array<std::string, 3> transforms = {"", "rotate(33)", "translate(7.1,3) scale(2.3)"};
  std::string text = "<svg>";
  for (std::size_t c = 0; c < 3; ++c) {
    std::string data = "M";
    for (std::size_t k = 0; k < net[c].size(); k += 2) {
      double x = net[c][k], y = net[c][k + 1];
      if (c == 1)
        std::tie(x, y) = std::pair(std::cos(turn) * x + std::sin(turn) * y, std::cos(turn) * y - std::sin(turn) * x);
      if (c == 2) std::tie(x, y) = std::pair((x - 7.1) / 2.3, (y - 3) / 2.3);
      data += fmt::format(" {},{}", x, y);
    }
    text += fmt::format("<path transform=\"{}\" d=\"{}{}\"/>", transforms[c], data, c == 0 ? "Z" : "");
  }
  return CurveDocument::parse(text + "</svg>", CurveFormat::svg);
}

/// As many crossings are in the file as in the result, by an oracle for which points at two places are two; as the
/// program writes it, with all digits where fewer do not keep the curves apart. Returns the status, or none where the
/// certificate refuses both files.
std::optional<Status> status_of_written(const CurveDocument& document) {
  const CurveResult result = untangle_curves(document.curves());
  for (const bool all_digits : {false, true}) {
    const std::string bytes = document.patched(result.curves, all_digits);
    const std::size_t there = oracle::count_crossings(document.read_back(bytes), result.report.joints);
    const std::string faults = curve_file_faults(document, bytes, result);
    EXPECT_EQ(faults.empty(), there <= result.report.crossings_after) << faults;
    if (faults.empty()) return result.status;
  }
  return std::nullopt;
}

/// Closed curves of Béziers through random points, some of them turned.
std::string random_beziers(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto number = [&] { return 100 * (static_cast<double>(random() >> 11) * 0x1p-53); };
  std::string text = "<svg>";
  for (int c = 0; c < 3; ++c) {
    std::string data;
    for (int k = 0; k < 4; ++k) {
      data += k == 0 ? "M" : k == 1 ? " C" : " S";
      for (int n = 0; n < (k == 0 ? 1 : k == 1 ? 3 : 2); ++n) {
        const double x = number();
        data += fmt::format(" {:.3f},{:.3f}", x, number());
      }
    }
    text += fmt::format("<path transform=\"rotate({})\" d=\"{}Z\"/>", c == 2 ? 20 : 0, data);
  }
  return text + "</svg>";
}

/// The paths of a text of random_beziers or made from one, each Bézier in 24 segments, by code that shares nothing with
/// the program's.
std::vector<Curve> flattened(const std::string& text) {
  std::vector<Curve> curves;
  for (std::size_t at = text.find("<path"); at != std::string::npos; at = text.find("<path", at + 1)) {
    const double turn = std::stod(text.substr(text.find("rotate(", at) + 7)) * std::numbers::pi / 180;
    const std::size_t begin = text.find(" d=\"", at) + 4;
    std::string data = text.substr(begin, text.find('"', begin) - begin);
    for (std::size_t k = 0; k < data.size(); ++k) {
      if (data[k] == ',') data[k] = ' ';
      if (std::string("MLCSZ").find(data[k]) != std::string::npos)
        data.replace(k, 1, fmt::format(" {} ", data[k])), ++k;
    }
    using Place = std::array<double, 2>;
    std::vector<Place> points;
    Place handle{};
    char command = ' ';
    std::istringstream words(data);
    for (std::string word; words >> word;) {
      if (std::string("MLCSZ").find(word) != std::string::npos) {
        command = word[0];
        continue;
      }
      const int count = command == 'C' ? 3 : command == 'S' ? 2 : 1;
      std::array<Place, 3> given{};
      for (int n = 0; n < count; ++n) {
        if (n > 0) words >> word;
        given[n][0] = std::stod(word);
        words >> given[n][1];
      }
      const Place to = given[count - 1];
      if (count == 1) {
        points.push_back(to);
        handle = to;
        command = 'L';
        continue;
      }
      const Place from = points.back();
      const Place first = count == 3 ? given[0] : Place{2 * from[0] - handle[0], 2 * from[1] - handle[1]};
      handle = given[count - 2];
      for (int part = 1; part < 24; ++part) {
        const double t = part / 24.0, u = 1 - t;
        Place p{};
        for (int axis = 0; axis < 2; ++axis)
          p[axis] = u * u * u * from[axis] + 3 * t * u * u * first[axis] + 3 * t * t * u * handle[axis] +
                    t * t * t * to[axis];
        points.push_back(p);
      }
      points.push_back(to);
    }
    if (points.front() == points.back()) points.pop_back();
    Curve& curve = curves.emplace_back();
    curve.closed = true;
    for (const auto& [x, y] : points)
      curve.points.insert(curve.points.end(),
                          {std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y});
  }
  return curves;
}

TEST(CurveFileFaults, random_beziers_are_written_as_beziers_that_do_not_cross) {
  int with_beziers = 0, curves = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::string text = random_beziers(seed);
    EXPECT_GT(oracle::count_crossings(flattened(text), {}), 3U) << seed;
    const CurveDocument document = CurveDocument::parse(text, CurveFormat::svg);
    const CurveResult result = untangle_curves(document.curves());
    ASSERT_EQ(result.status, Status::embedded) << seed;
    const std::string bytes = written_curves(document, result);
    EXPECT_EQ(curve_file_faults(document, bytes, result), "") << seed;
    const std::vector<Curve> written = document.read_back(bytes), finer = document.read_back(bytes, 0.1);
    EXPECT_EQ(oracle::count_crossings(written, {}), 0U) << seed;
    for (std::size_t c = 0; c < written.size(); ++c)
      if (written[c].tolerance > 0) EXPECT_GT(finer[c].size(), written[c].size()) << seed;
    for (const double part : {0.0, 1.1}) EXPECT_THROW(document.read_back(bytes, part), std::invalid_argument);
    ASSERT_EQ(flattened(bytes).size(), written.size());
    EXPECT_EQ(oracle::count_crossings(flattened(bytes), {}), 0U) << seed;
    for (const Curve& curve : written) {
      with_beziers += curve.tolerance > 0;
      ++curves;
    }
  }
  EXPECT_GT(with_beziers, 4 * curves / 5);
}

TEST(CurveFileFaults, joints_of_random_nets_are_one_point_in_the_file_too) {
  int embedded = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::optional<Status> status = status_of_written(as_json(random_net(seed)));
    EXPECT_TRUE(status.has_value()) << seed;
    embedded += status == Status::embedded;
  }
  EXPECT_GT(embedded, 10);
}

TEST(CurveFileFaults, and_where_elements_have_transforms) {
  int embedded = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::optional<Status> status = status_of_written(as_svg(random_net(seed)));
    EXPECT_TRUE(status.has_value()) << seed;
    embedded += status == Status::embedded;
  }
  EXPECT_GT(embedded, 10);
}

/// An open curve that ends on another one, well apart from it elsewhere.
struct Tee {
  CurveDocument document = CurveDocument::parse(
      "{\"curves\": [{\"points\": [[0, 0], [10, 0.3]]}, {\"points\": [[5, 0.15], [5, 3], [7, 3]]}]}",
      CurveFormat::json);
  CurveResult result = untangle_curves(document.curves());

  std::string faults(const std::vector<Curve>& written) const {
    return curve_file_faults(document, document.patched(written, true), result);
  }
};

TEST(CurveFileFaults, an_end_that_is_shifted_by_the_last_digit_is_refused) {
  const Tee tee;
  ASSERT_EQ(tee.result.report.joints.size(), 1U);
  EXPECT_EQ(tee.faults(tee.result.curves), "");
  std::vector<Curve> corrupted = tee.result.curves;
  corrupted[1].points[1] = std::nextafter(corrupted[1].points[1], -1);
  EXPECT_EQ(tee.faults(corrupted), "it has 2 crossings, the result 0");
  corrupted[1].points[1] = 1;
  EXPECT_EQ(tee.faults(corrupted), "curve 0 and curve 1 have come apart");
}

TEST(CurveFileFaults, an_open_bezier_that_ends_where_it_begins_keeps_its_joint) {
  const CurveDocument document = CurveDocument::parse(
      "<svg><path d=\"M 0,0 C 20,0 20,20 0,0\"/><path d=\"M 30,0 C 40,40 60,40 70,0 M 30,10 L 70,12\"/></svg>",
      CurveFormat::svg);
  const CurveResult result = untangle_curves(document.curves());
  ASSERT_EQ(result.status, Status::embedded);
  ASSERT_EQ(result.report.joints.size(), 1U);
  EXPECT_EQ(curve_file_faults(document, written_curves(document, result), result), "");
  const CurveDocument loop = CurveDocument::parse("<svg><path d=\"M 0,0 C 20,0 20,20 0,0\"/></svg>", CurveFormat::svg);
  EXPECT_EQ(curve_file_faults(loop, loop.patched(loop.curves()), untangle_curves(loop.curves())), "");
}

TEST(CurveFileFaults, other_curves_are_refused) {
  const Tee tee;
  std::vector<Curve> corrupted = tee.result.curves;
  corrupted[1].points[5] = -3;
  EXPECT_EQ(tee.faults(corrupted), "it has 1 crossing, the result 0");
  corrupted = tee.result.curves;
  corrupted[1].points[4] = corrupted[1].points[2];
  corrupted[1].points[5] = corrupted[1].points[3];
  EXPECT_NE(tee.faults(corrupted).find("has no length"), std::string::npos);
  EXPECT_EQ(curve_file_faults(tee.document, tee.document.patched(tee.document.curves()), tee.result),
            "curve 0 has another number of points");
  EXPECT_EQ(curve_file_faults(tee.document, R"({"curves": []})", tee.result), "it has another number of curves");
}

}  // namespace
}  // namespace unsnarl
