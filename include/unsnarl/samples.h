#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/surface.h"

namespace unsnarl {

/// A number that shapes a sample. Values outside [minimum, maximum] are refused.
struct SampleParameter {
  std::string name;
  double value = 0;  ///< the default
  double minimum = 0, maximum = 0;
  std::string description;  ///< with its unit
  bool whole = false;       ///< only whole numbers
};

/// A generator of a surface that runs through itself.
struct Sample {
  std::string name;
  std::string description;  ///< one line
  std::vector<SampleParameter> parameters;
  /// False: no motion of the vertices can embed it (closed and non-orientable), so that repair has to refuse.
  bool embeddable = true;
  /// Names of the components in the order of their first faces, the last for all further ones; empty: no names.
  std::vector<std::string> groups = {};
};

/// All samples in a fixed order: the first `analytic_sample_count` are given by formulas (the data set that appendix A
/// of Minarčík, Liu, Crane, Li: "Untangling Surfaces via Shape and Mesh Repulsion" asks for), then shapes as modellers
/// leave them, then regular maps, then obstructions.
std::span<const Sample> all_samples();
inline constexpr std::size_t analytic_sample_count = 30;

/// resolution: sampling steps along the longest direction of the surface's parameter domain, [8, 2000]; 0: the sample's
/// own, which gives 1,000 to 5,000 faces. Regular maps are the same at any. y points up. Parts of a sample meet by
/// index, without duplicated vertices; the result is the same on every run. Throws std::invalid_argument, naming the
/// valid choices, for an unknown sample or parameter or a value out of range.
Surface make_sample(std::string_view name, int resolution = 0, const std::map<std::string, double>& parameters = {});

}  // namespace unsnarl
