#pragma once

#include <array>
#include <string_view>

#include "unsnarl/intersections.h"

namespace unsnarl::app {

/// Words of the summaries for the faces of a pair of each class. ("116 disjoint" alone would sound like pairs that do
/// not intersect.)
inline constexpr std::array<std::string_view, pair_class_count> pair_class_words = {
    "sharing no vertex", "sharing a vertex", "folded along an edge", "on the same vertices", "of a face without area"};
static_assert(!pair_class_words.back().empty(), "every PairClass has its words");

}  // namespace unsnarl::app
