#include "unsnarl/pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "render/picture.h"
#include "render/png.h"

namespace unsnarl {
namespace {

const Surface triangle = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, {}};
const std::vector<std::int32_t> red = {0};
const PictureOptions thumbnail = {.width = 128, .height = 64};

std::vector<RecordedFrame> two_frames() {
  std::vector<RecordedFrame> frames(2);
  frames[0].phase = "input";
  frames[1].phase = "result";
  frames[1].vertices = {1};
  frames[1].displacements = {0.5, 0, 0};
  return frames;
}

TEST(Pictures, pngs_are_those_of_the_pixels) {
  EXPECT_EQ(picture_png(triangle, red, triangle, {}, thumbnail),
            encode_png(render_pair(triangle, red, triangle, {}, thumbnail)));
  EXPECT_EQ(picture_png(triangle, red, thumbnail), encode_png(render_surface(triangle, red, thumbnail)));
  EXPECT_THROW(picture_png(triangle, std::vector<std::int32_t>{1}, thumbnail), std::invalid_argument);
}

TEST(Pictures, animation_as_gif_and_as_pngs) {
  const AnimationOptions options = {.width = 160, .height = 128};
  EXPECT_EQ(animation_gif(triangle, two_frames(), options).substr(0, 6), "GIF89a");
  std::vector<std::string> pngs;
  animation_pngs(triangle, two_frames(), options, [&](std::string png) { pngs.push_back(std::move(png)); });
  ASSERT_EQ(pngs.size(), 2u);
  for (const std::string& png : pngs) EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_NE(pngs[0], pngs[1]);
}

TEST(Pictures, are_the_same_at_any_power_of_two) {
  const auto scaled = [](std::vector<double> numbers, int exponent) {
    for (double& x : numbers) x = std::ldexp(x, exponent);
    return numbers;
  };
  const AnimationOptions options = {.width = 160, .height = 128};
  for (const int exponent : {-900, -300, 300, 900}) {
    const Surface other = {scaled(triangle.positions, exponent), triangle.corners, {}};
    EXPECT_EQ(picture_png(other, red, other, {}, thumbnail), picture_png(triangle, red, triangle, {}, thumbnail));
    EXPECT_EQ(picture_png(other, red, thumbnail), picture_png(triangle, red, thumbnail));
    std::vector<RecordedFrame> frames = two_frames();
    frames[1].displacements = scaled(frames[1].displacements, exponent);
    EXPECT_EQ(animation_gif(other, frames, options), animation_gif(triangle, two_frames(), options));
  }
}

TEST(Pictures, no_frames) {
  EXPECT_THROW(animation_gif(triangle, {}), std::invalid_argument);
  animation_pngs(triangle, {}, {}, [](const std::string&) { FAIL(); });
}

}  // namespace
}  // namespace unsnarl
