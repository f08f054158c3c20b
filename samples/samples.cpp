#include "unsnarl/samples.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "samples/sample_maker.h"

namespace unsnarl {
namespace {

constexpr int least_resolution = 8, greatest_resolution = 2000;

const std::vector<SampleMaker>& makers() {
  static const std::vector<SampleMaker> all = [] {
    std::vector<SampleMaker> list;
    for (auto family : {band_samples, cylinder_samples, sheet_samples, minimal_surface_samples,
                        projective_plane_samples, klein_bottle_samples, tube_samples, closed_surface_samples,
                        scene_samples, modelled_samples, regular_map_samples, obstructed_samples})
      for (SampleMaker& maker : family()) list.push_back(std::move(maker));
    return list;
  }();
  return all;
}

const SampleMaker& maker_named(std::string_view name) {
  const auto found = std::find_if(makers().begin(), makers().end(),
                                  [&](const SampleMaker& maker) { return maker.sample.name == name; });
  if (found != makers().end()) return *found;
  std::vector<std::string> names;
  for (const SampleMaker& maker : makers()) names.push_back(maker.sample.name);
  throw std::invalid_argument(
      fmt::format("no sample is called \"{}\"; choose one of: {}", name, fmt::join(names, ", ")));
}

SampleValues checked_values(const Sample& sample, const std::map<std::string, double>& given) {
  std::map<std::string, double> values;
  std::vector<std::string> names;
  for (const SampleParameter& parameter : sample.parameters) {
    values[parameter.name] = parameter.value;
    names.push_back(parameter.name);
  }
  for (const auto& [name, value] : given) {
    const auto parameter = std::find_if(sample.parameters.begin(), sample.parameters.end(),
                                        [&wanted = name](const SampleParameter& p) { return p.name == wanted; });
    if (parameter == sample.parameters.end())
      throw std::invalid_argument(
          names.empty() ? fmt::format("sample {} has no parameters, so \"{}\" cannot be set", sample.name, name)
                        : fmt::format("sample {} has no parameter \"{}\"; it has: {}", sample.name, name,
                                      fmt::join(names, ", ")));
    if (!(value >= parameter->minimum && value <= parameter->maximum))
      throw std::invalid_argument(fmt::format("parameter {} of sample {} is {}; give a value from {} to {}", name,
                                              sample.name, value, parameter->minimum, parameter->maximum));
    if (parameter->whole && value != std::floor(value))
      throw std::invalid_argument(
          fmt::format("parameter {} of sample {} is {}; give a whole number", name, sample.name, value));
    values[name] = value;
  }
  return SampleValues(std::move(values));
}

}  // namespace

std::span<const Sample> all_samples() {
  static const std::vector<Sample> samples = [] {
    std::vector<Sample> list;
    for (const SampleMaker& maker : makers()) list.push_back(maker.sample);
    return list;
  }();
  return samples;
}

Surface make_sample(std::string_view name, int resolution, const std::map<std::string, double>& parameters) {
  const SampleMaker& maker = maker_named(name);
  if (resolution != 0 && (resolution < least_resolution || resolution > greatest_resolution))
    throw std::invalid_argument(
        fmt::format("resolution is {}; give a value from {} to {}, or 0 for the sample's own ({})", resolution,
                    least_resolution, greatest_resolution, maker.default_resolution));
  return maker.make(resolution == 0 ? maker.default_resolution : resolution, checked_values(maker.sample, parameters));
}

}  // namespace unsnarl
