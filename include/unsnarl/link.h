#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace unsnarl {

/// Closed polygons in space: a knot, or several. The order of the points is the orientation.
struct Link {
  /// 3 n doubles each, x y z of point 0, then of point 1, ...; n >= 3. The last point is joined to the first, which is
  /// not repeated.
  std::vector<std::vector<double>> components;

  std::size_t point_count() const;
};

/// Reads a link. In which of these ways its text is, it tells by itself; '#' starts a comment.
///
/// - Points: "x y z", one a line; an empty line ends a component. A last point that repeats the first is left out.
/// - Planar diagram code: "PD[X[1,4,2,5], X[3,6,4,1], X[5,2,6,3]]" or just the numbers in brackets: for each crossing
///   the four edges around it, counter-clockwise from the one that arrives below. Edges are numbered from 1 along the
///   components, or from 0.
/// - Dowker-Thistlethwaite code: "DT[4,6,2]", "[4, 6, 2]", "DT[bca]".
/// - Gauss code: "{-1, 2, -3, 1, -2, 3}", numbers above 0 where the strand is above; "O1-U2-O3-U1-O2-U3-" with signs.
/// - Braid word: "braid 3: 1 -2 1 -2", the number of strands and the generators, or "BR[3,{1,-2,1,-2}]", "{1,-2,1,-2}";
///   the link is its closure.
/// Codes that a diagram shares with its mirror image are drawn with the first crossing right-handed. docs/seifert.md
/// has all variants.
///
/// Codes and words are laid out in space: units of length are theirs.
/// Throws FileError, which names the line, or the crossing, and what to do.
Link parse_link(std::string_view text);

/// As parse_link reads it: points, with the fewest digits that give the doubles back.
std::string link_text(const Link& link);

/// Throws std::invalid_argument, naming component and point, for what no Seifert surface can be made of: no component,
/// one with fewer than three points, coordinates that are not finite or beyond 1e70, edges without length, edges that
/// touch or cross.
void check_link(const Link& link);

/// A knot or link of a table, laid out in space from a braid that it is the closure of.
struct KnotEntry {
  std::string name;        ///< "3_1" to "10_165" as in Rolfsen's table; "hopf", "borromean", ...
  int strands = 0;         ///< of the braid
  std::vector<int> braid;  ///< generators: i > 0 crosses the strands i and i + 1, -i the other way
  int determinant = 0;     ///< of the link, as tables give it
  int reversed = -1;       ///< the component that runs against the braid; -1: none
};
/// All knots to ten crossings (Rolfsen's table without the duplicate of Perko's pair), then links and others.
std::span<const KnotEntry> knot_table();
/// Diagrams of the unknot: a circle, some that are wound up, and those of the literature that are hard to untangle.
struct UnknotEntry {
  std::string_view name;  ///< "circle", "kinks_1" to "kinks_6", "goeritz", "ochiai", ...
  std::string_view description;
};
std::span<const UnknotEntry> unknot_table();
/// None where there is none of this name.
std::optional<Link> unknot_of_table(std::string_view name);

/// The knot or unknot that has this name in its table. Throws std::invalid_argument for a name that is in neither.
Link knot_of_table(std::string_view name);

/// The closure of a braid as polygons around the z axis: strands run counter-clockwise at distances 1, 1.5, ... from
/// it, the outer ones lower. points: of one strand between two columns of crossings, [2, 1000].
/// Throws std::invalid_argument for strands < 1 or a generator out of range.
Link braid_closure(int strands, std::span<const int> braid, int points = 8);

}  // namespace unsnarl
