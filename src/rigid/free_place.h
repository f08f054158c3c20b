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

// Search for the nearest place where a body, or a component that may also shrink, intersects nothing.

/// A one-parameter family of motions; at 0 nothing moves.
struct MotionFamily {
  double span = 0;  ///< the first try is a share of this, so that families with equal spans are tried at equal steps
  double last = 0;  ///< largest parameter
  double rate = 1;  ///< root mean square of the displacement of the vertices / parameter, a length
};

struct FreePlace {
  std::size_t family = 0;
  double parameter = 0;
};

struct FreePlaceConstants {
  /// Parameter of the first try (unit: share of MotionFamily::span)
  static constexpr double first_step = 1e-3;
  /// The parameter grows by this factor from one try to the next (no unit)
  static constexpr double growth = 1.6;
  /// Bisections between the last try that is not free and the first that is (unit: bisections)
  static constexpr int bisections = 6;
  /// About this many contacts, at most, whose normals are tried as directions (unit: contacts)
  static constexpr std::size_t most_contacts = 16;
};

struct PlaceSearch {
  /// Clearance: a motion goes beyond the first free place by this share of itself if it is free there (no unit)
  double margin = 0;
  /// A family is also tried at the first step beyond the best place so far: its first free place may lie before that
  /// step. [E206]
  bool is_thorough = false;
  std::function<bool()> stop = {};  ///< true ends the search with the best place so far
};

/// Of the first free place in each family, the one with the least root mean square displacement; nothing if no family
/// has one. `is_free(family, parameter)`: called in any order.
template <class IsFree>
std::optional<FreePlace> nearest_free_place(std::span<const MotionFamily> families, IsFree&& is_free,
                                            const PlaceSearch& search) {
  using C = FreePlaceConstants;
  std::optional<FreePlace> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < families.size() && !(search.stop && search.stop()); ++k) {
    const MotionFamily& family = families[k];
    if (!(family.rate > 0)) continue;
    double blocked = 0, parameter = C::first_step * family.span;
    bool found = false;
    while ((search.is_thorough ? blocked : parameter) * family.rate < least) {
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
    const double beyond = (1 + search.margin) * parameter;
    best = FreePlace{k, is_free(k, beyond) ? beyond : parameter};
  }
  return best;
}

/// The directions to the 26 neighbours of a cell, one of every two opposite ones; not normalised.
std::vector<Vec3> lattice_directions();

/// Pairs spread evenly over the list, at most about FreePlaceConstants::most_contacts.
std::vector<IntersectingPair> some_contacts(std::span<const IntersectingPair> contacts);

}  // namespace unsnarl
