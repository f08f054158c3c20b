#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

// The search for the nearest place at which a body, or a component that may shrink too, intersects nothing.

/// A one-parameter family of motions; at 0 nothing moves.
struct MotionFamily {
  double last = 0;  ///< largest parameter
  double rate = 1;  ///< root mean square of the displacement of the vertices / parameter, a length
};

struct FreePlace {
  std::size_t family = 0;
  double parameter = 0;
};

struct FreePlaceConstants {
  /// Share of MotionFamily::last of the first try.
  static constexpr double first_step = 1e-3;
  /// Ratio of the parameters of a try and of the one before.
  static constexpr double growth = 1.6;
  /// Bisections between the last try that is not free and the first that is.
  static constexpr int bisections = 6;
  /// Number of contacts whose normals are tried as directions, at most about.
  static constexpr std::size_t most_contacts = 16;
};

/// The free place that is reached with the least root mean square of the displacement, of the first ones in each
/// family; none: there is none. `is_free(family, parameter)`: asked in any order.
/// `margin`: clearance; a motion goes on beyond the first free place by this share of itself, if it is free there too.
/// `stop`: true: leave it at what was found; may be empty.
template <class IsFree>
std::optional<FreePlace> nearest_free_place(std::span<const MotionFamily> families, IsFree&& is_free, double margin,
                                            const std::function<bool()>& stop) {
  using C = FreePlaceConstants;
  std::optional<FreePlace> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < families.size() && !(stop && stop()); ++k) {
    const MotionFamily& family = families[k];
    if (!(family.rate > 0)) continue;
    double blocked = 0, parameter = C::first_step * family.last;
    bool found = false;
    while (parameter * family.rate < least) {
      found = is_free(k, parameter);
      if (found || parameter == family.last) break;
      blocked = parameter;
      parameter = std::min(C::growth * parameter, family.last);
    }
    if (!found) continue;
    for (int i = 0; i < C::bisections; ++i) {
      const double middle = 0.5 * (blocked + parameter);
      (is_free(k, middle) ? parameter : blocked) = middle;
    }
    if (!(parameter * family.rate < least)) continue;
    least = parameter * family.rate;
    const double beyond = (1 + margin) * parameter;
    best = FreePlace{k, is_free(k, beyond) ? beyond : parameter};
  }
  return best;
}

/// One of every two opposite directions to the 26 neighbours of a cell; not normalised.
std::vector<Vec3> lattice_directions();

/// Pairs spread over the list, about FreePlaceConstants::most_contacts of them at most.
std::vector<IntersectingPair> some_contacts(std::span<const IntersectingPair> contacts);

}  // namespace unsnarl
