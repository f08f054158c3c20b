#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "unsnarl/link.h"

namespace unsnarl {
namespace {

/// Braids as letters: a crosses the strands 1 and 2, A the other way, b the strands 2 and 3, ...
struct Row {
  const char* name;
  int strands;
  const char* braid;
  int determinant;
  int reversed = -1;  // this component then runs the other way
};

/// Braids of fewest strands as the Knot Atlas and KnotInfo list them; their numbers 10_161 to 10_165 count Perko's pair
/// once. The determinants, and the polynomials at -2, agree with a table of other origin but for 10_83 and 10_86, which
/// some tables exchange.
constexpr Row rows[] = {{"3_1", 2, "AAA", 3},
                        {"4_1", 3, "AbAb", 5},
                        {"5_1", 2, "AAAAA", 5},
                        {"5_2", 3, "AAABaB", 7},
                        {"6_1", 4, "AABacBc", 9},
                        {"6_2", 3, "AAAbAb", 11},
                        {"6_3", 3, "AAbAbb", 13},
                        {"7_1", 2, "AAAAAAA", 7},
                        {"7_2", 4, "AAABaBCbC", 11},
                        {"7_3", 3, "aaaaabAb", 13},
                        {"7_4", 4, "aabAbbcBc", 15},
                        {"7_5", 3, "AAAABaBB", 17},
                        {"7_6", 4, "AAbACbC", 19},
                        {"7_7", 4, "aBaBcBc", 21},
                        {"8_1", 5, "AABaBCbdCd", 13},
                        {"8_2", 3, "AAAAAbAb", 17},
                        {"8_3", 5, "AABacBcdCd", 17},
                        {"8_4", 4, "AAAbAbcBc", 19},
                        {"8_5", 3, "aaaBaaaB", 21},
                        {"8_6", 4, "AAAABacBc", 23},
                        {"8_7", 3, "aaaaBaBB", 23},
                        {"8_8", 4, "aaabACbCC", 25},
                        {"8_9", 3, "AAAbAbbb", 25},
                        {"8_10", 3, "aaaBaaBB", 27},
                        {"8_11", 4, "AABaBBcBc", 27},
                        {"8_12", 5, "AbACbdCd", 29},
                        {"8_13", 4, "AAbAbbcBc", 29},
                        {"8_14", 4, "AAABaBcBc", 31},
                        {"8_15", 4, "AAbACBBBC", 33},
                        {"8_16", 3, "AAbAAbAb", 35},
                        {"8_17", 3, "AAbAbAbb", 37},
                        {"8_18", 3, "AbAbAbAb", 45},
                        {"8_19", 3, "aaabaaab", 3},
                        {"8_20", 3, "aaaBAAAB", 9},
                        {"8_21", 3, "AAABaaBB", 15},
                        {"9_1", 2, "AAAAAAAAA", 9},
                        {"9_2", 5, "AAABaBCbCDcD", 15},
                        {"9_3", 3, "aaaaaaabAb", 19},
                        {"9_4", 4, "AAAAABaBCbC", 21},
                        {"9_5", 5, "aabAbbcBcdCd", 23},
                        {"9_6", 3, "AAAAAABaBB", 27},
                        {"9_7", 4, "AAAABaBCbCC", 29},
                        {"9_8", 5, "AAbAbcBDcD", 31},
                        {"9_9", 3, "AAAAABaBBB", 31},
                        {"9_10", 4, "aabAbbbbcBc", 33},
                        {"9_11", 4, "aaaaBacBc", 33},
                        {"9_12", 5, "AAbACbCDcD", 35},
                        {"9_13", 4, "aaaabAbbcBc", 37},
                        {"9_14", 5, "aabACbCdCd", 37},
                        {"9_15", 5, "aaabACbdCd", 39},
                        {"9_16", 3, "aaaabbAbbb", 39},
                        {"9_17", 4, "aBaBBBcBc", 39},
                        {"9_18", 4, "AAABaBBBCbC", 41},
                        {"9_19", 5, "aBaBBCbdCd", 41},
                        {"9_20", 4, "AAAbACbCC", 41},
                        {"9_21", 5, "aabAbCbdCd", 43},
                        {"9_22", 4, "AbAbCbbbC", 43},
                        {"9_23", 4, "AAABaBBCbCC", 45},
                        {"9_24", 4, "AAbACbbbC", 45},
                        {"9_25", 5, "AAbACBBdCd", 47},
                        {"9_26", 4, "aaaBaBcBc", 47},
                        {"9_27", 4, "AAbAbbCbC", 49},
                        {"9_28", 4, "AAbACbbCC", 51},
                        {"9_29", 4, "aBBcBaBcB", 51},
                        {"9_30", 4, "AAbbAbCbC", 53},
                        {"9_31", 4, "AAbAbCbCC", 55},
                        {"9_32", 4, "aaBaBacBc", 59},
                        {"9_33", 4, "AbAbbACbC", 61},
                        {"9_34", 4, "AbAbCbAbC", 69},
                        {"9_35", 5, "AABaBBCbbDcBDC", 27},
                        {"9_36", 4, "aaaBaacBc", 37},
                        {"9_37", 5, "AAbACbadCbCd", 45},
                        {"9_38", 4, "AABBcBaBCCB", 57},
                        {"9_39", 5, "aabACBadcBcd", 55},
                        {"9_40", 4, "AbACbACbC", 75},
                        {"9_41", 5, "AABacbbDCbCD", 49},
                        {"9_42", 4, "aaaBAAcBc", 7},
                        {"9_43", 4, "aaabaaCbC", 13},
                        {"9_44", 4, "AAABaacBc", 17},
                        {"9_45", 4, "AABaBACbC", 23},
                        {"9_46", 4, "AbAbCBaBC", 9},
                        {"9_47", 4, "AbAbcbAbc", 27},
                        {"9_48", 4, "aabAbaCbAbC", 27},
                        {"9_49", 4, "aabaaCbAbcc", 25},
                        {"10_1", 6, "AABaBCbCDceDe", 17},
                        {"10_2", 3, "AAAAAAAbAb", 23},
                        {"10_3", 6, "AABaBCbdCdeDe", 25},
                        {"10_4", 5, "AAAbAbcBcdCd", 27},
                        {"10_5", 3, "aaaaaaBaBB", 33},
                        {"10_6", 4, "AAAAAABacBc", 37},
                        {"10_7", 5, "AABaBCbCCdCd", 43},
                        {"10_8", 4, "AAAAAbAbcBc", 29},
                        {"10_9", 3, "aaaaaBaBBB", 39},
                        {"10_10", 5, "AAbAbbcBcdCd", 45},
                        {"10_11", 5, "AAAABacBcdCd", 43},
                        {"10_12", 4, "aaaaabACbCC", 47},
                        {"10_13", 6, "AABacBDceDe", 53},
                        {"10_14", 4, "AAAAABaBcBc", 57},
                        {"10_15", 4, "aaaaBaBCbCC", 43},
                        {"10_16", 5, "aabAbbCbCDcD", 47},
                        {"10_17", 3, "AAAAbAbbbb", 41},
                        {"10_18", 5, "AAABaBcBcdCd", 55},
                        {"10_19", 4, "AAAAbAbbcBc", 51},
                        {"10_20", 5, "AAAABaBCbdCd", 35},
                        {"10_21", 4, "AABaBBBBcBc", 45},
                        {"10_22", 4, "aaaabACbCCC", 49},
                        {"10_23", 4, "AAbAbbbbcBc", 59},
                        {"10_24", 5, "AABaBBBCbdCd", 55},
                        {"10_25", 4, "AAAABaBBcBc", 65},
                        {"10_26", 4, "AAAbAbbbcBc", 61},
                        {"10_27", 4, "AAAABaBcBcc", 71},
                        {"10_28", 5, "aabAbbcBDcDD", 53},
                        {"10_29", 5, "AAAbACbdCd", 63},
                        {"10_30", 5, "AABaBBCbCdCd", 67},
                        {"10_31", 5, "AAABacBccdCd", 57},
                        {"10_32", 4, "aaaBaBBCbCC", 69},
                        {"10_33", 5, "AABaBcBccdCd", 65},
                        {"10_34", 5, "aaabAbcBDcDD", 37},
                        {"10_35", 6, "AbAbcBDceDe", 49},
                        {"10_36", 5, "AAABaBCbCdCd", 51},
                        {"10_37", 5, "AAABacBcdCdd", 53},
                        {"10_38", 5, "AAABaBBCbdCd", 59},
                        {"10_39", 4, "AAABaBBBcBc", 61},
                        {"10_40", 4, "aaabAbbCbCC", 75},
                        {"10_41", 5, "aBaBBcBDcD", 71},
                        {"10_42", 5, "AAbAbCbdCd", 81},
                        {"10_43", 5, "AAbACbdCdd", 73},
                        {"10_44", 5, "AAbACbCdCd", 79},
                        {"10_45", 5, "AbAbCbCdCd", 89},
                        {"10_46", 3, "aaaaaBaaaB", 31},
                        {"10_47", 3, "aaaaaBaaBB", 41},
                        {"10_48", 3, "AAAAbbAbbb", 49},
                        {"10_49", 4, "AAAAbACBBBC", 59},
                        {"10_50", 4, "aabAbbCbbbC", 53},
                        {"10_51", 4, "aabAbbCbbCC", 67},
                        {"10_52", 4, "aaaBaaBBCbC", 59},
                        {"10_53", 5, "AABaBcBDCCCD", 73},
                        {"10_54", 4, "aaaBaaBCbCC", 47},
                        {"10_55", 5, "AAABacBDCCCD", 61},
                        {"10_56", 4, "aaabAbCbbbC", 65},
                        {"10_57", 4, "aaabAbCbbCC", 79},
                        {"10_58", 6, "aBacBDCCeDe", 65},
                        {"10_59", 5, "AbAbCbbdCd", 75},
                        {"10_60", 5, "AbAbbCbCBDcD", 85},
                        {"10_61", 4, "aaaBaaaBCbC", 33},
                        {"10_62", 3, "aaaaBaaaBB", 45},
                        {"10_63", 5, "AAbACBBBCDcD", 57},
                        {"10_64", 3, "aaaBaaaBBB", 51},
                        {"10_65", 4, "aabAbCbbbCC", 63},
                        {"10_66", 4, "AAAbACBBBCC", 75},
                        {"10_67", 5, "AAABaBCbbdCBdC", 63},
                        {"10_68", 5, "aaBaBBCbbDcBDC", 57},
                        {"10_69", 5, "aabACbadCbCd", 87},
                        {"10_70", 5, "AbACbbbdCd", 67},
                        {"10_71", 5, "AAbACbbdCd", 77},
                        {"10_72", 4, "aaaabbAbCbC", 73},
                        {"10_73", 5, "AABaBAcBcDcD", 83},
                        {"10_74", 5, "AABaBBCbbdCBdC", 63},
                        {"10_75", 5, "aBaBcBBdCbdc", 81},
                        {"10_76", 4, "aaaabACbbbC", 57},
                        {"10_77", 4, "aaaabACbbCC", 63},
                        {"10_78", 5, "AABaBAcBDcDD", 69},
                        {"10_79", 3, "AAAbbAAbbb", 61},
                        {"10_80", 4, "AAAbAACBBBC", 71},
                        {"10_81", 5, "aaBacbbDCCCD", 85},
                        {"10_82", 3, "AAAAbAbAbb", 63},
                        {"10_83", 4, "aabAbCbbCbC", 83},
                        {"10_84", 4, "aaabACbbCbC", 87},
                        {"10_85", 3, "AAAAbAAbAb", 57},
                        {"10_86", 4, "AAbAbAbbcBc", 85},
                        {"10_87", 4, "aaabACbCbCC", 81},
                        {"10_88", 5, "AbACbCbdCd", 101},
                        {"10_89", 5, "AbAbcBADCbCD", 99},
                        {"10_90", 4, "AAbAbcBAcbb", 77},
                        {"10_91", 3, "AAAbAbbAbb", 73},
                        {"10_92", 4, "aaabbCbAbCb", 89},
                        {"10_93", 4, "AAbAAbAbcBc", 67},
                        {"10_94", 3, "aaaBaaBBaB", 71},
                        {"10_95", 4, "AAbbCbAbccb", 91},
                        {"10_96", 5, "AbaCbaCdCbCd", 93},
                        {"10_97", 5, "aabAbaCbAbcDcD", 87},
                        {"10_98", 4, "AABBcBaBBcB", 81},
                        {"10_99", 3, "AAbAAbbAbb", 81},
                        {"10_100", 3, "AAAbAAbAAb", 65},
                        {"10_101", 5, "aaabAcBacbbdCd", 85},
                        {"10_102", 4, "AAbACbAbbcc", 73},
                        {"10_103", 4, "AABacBBcBBc", 75},
                        {"10_104", 3, "AAAbbAbAbb", 77},
                        {"10_105", 5, "aaBacbbDCbCD", 91},
                        {"10_106", 3, "aaaBaBaaBB", 75},
                        {"10_107", 5, "AAbAcbbDcBcD", 93},
                        {"10_108", 4, "aaBaacBaBCC", 63},
                        {"10_109", 3, "AAbAbbAAbb", 85},
                        {"10_110", 5, "AbACBBBdcBcd", 83},
                        {"10_111", 4, "aabbCbbAbCb", 77},
                        {"10_112", 3, "AAAbAbAbAb", 87},
                        {"10_113", 4, "aaabCbAbCbC", 111},
                        {"10_114", 4, "AABacBcBcBc", 93},
                        {"10_115", 5, "aBacbbDCbCCD", 109},
                        {"10_116", 3, "AAbAAbAbAb", 95},
                        {"10_117", 4, "aabbCbAbCbC", 103},
                        {"10_118", 3, "aaBaBaBBaB", 97},
                        {"10_119", 4, "AAbACbAbccb", 101},
                        {"10_120", 5, "AABacbADCBBCCD", 105},
                        {"10_121", 4, "AABcBaBcBcB", 115},
                        {"10_122", 4, "aabCbACbCbC", 105},
                        {"10_123", 3, "AbAbAbAbAb", 121},
                        {"10_124", 3, "aaaaabaaab", 1},
                        {"10_125", 3, "aaaaaBAAAB", 11},
                        {"10_126", 3, "AAAAABaaaB", 19},
                        {"10_127", 3, "AAAAABaaBB", 29},
                        {"10_128", 4, "aaabaabbcBc", 11},
                        {"10_129", 4, "aaaBAAcBAcB", 25},
                        {"10_130", 4, "aaaBAABBCbC", 17},
                        {"10_131", 4, "AAABaaBBCbC", 31},
                        {"10_132", 4, "aaaBAABCbCC", 5},
                        {"10_133", 4, "AAABaaBCbCC", 19},
                        {"10_134", 4, "aaabaabcBcc", 23},
                        {"10_135", 4, "aaabAbCBBBC", 37},
                        {"10_136", 5, "aBaBCbbdCd", 15},
                        {"10_137", 5, "AbAbCBBdCd", 25},
                        {"10_138", 5, "AbAbcbbDcD", 35},
                        {"10_139", 3, "aaaabaaabb", 3},
                        {"10_140", 4, "aaaBAAABCbC", 9},
                        {"10_141", 3, "aaaaBAAABB", 21},
                        {"10_142", 4, "aaabaaabcBc", 15},
                        {"10_143", 3, "AAAABaaaBB", 27},
                        {"10_144", 4, "AABaBAcBAcb", 39},
                        {"10_145", 4, "AABaBACBaBC", 3},
                        {"10_146", 4, "AAbAbaCbAbC", 33},
                        {"10_147", 4, "aaaBaBCbAbC", 27},
                        {"10_148", 3, "AAAABaaBaB", 31},
                        {"10_149", 3, "AAAABaBaBB", 41},
                        {"10_150", 4, "aaaBaacBAcb", 29},
                        {"10_151", 4, "aaabAAcBacB", 43},
                        {"10_152", 3, "AAABBAABBB", 11},
                        {"10_153", 4, "AAABAAcbbbc", 1},
                        {"10_154", 4, "aabAbacbbbc", 13},
                        {"10_155", 3, "aaabAAbAAb", 25},
                        {"10_156", 4, "AAAbaaCBaBC", 35},
                        {"10_157", 3, "aaabbAbAbb", 49},
                        {"10_158", 4, "AAABaacbAbc", 45},
                        {"10_159", 3, "AAABaBaaBB", 39},
                        {"10_160", 4, "aaabaaCbAbC", 21},
                        {"10_161", 3, "AAABaBAABB", 5},
                        {"10_162", 4, "AABaaBBAcBc", 35},
                        {"10_163", 4, "aaBAAcbAbbc", 51},
                        {"10_164", 4, "aaBaBBCbAbC", 45},
                        {"10_165", 4, "aabACbAbccb", 39},
                        {"unknot", 1, "", 1},
                        {"hopf", 2, "aa", 2},
                        {"t_2_4", 2, "aaaa", 4},
                        {"t_2_4_reversed", 2, "aaaa", 4, 1},
                        {"whitehead", 3, "aBaBB", 8},
                        {"borromean", 3, "aBaBaB", 16},
                        {"t_3_7", 3, "ababababababab", 1}};

std::vector<KnotEntry> make_table() {
  std::vector<KnotEntry> table;
  for (const Row& row : rows) {
    KnotEntry& entry = table.emplace_back();
    entry.name = row.name;
    entry.strands = row.strands;
    entry.determinant = row.determinant;
    entry.reversed = row.reversed;
    for (const char* c = row.braid; *c; ++c) entry.braid.push_back(*c >= 'a' ? *c - 'a' + 1 : -(*c - 'A' + 1));
  }
  return table;
}

}  // namespace

std::span<const KnotEntry> knot_table() {
  static const std::vector<KnotEntry> table = make_table();
  return table;
}

Link knot_of_table(std::string_view name) {
  if (std::optional<Link> unknot = unknot_of_table(name)) return std::move(*unknot);
  const auto table = knot_table();
  const auto entry = std::find_if(table.begin(), table.end(), [&](const KnotEntry& e) { return e.name == name; });
  if (entry == table.end())
    throw std::invalid_argument(
        fmt::format("there is no knot '{}' in the table; give 3_1 to 10_165, or hopf, whitehead, "
                    "borromean, t_2_4, t_2_4_reversed, t_3_7, unknot, circle, kinks_1 to kinks_6, culprit, goeritz, "
                    "thistlethwaite, ochiai, ochiai_2",
                    name));
  Link link = braid_closure(entry->strands, entry->braid);
  if (entry->reversed >= 0) {
    std::vector<double>& p = link.components[entry->reversed];
    for (std::size_t a = 0, b = p.size() - 3; a < b; a += 3, b -= 3)
      std::swap_ranges(p.begin() + a, p.begin() + a + 3, p.begin() + b);
  }
  return link;
}

}  // namespace unsnarl
