#pragma once

#include <functional>
#include <stdexcept>
#include <vector>

#include "unsnarl/samples.h"

namespace unsnarl {

/// The parameters of one call, checked and complete.
class SampleValues {
 public:
  explicit SampleValues(std::map<std::string, double> values) : values_(std::move(values)) {}
  /// Throws std::out_of_range for a name that the sample does not declare: a mistake of the sample's author.
  double operator[](const std::string& name) const { return values_.at(name); }
  int whole(const std::string& name) const { return static_cast<int>(values_.at(name)); }

 private:
  std::map<std::string, double> values_;
};

/// A sample and what builds it.
struct SampleMaker {
  Sample sample;
  int default_resolution = 40;
  std::function<Surface(int resolution, const SampleValues& values)> make;
};

// One function a family, each in the file of its name.
std::vector<SampleMaker> band_samples();
std::vector<SampleMaker> cylinder_samples();
std::vector<SampleMaker> sheet_samples();
std::vector<SampleMaker> minimal_surface_samples();
std::vector<SampleMaker> projective_plane_samples();  ///< with a disc removed
std::vector<SampleMaker> klein_bottle_samples();      ///< with a disc removed
std::vector<SampleMaker> tube_samples();
std::vector<SampleMaker> closed_surface_samples();
std::vector<SampleMaker> scene_samples();
std::vector<SampleMaker> modelled_samples();  ///< as modellers leave them
std::vector<SampleMaker> regular_map_samples();
std::vector<SampleMaker> obstructed_samples();  ///< not embeddable

}  // namespace unsnarl
