#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "applications/curves/files/path_data.h"
#include "unsnarl/curves.h"

namespace unsnarl {
namespace {

CurveDocument svg(const std::string& inside, double flatten_rel = 1e-4) {
  return CurveDocument::parse("<svg xmlns=\"http://www.w3.org/2000/svg\">\n" + inside + "\n</svg>\n", CurveFormat::svg,
                              flatten_rel);
}
std::string svg_error(const std::string& text) {
  try {
    CurveDocument::parse(text, CurveFormat::svg);
  } catch (const FileError& e) {
    return e.what();
  }
  return "";
}
std::string json_error(const std::string& text) {
  try {
    CurveDocument::parse(text, CurveFormat::json);
  } catch (const FileError& e) {
    return e.what();
  }
  return "";
}
bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(CurveDocument, groups_nested_too_deeply_are_refused) {
  std::string open, close;
  for (int k = 0; k < 255; ++k) open += "<g>", close += "</g>";
  EXPECT_EQ(svg_error("<svg>" + open + close + "</svg>"), "");
  EXPECT_EQ(svg_error("<svg>\n<g>" + open + close + "</g></svg>"),
            "line 2: nested too deeply: more than 256 elements within each other");
  EXPECT_TRUE(says(json_error("{\"curves\": " + std::string(300, '[')), "nested too deeply"));
}

TEST(CurveDocument, unmoved_files_come_back_byte_for_byte) {
  const std::string text =
      "<?xml version=\"1.0\"?>\n<!-- kept --><svg xmlns=\"http://www.w3.org/2000/svg\"  >"
      "<path d='M0 0c1,1,2-1 3 .5.5.5.5.5.5.5z m 5 5 l 1 0 0 1'/><rect width=\"3\" "
      "height=\"2\"/><text>x</text></svg>\n";
  const CurveDocument document = CurveDocument::parse(text, CurveFormat::svg);
  EXPECT_EQ(document.patched(document.curves()), text);
  const std::string json =
      "{ \"curves\" : [ {\"points\": [[0, 1e0], [2.50,3]], \"colour\": \"red\"} ], \"x\": null }\n";
  const CurveDocument other = CurveDocument::parse(json, CurveFormat::json);
  EXPECT_EQ(other.patched(other.curves()), json);
}

TEST(CurveDocument, a_moved_subpath_leaves_the_others_their_beziers) {
  const CurveDocument document =
      svg("<path id=\"p\" class=\"k\" d=\"m 1,2 l 4,0 m 1 1 c 1 0 2 1 2 2 z l 3 3\" fill=\"none\"/>");
  ASSERT_EQ(document.curves().size(), 3U);
  std::vector<Curve> moved = document.curves();
  moved[0].points[1] = 2.5;
  const std::string text = document.patched(moved);
  EXPECT_TRUE(
      says(text, "<path id=\"p\" class=\"k\" d=\"M 1,2.5 5,2 M 6,3 c 1 0 2 1 2 2 z M 6,3l 3 3\" fill=\"none\"/>"))
      << text;
  const std::vector<Curve> back = document.read_back(text);
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(back[c].points, moved[c].points) << c;
}

TEST(CurveDocument, beziers_and_arcs_stay_where_their_points_did_not_move) {
  const CurveDocument document =
      svg("<path id=\"p\" d=\"M 0,0 C 0,8 4,12 10,12 Q 20,12 20,0 L 20,-10 10,-10\"/>\n"
          "<circle id=\"c\" transform=\"scale(2 1)\" cx=\"20\" cy=\"0\" r=\"3\"/>");
  std::vector<Curve> moved = document.curves();
  moved[0].points.end()[-2] += 1;
  EXPECT_TRUE(says(document.patched(moved), "d=\"M 0,0 C 0,8 4,12 10,12 16.66666667,12 20,8 20,0 L 20,-10 11,-10\""))
      << document.patched(moved);

  // A moved point of the circle: quarter circles or less on both sides of it, and its own radius all around.
  moved = document.curves();
  const std::size_t half = moved[1].size() / 2 + 3;
  moved[1].points[2 * half] += 0.001;
  const std::string text = document.patched(moved);
  EXPECT_TRUE(says(text, "d=\"M 23,0 C 23,0.3")) << text;
  const Curve back = document.read_back(text)[1];
  for (std::size_t k = 0; k < back.size(); ++k)
    EXPECT_NEAR(std::hypot((back.points[2 * k] - 40) / 2, back.points[2 * k + 1]), 3, 1e-3) << k;
}

TEST(CurveDocument, points_that_moved_between_beziers_are_joined_without_kinks) {
  const CurveDocument document = svg("<path d=\"M 0,0 C 0,40 100,40 100,0\"/>", 1e-3);
  std::vector<Curve> moved = document.curves();
  const std::size_t middle = moved[0].size() / 2;
  for (std::size_t k = middle - 1; k <= middle + 1; ++k) moved[0].points[2 * k + 1] += 1 + k % 2;
  const CurveDocument fine = CurveDocument::parse(document.patched(moved), CurveFormat::svg, 1e-6);
  const Curve& curve = fine.curves()[0];
  ASSERT_GT(curve.size(), 100U);
  double largest = 0;
  for (std::size_t k = 1; k + 1 < curve.size(); ++k) {
    const double ax = curve.points[2 * k] - curve.points[2 * k - 2],
                 ay = curve.points[2 * k + 1] - curve.points[2 * k - 1];
    const double bx = curve.points[2 * k + 2] - curve.points[2 * k],
                 by = curve.points[2 * k + 3] - curve.points[2 * k + 1];
    largest = std::max(largest, std::abs(std::atan2(ax * by - ay * bx, ax * bx + ay * by)));
  }
  EXPECT_LT(largest, 0.1);
  // Straight lines on one side of them: they are segments.
  const CurveDocument line = svg("<path d=\"M 0,0 L 10,0 C 20,0 20,10 20,20\"/>");
  std::vector<Curve> bent = line.curves();
  bent[0].points[3] -= 1;
  EXPECT_TRUE(says(line.patched(bent), "d=\"M 0,0 10,-1 ")) << line.patched(bent);
}

TEST(CurveDocument, one_that_is_written_as_a_polyline_has_all_its_points) {
  const CurveDocument document = svg("<path d=\"M 0,0 C 0,40 100,40 100,0\"/>");
  std::vector<Curve> moved = document.curves();
  moved[0].points[4] += 1;
  const std::vector<CurveWriting> polylines{CurveWriting::polyline};
  EXPECT_EQ(document.read_back(document.patched(moved, true, polylines))[0].points, moved[0].points);
  EXPECT_THROW(document.patched(moved, true, std::vector<CurveWriting>(2)), std::invalid_argument);
}

TEST(CurveDocument, shapes_become_paths_only_when_they_move) {
  const CurveDocument document =
      svg("<line id=\"a\" x1=\"0\" y1=\"0\" x2=\"4\" y2=\"1\" stroke=\"red\"/>"
          "<rect id=\"b\" x=\"10\" y=\"10\" width=\"4\" height=\"2\"><title>box</title></rect>"
          "<circle id=\"c\" cx=\"30\" r=\"5\"/>");
  ASSERT_EQ(document.curves().size(), 3U);
  EXPECT_EQ(document.curves()[1].size(), 4U);
  std::vector<Curve> moved = document.curves();
  moved[0].points[3] = 2;
  moved[1].points[0] = 9;
  const std::string text = document.patched(moved);
  EXPECT_TRUE(says(text, "<path id=\"a\" d=\"M 0,0 4,2\" stroke=\"red\"/>")) << text;
  EXPECT_TRUE(says(text, "d=\"M 9,10 14,10 14,12 10,12 Z\"")) << text;
  EXPECT_TRUE(says(text, "<title>box</title></path>")) << text;
  EXPECT_TRUE(says(text, "<circle id=\"c\" cx=\"30\" r=\"5\"/>")) << text;
  const std::vector<Curve> back = document.read_back(text);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(back[c].points, moved[c].points) << c;
}

TEST(CurveDocument, transforms_are_applied_and_taken_back) {
  const CurveDocument document =
      svg("<g transform=\"translate(10,20) scale(2)\"><polyline points=\"0,0 1,0 1,1\" transform=\"rotate(90)\"/></g>");
  const std::vector<double>& p = document.curves()[0].points;
  EXPECT_NEAR(p[2], 10, 1e-12);
  EXPECT_NEAR(p[3], 22, 1e-12);
  EXPECT_NEAR(p[4], 8, 1e-12);
  std::vector<Curve> moved = document.curves();
  moved[0].points[4] = 7.5;
  const std::vector<Curve> back = document.read_back(document.patched(moved));
  for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR(back[0].points[k], moved[0].points[k], 1e-8);
}

TEST(CurveDocument, flattening_keeps_its_tolerance) {
  for (const double flatten : {1e-2, 1e-4}) {
    const CurveDocument document = svg("<circle cx=\"3\" cy=\"4\" r=\"10\"/><ellipse rx=\"3\" ry=\"1\"/>", flatten);
    const double tolerance = flatten * std::hypot(20, 20);
    const Curve& circle = document.curves()[0];
    for (std::size_t k = 0; k < circle.size(); ++k) {
      const std::size_t next = (k + 1) % circle.size();
      const double x = 0.5 * (circle.points[2 * k] + circle.points[2 * next]) - 3;
      const double y = 0.5 * (circle.points[2 * k + 1] + circle.points[2 * next + 1]) - 4;
      EXPECT_NEAR(std::hypot(x, y), 10, 1.01 * tolerance);
    }
  }
  // A cubic against itself, sampled finely.
  const std::vector<Subpath> path = parse_path_data("M0 0C 4 0 -3 5 1 5", 1e-3);
  const std::vector<Vec2>& points = path[0].points;
  for (int k = 0; k <= 1000; ++k) {
    const double t = k / 1000.0, u = 1 - t;
    const Vec2 p = 3 * t * u * u * Vec2(4, 0) + 3 * t * t * u * Vec2(-3, 5) + t * t * t * Vec2(1, 5);
    double nearest = 1;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Vec2 d = points[i] - points[i - 1];
      const double s = std::clamp((p - points[i - 1]).dot(d) / d.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (points[i - 1] + s * d - p).norm());
    }
    EXPECT_LE(nearest, 1e-3);
  }
}

TEST(CurveDocument, path_data_of_all_kinds) {
  const auto ends = [](const char* data) { return parse_path_data(data, 0.1).back().points.back(); };
  EXPECT_EQ(ends("M1 1 2 2"), Vec2(2, 2));
  EXPECT_EQ(ends("m1 1 2 2"), Vec2(3, 3));
  EXPECT_EQ(ends("M1 1h2v-1H7V9"), Vec2(7, 9));
  EXPECT_EQ(ends("M0 0q1 1 2 0t2 0"), Vec2(4, 0));
  EXPECT_EQ(ends("M0,0c0,1,1,1,1,0s1-1 1 0"), Vec2(2, 0));
  EXPECT_EQ(ends("M0 0a1 1 0 012-.5"), Vec2(2, -0.5));
  EXPECT_EQ(ends("M0 0L-1.5.5+2-3"), Vec2(2, -3));
  EXPECT_EQ(parse_path_data("M0 0L1 0 1 1ZL5 5", 0.1).size(), 2U);
}

TEST(CurveDocument, what_is_not_drawn_is_left_alone) {
  const CurveDocument document =
      svg("<defs><path d=\"M0 0L1 1\"/></defs><g display=\"none\"><path d=\"M0 0L1 1\"/></g><use href=\"#x\"/><rect "
          "width=\"100%\" height=\"100%\"/>"
          "<path d=\"M5 5\"/><path d=\"\"/><rect width=\"0\" height=\"3\"/>");
  EXPECT_TRUE(document.curves().empty());
  ASSERT_EQ(document.notes().size(), 2U);
  EXPECT_TRUE(says(document.notes()[0], "<rect in %>"));
  EXPECT_TRUE(says(document.notes()[1], "<use>"));
}

TEST(CurveDocument, bad_svg_is_refused_and_the_place_named) {
  EXPECT_TRUE(says(svg_error("<svg>\n<path d=\"M0 0\"\n</svg>"), "line "));
  EXPECT_TRUE(says(svg_error("<html/>"), "root element is <html>"));
}

/// The first note of a drawing with a line that is understood and something that is not.
std::string note_of(const std::string& what) {
  const CurveDocument document = svg("<path d=\"M0 0L1 1\"/>\n" + what);
  EXPECT_EQ(document.curves().size(), 1U) << what;
  return document.notes().empty() ? "" : document.notes().front();
}

TEST(CurveDocument, what_is_not_understood_is_left_and_the_place_noted) {
  EXPECT_TRUE(says(note_of("<path id=\"p\" d=\"M0 0L1 x\"/>"), "<path> 'p' on line 3 is left as it is"));
  EXPECT_TRUE(says(note_of("<path d=\"L0 0\"/>"), "start with M"));
  EXPECT_TRUE(says(note_of("<path d=\"M0 0 L nan 1\"/>"), "not a number"));
  EXPECT_TRUE(says(note_of("<path d=\"M0 0 L 1e999 1\"/>"), "not a number"));
  EXPECT_TRUE(says(note_of("<g transform=\"scale(0)\"><path d=\"M0 0L1 1\"/></g>"), "flatten the plane"));
  EXPECT_TRUE(says(note_of("<g transform=\"perspective(3)\"><path d=\"M0 0L1 1\"/></g>"), "not a known transform"));
  EXPECT_TRUE(says(note_of("<g style=\"transform: rotate3d(1, 1, 1, 45deg)\"/>"), "not a transform of the plane"));
  EXPECT_TRUE(says(note_of("<g style=\"rotate: 45deg\"/>"), "the property 'rotate'"));
  EXPECT_TRUE(says(note_of("<circle r=\"3em\"/>"), "r=\"3em\""));
  EXPECT_TRUE(says(note_of("<rect width=\"30%\" height=\"1\"/>"), "of a page of unknown size"));
  EXPECT_TRUE(says(note_of("<polygon points=\"0 0 1\"/>"), "3 numbers"));
  EXPECT_TRUE(says(note_of("<style>a:hover { fill: red }</style>"), "'a:hover' is not understood"));
}

TEST(CurveDocument, hidden_elements_are_not_there) {
  const auto count = [](const std::string& style, const char* body) {
    return svg("<style>" + style + "</style>" + body).curves().size();
  };
  const char* const two = "<g id=\"g\" class=\"a b\"><path class=\"c\" d=\"M0 0L1 1\"/></g><path d=\"M2 0L3 1\"/>";
  EXPECT_EQ(count("", two), 2U);
  EXPECT_EQ(count(".c{display:none}", two), 1U);
  EXPECT_EQ(count("<![CDATA[ .x, g.b { display : none } ]]>", two), 1U);
  EXPECT_EQ(count("#g path{display:none}", two), 1U);
  EXPECT_EQ(count("svg > path{display:none}", two), 1U);
  EXPECT_EQ(count("svg path{display:none}", two), 0U);
  EXPECT_EQ(count("/* .c{display:none} */ .d{display:none}", two), 2U);
  EXPECT_EQ(count("@media print{.c{display:none}}", two), 2U);
  // Specificity, order and importance.
  EXPECT_EQ(count("#g .c{display:inline} .c{display:none}", two), 2U);
  EXPECT_EQ(count(".c{display:inline} .c{display:none}", two), 1U);
  EXPECT_EQ(count("#g .c{display:inline} .c{display:none !important}", two), 1U);
  EXPECT_EQ(count(".c{display:none}", "<path class=\"c\" style=\"display:inline\" d=\"M0 0L1 1\"/>"), 1U);
  // Visibility is inherited, and may be taken back.
  EXPECT_EQ(count("g{visibility:hidden}", two), 1U);
  EXPECT_EQ(count("g{visibility:hidden} .c{visibility:visible}", two), 2U);
}

TEST(CurveDocument, transforms_units_and_inner_pages_place_curves) {
  const auto first = [](const std::string& body) {
    const std::vector<Curve> curves = svg(body).curves();
    EXPECT_EQ(curves.size(), 1U) << body;
    return curves.empty() ? std::vector<double>(4, 0) : curves[0].points;
  };
  const auto expect = [&](const std::string& body, std::vector<double> points) {
    const std::vector<double> found = first(body);
    ASSERT_GE(found.size(), points.size()) << body;
    for (std::size_t k = 0; k < points.size(); ++k) EXPECT_NEAR(found[k], points[k], 1e-9) << body;
  };
  const std::string line = " d=\"M0 0L10 0\"/>";
  expect("<path style=\"transform: translate(1in, 3px) rotate(90deg)\"" + line, {96, 3, 96, 13});
  expect("<path transform=\"scale(9)\" style=\"transform: none\"" + line, {0, 0, 10, 0});
  expect("<style>.r{transform:rotate(.5turn);transform-origin:5px 1px}</style><path class=\"r\"" + line, {10, 2, 0, 2});
  expect("<line x1=\"1in\" y1=\"2.54cm\" x2=\"72pt\" y2=\"1pc\"/>", {96, 96, 96, 16});
  expect("<svg width=\"200\" height=\"50\"><line x2=\"50%\" y2=\"100%\"/></svg>", {0, 0, 100, 50});
  expect("<svg x=\"5\" y=\"6\" width=\"20\" height=\"40\" viewBox=\"1 1 10 10\"><path" + line + "</svg>",
         {3, 14, 23, 14});
  expect(
      "<svg width=\"20\" height=\"40\" viewBox=\"0 0 10 10\" preserveAspectRatio=\"none\"><path d=\"M0 0L1 1\"/></svg>",
      {0, 0, 2, 4});
}

TEST(CurveDocument, a_use_of_a_shape_is_a_curve_and_becomes_a_path) {
  const CurveDocument document =
      svg("<defs><path id=\"s\" class=\"k\" transform=\"scale(2)\" d=\"M0 0L5 0\"/></defs>"
          "<use id=\"u\" href=\"#s\" x=\"3\" y=\"4\"/>");
  ASSERT_EQ(document.curves().size(), 1U);
  EXPECT_EQ(document.curves()[0].points, (std::vector<double>{3, 4, 13, 4}));
  EXPECT_EQ(document.ids()[0], "u");
  std::vector<Curve> moved = document.curves();
  moved[0].points[3] = 7;
  const std::string text = document.patched(moved);
  EXPECT_TRUE(says(text, "<g id=\"u\"><path class=\"k\" d=\"M 3,4 13,7\"/></g>")) << text;
  EXPECT_TRUE(says(text, "<path id=\"s\" class=\"k\" transform=\"scale(2)\" d=\"M0 0L5 0\"/>"));
  EXPECT_EQ(document.read_back(text)[0].points, moved[0].points);
}

TEST(CurveDocument, bad_json_is_refused_and_the_place_named) {
  EXPECT_TRUE(says(json_error("{\"curves\": ["), "byte"));
  EXPECT_TRUE(says(json_error("[]"), "no list \"curves\""));
  EXPECT_TRUE(says(json_error("{\"curves\": [{}]}"), "curve 0 has no list \"points\""));
  EXPECT_TRUE(says(json_error("{\"curves\": [{\"points\": [[0, 0], [1]]}]}"), "point 1 is not [x, y]"));
  EXPECT_TRUE(says(json_error("{\"curves\": [{\"points\": [[0, 0], [1, 1], [1, 1]]}]}"), "points 1 and 2 are equal"));
  EXPECT_TRUE(says(json_error("{\"curves\": [{\"points\": [[0, 0], [1, 1]], \"fixed\": [2]}]}"), "no point 2"));
  EXPECT_TRUE(says(json_error("{\"curves\": [{\"points\": [[0, 0], [1, 1]], \"closed\": 1}]}"), "true or false"));
}

TEST(CurveDocument, inserted_points_are_written) {
  const std::string text = "{\"curves\": [{\"points\": [[0, 0], [10, 0]]}, {\"points\": [[5, 0], [5, 3]]}]}";
  const CurveDocument document = CurveDocument::parse(text, CurveFormat::json);
  std::vector<Curve> moved = document.curves();
  moved[0].points = {0, 0, 5, 0, 10, 0};
  EXPECT_EQ(document.patched(moved),
            "{\"curves\": [{\"points\": [[0, 0], [5, 0], [10, 0]]}, {\"points\": [[5, 0], [5, 3]]}]}");
}

TEST(CurveDocument, all_digits_keep_what_rounding_would_join) {
  const CurveDocument document = CurveDocument::parse(
      "{\"curves\": [{\"points\": [[0, 0], [7, 0], [9, 1]]}, {\"points\": [[0, 5], [7, 4], [9, 9]]}]}",
      CurveFormat::json);
  std::vector<Curve> moved = document.curves();
  moved[0].points[3] = 1e-12;  // below the tip of the other one, nearer than coordinates are rounded to
  moved[1].points[3] = 2e-12;
  EXPECT_EQ(find_crossings(moved).size(), 0U);
  EXPECT_GT(find_crossings(document.read_back(document.patched(moved))).size(), 0U);
  const std::vector<Curve> back = document.read_back(document.patched(moved, true));
  for (std::size_t c = 0; c < 2; ++c) EXPECT_EQ(back[c].points, moved[c].points);
}

TEST(CurveDocument, flattening_is_relative_to_the_curves_and_not_to_their_ends) {
  // A loop of one Bézier curve that ends where it starts, in three sizes.
  std::size_t points[3];
  int k = 0;
  for (const char* const data : {"M0 0C.009.001-.003.009 0 0", "M0 0C9 1-3 9 0 0", "M0 0C9e3 1e3-3e3 9e3 0 0"})
    points[k++] = svg(std::string("<path d=\"") + data + "\"/>").curves()[0].size();
  EXPECT_EQ(points[0], points[1]);
  EXPECT_EQ(points[0], points[2]);
  EXPECT_GT(points[0], 20U);
  EXPECT_LT(points[0], 500U);
}

TEST(CurveDocument, short_last_segments_are_kept_and_rounding_is_closed) {
  const CurveDocument document =
      svg("<polygon points=\"0,0 4,0 4,4 0,0.000001\"/><path d=\"m0 0l.1 0l.1 0 .1 0 0 1 -.3 -1z\"/>");
  EXPECT_EQ(document.curves()[0].size(), 4U);
  EXPECT_EQ(document.curves()[1].size(), 5U);
}

TEST(CurveDocument, shapes_within_shapes_are_left_alone) {
  const CurveDocument document =
      svg("<rect width=\"4\" height=\"2\"><!--</rect>--><rect x=\"9\" width=\"4\" height=\"2\"></rect><desc/></rect >");
  ASSERT_EQ(document.curves().size(), 1U);
  std::vector<Curve> moved = document.curves();
  moved[0].points[0] = -1;
  const std::string text = document.patched(moved);
  EXPECT_TRUE(says(text, "<!--</rect>--><rect x=\"9\" width=\"4\" height=\"2\"></rect><desc/></path >")) << text;
  EXPECT_EQ(document.read_back(text)[0].points, moved[0].points);
}

TEST(CurveDocument, numbers_beyond_arithmetic_are_refused) {
  const auto refused = [](const std::string& inside, const char* words) {
    return says(svg_error("<svg>" + inside + "</svg>"), words);
  };
  EXPECT_TRUE(refused("<path d=\"M0 0L1e300 1\"/>", "is beyond 1e+70"));
  EXPECT_TRUE(refused("<path d=\"M0 0C1e308-1e308-1e308 1e308 1 1A1e308 1 0 0 1-1e308 3\"/>", "is beyond 1e+70"));
  EXPECT_TRUE(refused("<path d=\"M0 0L1e-200 1e-200\"/>", "lie within a length of 1e-70"));
  EXPECT_TRUE(says(note_of("<path d=\"M0 0L1 1\" transform=\"scale(1e200,1)\"/>"), "flatten the plane"));
  EXPECT_TRUE(says(note_of("<path d=\"M0 0L1 1\" transform=\"scale(1e300) scale(1e300)\"/>"), "flatten the plane"));
  EXPECT_TRUE(says(json_error("{\"curves\": [{\"points\": [[0, 0], [1e308, -1e308]]}]}"), "use another unit"));
}

TEST(CurvePictures, are_files_of_their_kind) {
  const std::vector<Curve> curves{random_closed_curve("star", 1, 200)};
  const std::string png = curve_integrand_png(curves[0], 0.05, 64);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_THROW(curve_integrand_png(curves[0], 0, 64), std::invalid_argument);
  const std::vector<CurveCrossing> crossings = find_crossings(curves);
  const std::string picture = curve_picture_svg(curves, crossings, curves, {});
  std::size_t circles = 0;
  for (std::size_t at = picture.find("<circle"); at != std::string::npos; at = picture.find("<circle", at + 1))
    ++circles;
  EXPECT_EQ(circles, crossings.size());
  // It is read as SVG too.
  EXPECT_EQ(CurveDocument::parse(picture, CurveFormat::svg).curves().size(), 2U + circles);
}

}  // namespace
}  // namespace unsnarl
