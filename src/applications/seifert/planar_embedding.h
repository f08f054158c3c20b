#pragma once

#include <array>
#include <optional>
#include <vector>

namespace unsnarl {

/// The faces of a drawing in the plane: cycles of nodes, each edge once in either direction. Nothing for a graph that
/// has none. The graph is simple and stays connected without any one node; `cycle`: nodes of it, each joined to the
/// next. By G. Demoucron, Y. Malgrange, R. Pertuiset, "Graphes planaires", 1964: what is not drawn yet falls into
/// pieces; a path of the piece that fits into the fewest faces is drawn next.
std::optional<std::vector<std::vector<int>>> planar_faces(int nodes, const std::vector<std::array<int, 2>>& edges,
                                                          const std::vector<int>& cycle);

}  // namespace unsnarl
