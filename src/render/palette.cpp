#include "render/palette.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace unsnarl {
namespace {

using Colour = std::array<double, 3>;

/// Pixels of nearly the same colour.
struct Bin {
  std::size_t id = 0;
  double pixels = 0;
  Colour mean{};
};

double squared_distance(const Colour& a, const Colour& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// Consecutive bins that share one colour of the palette.
struct Cluster {
  std::size_t begin = 0, end = 0;
  Colour mean{};
  std::size_t widest = 0;  ///< channel of the largest variance
  double spread = 0;       ///< pixels times that variance

  Cluster(std::span<const Bin> bins, std::size_t first, std::size_t last) : begin(first), end(last) {
    double pixels = 0;
    Colour squares{};
    for (const Bin& bin : bins.subspan(begin, end - begin)) {
      pixels += bin.pixels;
      for (std::size_t k = 0; k < 3; ++k) mean[k] += bin.pixels * bin.mean[k];
    }
    for (double& value : mean) value /= pixels;
    for (const Bin& bin : bins.subspan(begin, end - begin))
      for (std::size_t k = 0; k < 3; ++k) squares[k] += bin.pixels * (bin.mean[k] - mean[k]) * (bin.mean[k] - mean[k]);
    widest = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
    spread = squares[widest];
  }
};

}  // namespace

Palette::Palette(std::span<const Image> images, int size) {
  if (size < 2 || size > 256) throw std::invalid_argument("a palette has 2 to 256 colours");
  std::vector<Bin> histogram(std::size_t{1} << (3 * bits));
  for (const Image& image : images)
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      const std::uint8_t* pixel = &image.pixels[i];
      Bin& bin = histogram[bin_of(pixel)];
      ++bin.pixels;
      for (std::size_t k = 0; k < 3; ++k) bin.mean[k] += pixel[k];
    }
  std::vector<Bin> bins;
  for (std::size_t id = 0; id < histogram.size(); ++id) {
    Bin& bin = histogram[id];
    if (bin.pixels == 0) continue;
    bin.id = id;
    for (double& value : bin.mean) value /= bin.pixels;
    // Large even areas would take all colours from small ones.
    bin.pixels = std::sqrt(bin.pixels);
    bins.push_back(bin);
  }

  colours_.push_back({255, 255, 255});
  std::vector<Cluster> clusters;
  if (!bins.empty()) clusters.emplace_back(bins, 0, bins.size());
  while (!clusters.empty() && clusters.size() + 1 < static_cast<std::size_t>(size)) {
    const auto worst = std::max_element(clusters.begin(), clusters.end(),
                                        [](const Cluster& a, const Cluster& b) { return a.spread < b.spread; });
    if (!(worst->spread > 0)) break;
    const Cluster whole = *worst;
    const auto first = bins.begin() + static_cast<std::ptrdiff_t>(whole.begin);
    const auto last = bins.begin() + static_cast<std::ptrdiff_t>(whole.end);
    const auto cut = std::stable_partition(
        first, last, [&](const Bin& bin) { return bin.mean[whole.widest] < whole.mean[whole.widest]; });
    const auto middle = static_cast<std::size_t>(cut - bins.begin());
    if (middle == whole.begin || middle == whole.end) break;  // equal but for round-off
    *worst = Cluster(bins, whole.begin, middle);
    clusters.emplace_back(bins, middle, whole.end);
  }
  for (const Cluster& cluster : clusters) {
    std::array<std::uint8_t, 3> colour;
    for (std::size_t k = 0; k < 3; ++k) colour[k] = static_cast<std::uint8_t>(std::lround(cluster.mean[k]));
    colours_.push_back(colour);
  }

  nearest_.assign(histogram.size(), 0);
  for (const Bin& bin : bins) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < colours_.size(); ++c) {
      const auto& [r, g, b] = colours_[c];
      const double distance = squared_distance(bin.mean, {double(r), double(g), double(b)});
      if (distance >= least) continue;
      least = distance;
      nearest_[bin.id] = static_cast<std::uint8_t>(c);
    }
  }
}

}  // namespace unsnarl
