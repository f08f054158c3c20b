#include "render/gif.h"

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/palette.h"

namespace unsnarl {
namespace {

/// Colours of the palette, the transparent one among them (fixed by the format)
constexpr int colour_count = 256;
/// The transparent colour, where the frame before shows through (fixed by the format)
constexpr std::uint8_t unchanged = colour_count - 1;

struct PixelRange {
  int left, top, right, bottom;  // right and bottom are outside
};

/// Writes to a string; closes with a clear error.
class GifWriter {
 public:
  GifWriter(int width, int height, const Palette& palette) {
    int error = 0;
    file_ = EGifOpen(&bytes_, append, &error);
    if (!file_) fail(error);
    const std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)> map(GifMakeMapObject(colour_count, nullptr),
                                                                           GifFreeMapObject);
    for (std::size_t c = 0; c < palette.colours().size(); ++c) {
      const auto& [r, g, b] = palette.colours()[c];
      map->Colors[c] = {r, g, b};
    }
    EGifSetGifVersion(file_, true);
    check(EGifPutScreenDesc(file_, width, height, 8, 0, map.get()));
    // Play again and again (the Netscape extension).
    check(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0"));
    check(EGifPutExtensionBlock(file_, 3, "\1\0\0"));
    check(EGifPutExtensionTrailer(file_));
  }
  ~GifWriter() {
    int ignored = 0;
    if (file_) EGifCloseFile(file_, &ignored);
  }
  GifWriter(const GifWriter&) = delete;
  GifWriter& operator=(const GifWriter&) = delete;

  void add(const std::vector<std::uint8_t>& pixels, int width, const PixelRange& part, int delay_hundredths) {
    const GraphicsControlBlock control{DISPOSE_DO_NOT, false, delay_hundredths, unchanged};
    std::array<GifByteType, 4> block{};
    EGifGCBToExtension(&control, block.data());
    check(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, block.size(), block.data()));
    check(EGifPutImageDesc(file_, part.left, part.top, part.right - part.left, part.bottom - part.top, false, nullptr));
    std::vector<GifPixelType> line(static_cast<std::size_t>(part.right - part.left));
    for (int y = part.top; y < part.bottom; ++y) {
      std::copy_n(&pixels[static_cast<std::size_t>(y) * width + part.left], line.size(), line.begin());
      check(EGifPutLine(file_, line.data(), static_cast<int>(line.size())));
    }
  }

  std::string finish() {
    int error = 0;
    if (EGifCloseFile(std::exchange(file_, nullptr), &error) != GIF_OK) fail(error);
    return std::move(bytes_);
  }

 private:
  static int append(GifFileType* file, const GifByteType* data, int size) {
    static_cast<std::string*>(file->UserData)->append(reinterpret_cast<const char*>(data), size);
    return size;
  }
  void check(int result) const {
    if (result != GIF_OK) fail(file_->Error);
  }
  [[noreturn]] static void fail(int error) {
    const char* reason = GifErrorString(error);
    throw std::runtime_error(std::string("giflib could not encode the animation: ") + (reason ? reason : "no reason"));
  }

  std::string bytes_;
  GifFileType* file_ = nullptr;
};

}  // namespace

std::string encode_gif(std::span<const Image> images, std::span<const double> delays_s) {
  if (images.empty()) throw std::invalid_argument("an animation needs an image");
  if (delays_s.size() != images.size()) throw std::invalid_argument("an animation needs one delay for each image");
  const int width = images[0].width, height = images[0].height;
  if (width < 1 || height < 1 || width > 65535 || height > 65535)
    throw std::invalid_argument("a GIF has 1 to 65535 pixels a side");
  for (const Image& image : images)
    if (image.width != width || image.height != height)
      throw std::invalid_argument("the images of an animation must be of one size");

  const Palette palette(images, colour_count - 1);
  GifWriter writer(width, height, palette);
  const std::size_t size = static_cast<std::size_t>(width) * height;
  std::vector<std::uint8_t> shown(size), next(size), difference(size);
  for (std::size_t f = 0; f < images.size(); ++f) {
    for (std::size_t i = 0; i < size; ++i) next[i] = palette.nearest(&images[f].pixels[3 * i]);
    PixelRange part{width, height, 0, 0};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * width + x;
        const bool differs = f == 0 || next[i] != shown[i];
        difference[i] = differs ? next[i] : unchanged;
        if (!differs) continue;
        part = {std::min(part.left, x), std::min(part.top, y), std::max(part.right, x + 1),
                std::max(part.bottom, y + 1)};
      }
    if (part.right == 0) part = {0, 0, 1, 1};  // an image needs a pixel
    writer.add(difference, width, part, static_cast<int>(std::lround(100 * delays_s[f])));
    shown.swap(next);
  }
  return writer.finish();
}

}  // namespace unsnarl
