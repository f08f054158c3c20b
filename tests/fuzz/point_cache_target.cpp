#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/promise.h"
#include "fuzz/targets.h"
#include "unsnarl/document.h"
#include "unsnarl/point_cache.h"

namespace unsnarl::fuzz {
namespace {

std::optional<PointCache> parsed(const std::string& bytes, PointCacheFormat format) {
  try {
    return PointCache::parse(bytes, format);
  } catch (const FileError& refusal) {
    promise(refusal.what()[0] != '\0', "a refusal has a reason");
    return std::nullopt;
  }
}

void point_cache(Bytes given, PointCacheFormat format) {
  const std::string bytes(given.begin(), given.end());
  std::optional<PointCache> cache = parsed(bytes, format);
  if (!cache) return;
  promise(cache->frames() > 0 && cache->points() > 0, "a cache that is read holds something");
  for (std::size_t frame = 0; frame < cache->frames(); ++frame) {
    std::vector<double> positions = cache->positions(frame);
    promise(positions.size() == 3 * cache->points(), "a frame has all points");
    for (const double x : positions) promise(std::isfinite(x), "positions are finite");
    promise(cache->as_written(positions) == positions, "what is read is written alike");
    cache->set_positions(frame, positions);
    promise(cache->bytes() == bytes, "without motion every byte stays");
  }
  std::vector<double> moved = cache->positions(0);
  double& x = moved[moved.size() / 2];
  x = x == 1 ? 2 : 1;
  cache->set_positions(0, moved);
  const std::optional<PointCache> again = parsed(cache->bytes(), format);
  promise(again.has_value(), "what was written can be read");
  promise(again->positions(0) == moved, "what was written is read back");
  std::size_t different = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) different += bytes[k] != cache->bytes()[k];
  promise(different >= 1 && different <= 4, "other bytes stay");
}

}  // namespace

void pc2(Bytes bytes) {
  point_cache(bytes, PointCacheFormat::pc2);
}
void mdd(Bytes bytes) {
  point_cache(bytes, PointCacheFormat::mdd);
}

}  // namespace unsnarl::fuzz
