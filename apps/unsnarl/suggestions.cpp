#include "suggestions.h"

#include <fmt/format.h>

#include <algorithm>

namespace unsnarl::app {
namespace {

/// Restricted Damerau-Levenshtein distance: letters to change, add, leave out, or swap with a neighbour.
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        edits[i][j] = i + j;
        continue;
      }
      edits[i][j] =
          std::min(edits[i - 1][j - 1] + (a[i - 1] != b[j - 1]), std::min(edits[i - 1][j], edits[i][j - 1]) + 1);
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  return edits[a.size()][b.size()];
}

}  // namespace

std::string nearest_word(std::string_view given, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t least = given.size() / 3 + 1;
  for (const std::string& word : known) {
    const std::size_t edits = edits_between(given, word);
    if (edits >= least) continue;
    least = edits;
    nearest = word;
  }
  return nearest;
}

std::string did_you_mean(std::string_view given, const std::vector<std::string>& known) {
  const std::string word = nearest_word(given, known);
  return word.empty() ? "" : fmt::format(" Did you mean {}?", word);
}

}  // namespace unsnarl::app
