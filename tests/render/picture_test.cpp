#include "render/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace unsnarl {
namespace {

/// A grid of n x n quads in the plane z = height, over [-1, 1]^2.
Surface plate(int n, double height = 0) {
  Surface surface;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      surface.positions.insert(surface.positions.end(), {2.0 * i / n - 1, 2.0 * j / n - 1, height});
  surface.offsets = {0};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j;
      surface.corners.insert(surface.corners.end(), {a, a + n + 1, a + n + 2, a + 1});
      surface.offsets.push_back(static_cast<Index>(surface.corners.size()));
    }
  return surface;
}

Surface together(const Surface& a, const Surface& b) {
  Surface both = a;
  const auto vertices = static_cast<Index>(a.positions.size() / 3), corners = static_cast<Index>(a.corners.size());
  both.positions.insert(both.positions.end(), b.positions.begin(), b.positions.end());
  for (Index v : b.corners) both.corners.push_back(v + vertices);
  for (std::size_t k = 1; k < b.offsets.size(); ++k) both.offsets.push_back(b.offsets[k] + corners);
  return both;
}

struct Counts {
  std::size_t drawn = 0, vivid = 0, tinted = 0;
};

/// Pixels in columns [from, to) that are not white; strongly red; and reddish but pale.
Counts count(const Image& image, int from, int to, int top = 0) {
  Counts counts;
  for (int y = top; y < image.height; ++y)
    for (int x = from; x < to; ++x) {
      const std::uint8_t* p = image.at(x, y);
      counts.drawn += p[0] < 245 || p[1] < 245 || p[2] < 245 ? 1 : 0;
      if (p[0] < 110 || p[0] < p[1] + 40 || p[0] < p[2] + 40) continue;
      (p[1] < 90 ? counts.vivid : counts.tinted) += 1;
    }
  return counts;
}

PictureOptions small() {
  PictureOptions options;
  options.width = 400;
  options.height = 200;
  options.inset = false;
  return options;
}

TEST(Picture, shows_red_faces_on_the_side_that_they_belong_to) {
  const Surface surface = plate(8);
  std::vector<Index> red(10);
  std::iota(red.begin(), red.end(), 20);
  const Image image = render_pair(surface, red, surface, {}, small());
  ASSERT_EQ(image.width, 400);
  ASSERT_EQ(image.height, 200);
  const Counts before = count(image, 0, 200), after = count(image, 201, 400);
  EXPECT_GT(before.drawn, 3000U);
  EXPECT_GT(after.drawn, 3000U);
  EXPECT_GT(before.vivid, before.drawn / 20);  // 10 of 64 faces
  EXPECT_EQ(after.vivid + after.tinted, 0U);
}

TEST(Picture, hidden_red_faces_show_through_as_a_tint) {
  // The second plate is hidden behind the first, as seen from in front and above.
  const Surface surface = together(plate(8, 0), plate(8, -0.05));
  const Image image = render_surface(surface, std::vector<Index>{64 + 27, 64 + 28, 64 + 35, 64 + 36}, small());
  const Counts counts = count(image, 0, image.width);
  EXPECT_GT(counts.tinted, 100U);
  EXPECT_LT(counts.vivid, counts.tinted / 10);
}

// A row of faces that are a third of a pixel wide: seen as a vivid line, and as an unbroken tint through a plate above.
TEST(Picture, narrow_red_faces_are_seen) {
  const int n = 500;
  const Surface fine = plate(n);
  std::vector<Index> row(n);
  std::iota(row.begin(), row.end(), n / 2 * n);
  const Counts seen = count(render_pair(fine, row, fine, {}, small()), 0, 200);
  EXPECT_GT(seen.vivid, 100U) << "as long as the plate, and more than a pixel wide";
  EXPECT_LT(seen.vivid + seen.tinted, 800U);
  const Surface hidden = together(fine, plate(1, 0.3));
  const Counts through = count(render_pair(hidden, row, hidden, {}, small()), 0, 200);
  EXPECT_GT(through.tinted, 100U);
}

TEST(Picture, what_is_behind_something_translucent_shows_through) {
  Surface low = plate(1, -0.1);
  for (std::size_t k = 0; k < low.positions.size(); ++k)
    if (k % 3 != 2) low.positions[k] *= 0.3;
  const Surface surface = together(low, plate(1, 0.1));
  const std::vector<SceneFile> files = {{"low", 0, 4, 0, 1}, {"high", 4, 4, 1, 1}};
  PictureOptions options = small();
  options.files = files;
  // The middle of the upper plate, and a place of it that has nothing behind it.
  const auto contrast = [&](const Image& image) {
    const int x = image.width / 4, y = image.height / 2 + 10;
    int most = 0;
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(image.at(x, y)[c] - image.at(x - 50, y)[c]));
    return most;
  };
  EXPECT_LT(contrast(render_pair(surface, {}, surface, {}, options)), 12);
  options.translucent_from = 1;
  EXPECT_GT(contrast(render_pair(surface, {}, surface, {}, options)), 40);
  // Before, the upper plate has four faces.
  const Surface before = together(low, plate(2, 0.1));
  EXPECT_LT(contrast(render_pair(before, {}, surface, {}, options)), 12);
  const std::vector<SceneFile> files_before = {{"low", 0, 4, 0, 1}, {"high", 4, 9, 1, 4}};
  options.files_before = files_before;
  EXPECT_GT(contrast(render_pair(before, {}, surface, {}, options)), 40);
}

