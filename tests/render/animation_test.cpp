#include "render/animation.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace unsnarl {
namespace {

/// A grid of n x n triangle pairs over [-1, 1]^2.
Surface triangulated_plate(int n) {
  Surface surface;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      surface.positions.insert(surface.positions.end(), {2.0 * i / n - 1, 2.0 * j / n - 1, 0});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j;
      surface.corners.insert(surface.corners.end(), {a, a + n + 1, a + n + 2, a, a + n + 2, a + 1});
    }
  return surface;
}

/// Its first vertices wander off; some faces are red until the last frame.
std::vector<RecordedFrame> frames_of(std::vector<std::int32_t> red) {
  std::vector<RecordedFrame> frames(5);
  for (int f = 0; f < 5; ++f) {
    RecordedFrame& frame = frames[f];
    frame.phase = f == 0 ? "input" : f == 4 ? "result" : "untangle";
    frame.strategy = f == 0 || f == 4 ? "" : "slide_apart";
    frame.iteration = f;
    if (f < 4) frame.intersecting = red;
    frame.pairs = frame.intersecting.size();
    if (f == 0) continue;
    frame.vertices = {0, 1, 2};
    for (int k = 0; k < 3; ++k) frame.displacements.insert(frame.displacements.end(), {0, 0, 0.1 * f});
  }
  return frames;
}

std::vector<Image> drawn(const Surface& surface, const std::vector<RecordedFrame>& frames,
                         const AnimationOptions& options = {320, 200}) {
  std::vector<Image> images;
  render_animation(surface, frames, options, [&](Image image, double) { images.push_back(std::move(image)); });
  return images;
}

std::size_t red_pixels(const Image& image, int left, int right, int top, int bottom) {
  std::size_t count = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const std::uint8_t* p = image.at(x, y);
      count += p[0] > 110 && p[0] > p[1] + 60 && p[0] > p[2] + 60 ? 1 : 0;
    }
  return count;
}

TEST(Animation, draws_every_frame_with_its_red_faces) {
  std::vector<std::int32_t> red(60);
  std::iota(red.begin(), red.end(), 30);
  const std::vector<Image> images = drawn(triangulated_plate(10), frames_of(red));
  ASSERT_EQ(images.size(), 5u);
  for (const Image& image : images) {
    EXPECT_EQ(image.width, 320);
    EXPECT_EQ(image.height, 200);
  }
  EXPECT_GT(red_pixels(images[0], 0, 320, 30, 180), 500u);
  EXPECT_EQ(red_pixels(images[4], 0, 320, 30, 180), 0u);
  EXPECT_NE(images[1].pixels, images[2].pixels);
}

TEST(Animation, magnifies_small_conflicts_beside_the_whole) {
  // Two faces of 1800: hardly to be seen in the whole, plain in the close-up on the right.
  const std::vector<Image> images = drawn(triangulated_plate(30), frames_of({900, 901}), {400, 240});
  const std::size_t left = red_pixels(images[0], 0, 200, 30, 215), right = red_pixels(images[0], 230, 400, 30, 215);
  EXPECT_LT(left, 200u);
  EXPECT_GT(right, 4 * left);
}

TEST(Animation, nothing_red_is_drawn_as_well) {
  const std::vector<Image> images = drawn(triangulated_plate(4), frames_of({}));
  EXPECT_EQ(images.size(), 5u);
  EXPECT_TRUE(drawn(triangulated_plate(4), {}).empty());
}

TEST(Animation, captions_tell_pairs_that_are_allowed) {
  std::vector<RecordedFrame> frames = frames_of({});
  const std::vector<Image> without = drawn(triangulated_plate(4), frames);
  frames.back().allowed = 3;
  const std::vector<Image> with = drawn(triangulated_plate(4), frames);
  EXPECT_EQ(with.front().pixels, without.front().pixels);
  EXPECT_NE(with.back().pixels, without.back().pixels);
}

TEST(Animation, refuses_what_it_cannot_draw) {
  EXPECT_THROW(drawn(triangulated_plate(4), frames_of({}), {64, 200}), std::invalid_argument);
  EXPECT_THROW(drawn(triangulated_plate(4), frames_of({400})), std::invalid_argument);
  std::vector<RecordedFrame> frames = frames_of({});
  frames[2].vertices[2] = 25;
  EXPECT_THROW(drawn(triangulated_plate(4), frames), std::invalid_argument);
  frames = frames_of({});
  frames[1].displacements.pop_back();
  EXPECT_THROW(drawn(triangulated_plate(4), frames), std::invalid_argument);
}

TEST(Animation, takes_its_time_and_leaves_out_what_cannot_be_seen) {
  std::vector<RecordedFrame> frames = frames_of({3, 4});
  RecordedFrame still = frames[2];
  still.displacements = std::vector<double>(9, 0);
  for (int k = 0; k < 3; ++k) still.displacements[3 * k + 2] = 0.2 + 1e-6;  // where frame 2 is, but for a hair
  for (int k = 0; k < 20; ++k) frames.insert(frames.begin() + 3, still);
  std::vector<double> delays;
  render_animation(triangulated_plate(10), frames, {320, 200},
                   [&](const Image&, double seconds) { delays.push_back(seconds); });
  ASSERT_EQ(delays.size(), 5u);
  EXPECT_GT(delays.back(), delays.front());
  EXPECT_GT(delays.front(), delays[1]);
}

}  // namespace
}  // namespace unsnarl
