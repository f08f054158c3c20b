#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace unsnarl {

enum class PointCacheFormat : std::uint8_t { pc2, mdd };
/// By the extension of a path, whatever its case.
std::optional<PointCacheFormat> point_cache_format(std::string_view path);

/// A point cache with its bytes: 32-bit positions of so many points in so many frames. Positions can be replaced, all
/// other bytes stay.
///
/// PC2 (J. Burnett, PointCache2 for 3ds Max): "POINTCACHE2\0", version 1, points, first frame, sample rate, frames;
/// little-endian. MDD (NewTek Motion Designer): frames, points, the time of each frame; big-endian.
class PointCache {
 public:
  /// Throws FileError (document.h) where the header is not valid, the size is not what it says or a coordinate is not
  /// finite.
  static PointCache parse(std::string bytes, PointCacheFormat format);

  std::size_t frames() const { return frames_; }
  std::size_t points() const { return points_; }
  /// 3 doubles a point. \pre frame < frames()
  std::vector<double> positions(std::size_t frame) const;
  /// The bytes of a frame.
  std::string_view frame_bytes(std::size_t frame) const;
  /// The positions that reading set_positions() back gives. Throws WriteError for what is beyond 32-bit floats.
  std::vector<double> as_written(std::span<const double> positions) const;
  /// Throws as as_written() does, and std::invalid_argument for another number of points.
  void set_positions(std::size_t frame, std::span<const double> positions);
  const std::string& bytes() const { return bytes_; }

 private:
  PointCache(std::string bytes, PointCacheFormat format) : bytes_(std::move(bytes)), format_(format) {}
  std::size_t begin_of(std::size_t frame) const { return header_ + frame * frame_size(); }
  std::size_t frame_size() const { return 3 * sizeof(float) * points_; }

  std::string bytes_;
  PointCacheFormat format_;
  std::size_t header_ = 0, frames_ = 0, points_ = 0;
};

}  // namespace unsnarl