TEST(Picture, both_states_are_seen_by_one_camera) {
  const Surface before = plate(4);
  Surface after = before;
  for (std::size_t k = 0; k < after.positions.size(); k += 3) after.positions[k] += 1.5;
  const Image image = render_pair(before, {}, after, {}, small());
  const auto middle = [&](int from, int to) {
    double sum = 0, n = 0;
    for (int y = 20; y < image.height; ++y)
      for (int x = from; x < to; ++x)
        if (image.at(x, y)[1] < 245) sum += x - from, ++n;
    return sum / n;
  };
  EXPECT_GT(middle(201, 400), middle(0, 200) + 30);
}

TEST(Picture, is_the_same_on_every_call) {
  const Surface surface = plate(20);
  const std::vector<Index> red = {3, 4, 5};
  PictureOptions options = small();
  options.inset = true;
  EXPECT_EQ(render_pair(surface, red, surface, {}, options).pixels,
            render_pair(surface, red, surface, {}, options).pixels);
}

TEST(Picture, magnifies_small_groups_of_red_faces) {
  PictureOptions options = small();
  options.width = 800;
  options.height = 400;
  const Surface surface = plate(80);
  const std::vector<Index> red = {3240, 3241};
  const Image plain = render_surface(surface, red, options);
  options.inset = true;
  const Image with_inset = render_surface(surface, red, options);
  EXPECT_GT(count(with_inset, 0, 800).vivid, 4 * count(plain, 0, 800).vivid);
}

TEST(Picture, magnifies_groups_that_lie_far_apart) {
  PictureOptions options = small();
  options.width = 1000;
  options.height = 300;
  const Surface surface = plate(80);
  const auto vivid = [&](const std::vector<Index>& red) {
    return count(render_surface(surface, red, options), 0, 1000).vivid;
  };
  const std::vector<Index> one = {820, 821}, both = {820, 821, 5580, 5581};
  const std::size_t plain_one = vivid(one), plain_both = vivid(both);
  options.inset = true;
  EXPECT_GT(vivid(both) - plain_both, 3 * (vivid(one) - plain_one) / 2) << "the second group is magnified as well";
}

TEST(Picture, hides_nothing_to_magnify_what_is_seen_well) {
  PictureOptions options = small();
  options.width = options.height = 400;
  const Surface surface = plate(20);
  std::vector<Index> red;
  for (Index f = 0; f < 400; f += 3) red.push_back(f);
  const Image plain = render_surface(surface, red, options);
  options.inset = true;
  EXPECT_EQ(render_surface(surface, red, options).pixels, plain.pixels);
}

TEST(Picture, draws_its_labels) {
  PictureOptions options = small();
  options.before_label = options.after_label = "";
  const Surface surface = plate(4);
  const Image silent = render_pair(surface, {}, surface, {}, options);
  options.before_label = "before 12 pairs";
  const Image labelled = render_pair(surface, {}, surface, {}, options);
  const auto ink = [](const Image& image) {
    std::size_t dark = 0;
    for (int y = 0; y < 18; ++y)
      for (int x = 0; x < image.width; ++x) dark += image.at(x, y)[0] < 120 ? 1 : 0;
    return dark;
  };
  EXPECT_GT(ink(labelled), ink(silent) + 50);
}

TEST(Picture, survives_degenerate_and_empty_surfaces) {
  const Surface empty;
  EXPECT_EQ(count(render_surface(empty, {}, small()), 0, 400, 30).drawn, 0U);
  Surface point{{1, 2, 3, 1, 2, 3, 1, 2, 3}, {0, 1, 2}, {}};
  EXPECT_NO_THROW(render_surface(point, std::vector<Index>{0}, {}));
  Surface line{{0, 0, 0, 1, 1, 1, 2, 2, 2}, {0, 1, 2}, {}};
  EXPECT_NO_THROW(render_surface(line, std::vector<Index>{0}, {}));
  Surface broken = plate(6);
  broken.positions[7] = std::numeric_limits<double>::quiet_NaN();
  broken.positions[30] = std::numeric_limits<double>::infinity();
  EXPECT_GT(count(render_surface(broken, std::vector<Index>{0, 1, 2}, {}), 0, 1600, 60).drawn, 1000U);
}

TEST(Picture, does_not_depend_on_the_size_of_the_surface) {
  const Surface surface = plate(8);
  for (double scale : {1e-9, 1e9}) {
    Surface scaled = surface;
    for (double& c : scaled.positions) c *= scale;
    const Counts a = count(render_surface(surface, std::vector<Index>{9}, small()), 0, 400);
    const Counts b = count(render_surface(scaled, std::vector<Index>{9}, small()), 0, 400);
    EXPECT_NEAR(static_cast<double>(a.drawn), static_cast<double>(b.drawn), 0.02 * static_cast<double>(a.drawn));
    EXPECT_NEAR(static_cast<double>(a.vivid), static_cast<double>(b.vivid), 0.1 * static_cast<double>(a.vivid) + 2);
  }
}

TEST(Picture, refuses_faces_and_sizes_out_of_range) {
  const Surface surface = plate(2);
  EXPECT_THROW(render_surface(surface, std::vector<Index>{4}, small()), std::invalid_argument);
  EXPECT_THROW(render_surface(surface, std::vector<Index>{-1}, small()), std::invalid_argument);
  PictureOptions options = small();
  options.width = 10;
  EXPECT_THROW(render_surface(surface, {}, options), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
