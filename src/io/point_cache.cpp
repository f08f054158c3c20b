#include "unsnarl/point_cache.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "io/byte_order.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

constexpr std::string_view pc2_signature("POINTCACHE2\0", 12);
/// Size of the header of a PC2 file (fixed by the format, in bytes)
constexpr std::size_t pc2_header = 32;
/// Size of the header of an MDD file, before its times (fixed by the format, in bytes)
constexpr std::size_t mdd_header = 8;
/// Version of the format that PC2 files name (fixed by the format)
constexpr std::uint32_t pc2_version = 1;

std::endian order_of(PointCacheFormat format) {
  return format == PointCacheFormat::pc2 ? std::endian::little : std::endian::big;
}

std::uint32_t word_at(const std::string& bytes, std::size_t at, PointCacheFormat format) {
  return load<std::uint32_t>(&bytes[at], order_of(format));
}

float float_at(const std::string& bytes, std::size_t at, PointCacheFormat format) {
  return load<float>(&bytes[at], order_of(format));
}

float as_float(double x, std::size_t point) {
  const auto narrow = static_cast<float>(x);
  if (!std::isfinite(narrow))
    throw WriteError(fmt::format("point {} moves to {}, which is beyond 32-bit numbers", point, x));
  return narrow;
}

}  // namespace

std::optional<PointCacheFormat> point_cache_format(std::string_view path) {
  std::string extension(path.substr(path.find_last_of("./\\") + 1));
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (extension == "pc2") return PointCacheFormat::pc2;
  if (extension == "mdd") return PointCacheFormat::mdd;
  return {};
}

PointCache PointCache::parse(std::string bytes, PointCacheFormat format) {
  PointCache cache(std::move(bytes), format);
  const std::string& b = cache.bytes_;
  const bool is_pc2 = format == PointCacheFormat::pc2;
  if (b.size() < (is_pc2 ? pc2_header : mdd_header))
    throw FileError(fmt::format("byte {}: the file ends within its header", b.size()));
  if (is_pc2) {
    if (std::string_view(b).substr(0, pc2_signature.size()) != pc2_signature)
      throw FileError("byte 0: a PC2 file begins with POINTCACHE2; is this another format?");
    if (const std::uint32_t version = word_at(b, 12, format); version != pc2_version)
      throw FileError(fmt::format("byte 12: version {} of PC2; only {} can be read", version, pc2_version));
  }
  cache.points_ = word_at(b, is_pc2 ? 16 : 4, format);
  cache.frames_ = word_at(b, is_pc2 ? 28 : 0, format);
  if (cache.points_ == 0 || cache.frames_ == 0)
    throw FileError(fmt::format("the header says {} points in {} frames; there is nothing to repair", cache.points_,
                                cache.frames_));
  // Both are below 2^32, so that the products stay below 2^68: they are compared by division.
  const std::size_t rest = b.size() - (is_pc2 ? pc2_header : mdd_header);
  const std::size_t of_frame = 3 * sizeof(float) * cache.points_ + (is_pc2 ? 0 : sizeof(float));
  if (rest / of_frame != cache.frames_ || rest % of_frame != 0)
    throw FileError(fmt::format("the header says {} points in {} frames, but {} bytes follow; is the file cut off?",
                                cache.points_, cache.frames_, rest));
  cache.header_ = is_pc2 ? pc2_header : mdd_header + sizeof(float) * cache.frames_;
  for (std::size_t at = cache.header_; at < b.size(); at += sizeof(float))
    if (!std::isfinite(float_at(b, at, format))) {
      const std::size_t point = (at - cache.header_) / (3 * sizeof(float));
      throw FileError(
          fmt::format("byte {}: point {} of frame {} is not finite", at, point % cache.points_, point / cache.points_));
    }
  return cache;
}

std::vector<double> PointCache::positions(std::size_t frame) const {
  std::vector<double> result(3 * points_);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = float_at(bytes_, begin_of(frame) + sizeof(float) * i, format_);
  return result;
}

std::string_view PointCache::frame_bytes(std::size_t frame) const {
  return std::string_view(bytes_).substr(begin_of(frame), frame_size());
}

std::vector<double> PointCache::as_written(std::span<const double> positions) const {
  std::vector<double> result;
  result.reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) result.push_back(as_float(positions[i], i / 3));
  return result;
}

void PointCache::set_positions(std::size_t frame, std::span<const double> positions) {
  if (positions.size() != 3 * points_ || frame >= frames_)
    throw std::invalid_argument(
        fmt::format("{} coordinates for frame {} of a cache of {} points", positions.size(), frame, points_));
  for (const double x : positions) static_cast<void>(as_float(x, 0));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto x = static_cast<float>(positions[i]);
    const std::size_t at = begin_of(frame) + sizeof(float) * i;
    // What is equal keeps its bytes: -0 equals 0.
    if (x != float_at(bytes_, at, format_)) store(&bytes_[at], x, order_of(format_));
  }
}

}  // namespace unsnarl
