#pragma once

#include <cstdint>

#include "untangle/strategy.h"

namespace unsnarl {

/// Moves the free vertices of a small patch one by one, at random, by simulated annealing of the number of intersecting
/// pairs (Kirkpatrick, Gelatt, Vecchi: Optimization by Simulated Annealing, 1983); of the positions without pairs that
/// it comes to, it goes on from the first back towards rest, as far as none returns. Leaves patch.x alone where it does
/// not find fewer pairs. The same for the same patch. Returns the number of moves tried.
int search_freely(Patch& patch, const Task& task);

/// The strategy: search_freely() for whole components, or rings around a conflict, of few faces.
Strategy free_search();

}  // namespace unsnarl
