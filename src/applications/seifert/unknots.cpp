#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "geometry/portable_math.h"
#include "unsnarl/link.h"

namespace unsnarl {
namespace {

constexpr int circle_points = 100;  ///< Points of the plain circle (unit: points)

/// Planar diagram codes of unknots that no Reidemeister moves untangle without more crossings on the way, or few do.
/// All from the Gauss codes in appendix A of B. Burton et al., "Hard diagrams of the unknot" (2021).
struct Code {
  UnknotEntry entry;
  const char* text;
};
constexpr Code codes[] = {
    {{"culprit", "the Culprit of L. Kauffman and S. Lambropoulou, 10 crossings"},
     "X[2,14,3,13] X[4,12,5,11] X[8,19,9,20] X[10,4,11,3] X[12,6,13,5] X[14,2,15,1] X[15,6,16,7] "
     "X[16,10,17,9] X[18,7,19,8] X[20,17,1,18]"},
    {{"goeritz", "the unknot of L. Goeritz (1934), 11 crossings"},
     "X[1,13,2,12] X[3,15,4,14] X[4,21,5,22] X[6,17,7,18] X[8,19,9,20] X[9,17,10,16] X[11,1,12,22] "
     "X[13,3,14,2] X[15,11,16,10] X[18,7,19,8] X[20,5,21,6]"},
    {{"thistlethwaite", "the unknot of M. Thistlethwaite, 15 crossings"},
     "X[2,28,3,27] X[5,14,6,15] X[6,23,7,24] X[8,21,9,22] X[10,26,11,25] X[11,4,12,5] X[13,1,14,30] "
     "X[16,9,17,10] X[17,27,18,26] X[18,3,19,4] X[20,2,21,1] X[22,7,23,8] X[24,16,25,15] "
     "X[28,20,29,19] X[29,13,30,12]"},
    {{"ochiai", "the first unknot of M. Ochiai (1990), 16 crossings"},
     "X[3,13,4,12] X[4,21,5,22] X[5,30,6,31] X[6,18,7,17] X[8,28,9,27] X[10,26,11,25] X[11,3,12,2] "
     "X[13,20,14,21] X[16,8,17,7] X[18,15,19,16] X[19,29,20,28] X[22,1,23,2] X[24,31,25,32] "
     "X[26,10,27,9] X[29,15,30,14] X[32,23,1,24]"},
    {{"ochiai_2", "the second unknot of M. Ochiai, 45 crossings"},
     "X[2,53,3,54] X[3,16,4,17] X[5,19,6,18] X[6,71,7,72] X[8,69,9,70] X[10,21,11,22] X[11,49,12,48] "
     "X[13,33,14,32] X[17,73,18,72] X[20,81,21,82] X[24,46,25,45] X[25,58,26,59] X[28,64,29,63] "
     "X[30,41,31,42] X[34,78,35,77] X[35,13,36,12] X[36,28,37,27] X[38,87,39,88] X[39,63,40,62] "
     "X[40,29,41,30] X[44,60,45,59] X[47,84,48,85] X[49,81,50,80] X[50,75,51,76] X[52,16,53,15] "
     "X[54,1,55,2] X[56,23,57,24] X[57,47,58,46] X[61,43,62,42] X[64,32,65,31] X[65,14,66,15] "
     "X[66,51,67,52] X[68,20,69,19] X[70,7,71,8] X[73,4,74,5] X[74,67,75,68] X[76,79,77,80] "
     "X[78,34,79,33] X[82,10,83,9] X[83,22,84,23] X[85,27,86,26] X[86,37,87,38] X[88,43,89,44] "
     "X[89,61,90,60] X[90,55,1,56]"}};

/// The closures of braids of k + 1 strands that cross once each: a strand that is wound up k times.
constexpr UnknotEntry kinks[] = {{"kinks_1", "an unknot wound up once"},    {"kinks_2", "an unknot wound up twice"},
                                 {"kinks_3", "an unknot wound up 3 times"}, {"kinks_4", "an unknot wound up 4 times"},
                                 {"kinks_5", "an unknot wound up 5 times"}, {"kinks_6", "an unknot wound up 6 times"}};

std::vector<UnknotEntry> all_unknots() {
  std::vector<UnknotEntry> all{{"circle", "a regular polygon of 100 points"}};
  all.insert(all.end(), std::begin(kinks), std::end(kinks));
  for (const Code& code : codes) all.push_back(code.entry);
  return all;
}

Link circle() {
  Link link;
  std::vector<double>& points = link.components.emplace_back();
  for (int k = 0; k < circle_points; ++k) {
    const double angle = 2 * std::numbers::pi * k / circle_points;
    points.insert(points.end(), {portable::cos(angle), portable::sin(angle), 0});
  }
  return link;
}

}  // namespace

std::span<const UnknotEntry> unknot_table() {
  static const std::vector<UnknotEntry> table = all_unknots();
  return table;
}

std::optional<Link> unknot_of_table(std::string_view name) {
  if (name == "circle") return circle();
  for (std::size_t k = 0; k < std::size(kinks); ++k) {
    if (kinks[k].name != name) continue;
    std::vector<int> braid;
    for (int i = 0; i <= static_cast<int>(k); ++i) braid.push_back((i / 2 % 2 == 0 ? 1 : -1) * (i + 1));
    return braid_closure(static_cast<int>(k) + 2, braid);
  }
  for (const Code& code : codes)
    if (code.entry.name == name) return parse_link(code.text);
  return std::nullopt;
}

}  // namespace unsnarl
