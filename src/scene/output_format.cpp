#include "scene/output_format.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/areas.h"

namespace unsnarl {
namespace {

/// Gap wanted between surfaces. Rounding moves each of the two by half a unit in every coordinate, less than two units
/// of distance; the rest is reserve (unit: units in the last place of the format)
constexpr double gap_units = 8;
/// Rounding makes a gap narrower by this at most (unit: units in the last place of the format)
constexpr double rounding_units = 2;
/// float32 is asked for only where the gap that it needs is at most this, so that its coordinates are fine enough for
/// the faces (unit: mean altitude of the faces)
constexpr double largest_gap_of_altitude = 0.02;

/// Distance between neighbouring float32 numbers at the largest coordinate; infinite beyond float32.
double float32_unit(double largest_coordinate, const Scale& scale) {
  if (largest_coordinate > scale.in(std::numeric_limits<float>::max())) return std::numeric_limits<double>::infinity();
  return std::max<double>(largest_coordinate * 0x1p-23, scale.in(std::numeric_limits<float>::denorm_min()));
}
double float64_unit(double largest_coordinate, const Scale& scale) {
  return std::max(largest_coordinate * 0x1p-52, scale.in(std::numeric_limits<double>::denorm_min()));
}

}  // namespace

bool fits_float32(const Positions& x, const Scale& scale) {
  return x.size() == 0 || x.cwiseAbs().maxCoeff() <= scale.in(std::numeric_limits<float>::max());
}

Positions rounded_to_float32(const Positions& x, const Scale& scale) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (scale.is_one()) return x.cwiseMax(-largest).cwiseMin(largest).cast<float>().cast<double>();
  return x.unaryExpr(
      [&](double number) { return scale.in(static_cast<float>(std::clamp(scale.out(number), -largest, largest))); });
}

void round_changed_to_float32(std::span<const double> input, std::span<double> numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (numbers[k] != input[k]) numbers[k] = static_cast<double>(static_cast<float>(numbers[k]));
}

double gap_of_format(const Scene& scene, std::span<const Index> vertices, bool float32, const Scale& scale) {
  double largest = 0;
  for (Index v : vertices) largest = std::max(largest, scene.rest.col(v).cwiseAbs().maxCoeff());
  return gap_units * (float32 ? float32_unit(largest, scale) : float64_unit(largest, scale));
}

bool float32_can_hold(const Scene& scene, std::span<const IntersectingPair> pairs, const Scale& scale) {
  std::vector<Triangle> conflict;
  double largest = 0;
  for (const IntersectingPair& pair : pairs)
    for (Index t : {pair.a, pair.b}) {
      conflict.push_back(scene.triangles[t]);
      for (Index v : conflict.back()) largest = std::max(largest, scene.rest.col(v).cwiseAbs().maxCoeff());
    }
  const double unit = float32_unit(largest, scale);
  return std::isfinite(unit) && gap_units * unit <= largest_gap_of_altitude * mean_least_altitude(scene.rest, conflict);
}

OutputFormat::OutputFormat(const SurfaceView& surface, const PreparedSurface& prepared, const RepairOptions& options)
    : surface_(surface),
      prepared_(&prepared),
      options_(&options),
      is_optional_(!options.precision),
      least_gap_(options.min_gap_rel * prepared.diagonal_of(surface.positions)) {}

void OutputFormat::choose(const Scene& scene, std::span<const IntersectingPair> pairs) {
  const Scale& scale = prepared_->scale;
  if (!is_optional_) {
    float32_ = options_->precision == Precision::float32 && fits_float32(scene.rest, scale);
    return;
  }
  std::map<Index, std::vector<IntersectingPair>> of_group;
  for (const IntersectingPair& pair : pairs)
    of_group[scene.group_of.empty() ? 0 : scene.group_of[scene.triangles[pair.a][0]]].push_back(pair);
  float32_ = std::all_of(of_group.begin(), of_group.end(),
                         [&](const auto& group) { return float32_can_hold(scene, group.second, scale); });
}

std::vector<double> OutputFormat::written(const Positions& x) const {
  std::vector<double> positions = prepared_->scatter(surface_.positions, x);
  if (options_->as_written) return options_->as_written(positions, float32_);
  if (float32_) round_changed_to_float32(surface_.positions, positions);
  return positions;
}

Positions OutputFormat::as_written(const Positions& x) const {
  // Scaling back to the file's numbers is exact unless they become subnormal; a scale of one changes nothing.
  const bool is_exact = !options_->as_written && !float32_ && prepared_->scale.is_one();
  return is_exact ? x : prepared_->gather(written(x));
}

double OutputFormat::wanted_gap(const Scene& scene, std::span<const Index> vertices) const {
  const double least = gap_of_format(scene, vertices, float32_, prepared_->scale);
  if (options_->gap_near_conflicts || !(least_gap_ > 0)) return std::max(least, least_gap_);
  return std::max(least, least_gap_ + rounding_units / gap_units * least);
}

}  // namespace unsnarl
