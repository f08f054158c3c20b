#pragma once

#include <algorithm>

namespace unsnarl {

/// Sorts a list, each value once.
template <class List>
void sort_unique(List& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace unsnarl
