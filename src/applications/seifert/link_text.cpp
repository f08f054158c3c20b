#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "applications/seifert/gauss_code.h"
#include "applications/seifert/planar_layout.h"
#include "text/read_number.h"
#include "unsnarl/document.h"
#include "unsnarl/link.h"

namespace unsnarl {
namespace {

/// Codes of more crossings and longer words are taken for a mistake (unit: crossings)
constexpr std::size_t most_crossings = 1000;
constexpr int most_strands = 100;  ///< Braids of more strands are taken for a mistake (unit: strands)

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

struct Line {
  std::size_t number = 0;
  std::string_view text;  // without comment and blanks around it
};

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t begin = 0, number = 1; begin <= text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    line = line.substr(0, line.find('#'));
    const auto first = line.find_first_not_of(" \t\r"), last = line.find_last_not_of(" \t\r");
    lines.push_back({number, first == line.npos ? std::string_view() : line.substr(first, last - first + 1)});
    begin = end + 1;
  }
  return lines;
}

std::string_view some_of(const char* at, const char* end) {
  return {at, static_cast<std::size_t>(std::min<std::ptrdiff_t>(end - at, 20))};
}

/// The integers of a text in which all else is brackets, commas, blanks and the letters of codes. Brackets and
/// semicolons part the groups.
std::vector<std::vector<int>> groups_of(const std::vector<Line>& lines, std::string_view letters) {
  std::vector<std::vector<int>> groups(1);
  for (const Line& line : lines) {
    const char* at = line.text.data();
    const char* const end = at + line.text.size();
    while (at != end) {
      if (std::string_view("[](){};").find(*at) != std::string_view::npos) {
        if (!groups.back().empty()) groups.emplace_back();
        ++at;
        continue;
      }
      if (std::isspace(static_cast<unsigned char>(*at)) || *at == ',' || *at == ':' ||
          letters.find(*at) != letters.npos) {
        ++at;
        continue;
      }
      int value = 0;
      const auto [after, error] = std::from_chars(at + (*at == '+' ? 1 : 0), end, value);
      if (error != std::errc{})
        throw FileError(fmt::format("line {}: '{}' is not a whole number", line.number, some_of(at, end)));
      groups.back().push_back(value);
      at = after;
    }
  }
  if (groups.back().empty()) groups.pop_back();
  return groups;
}

std::vector<int> joined(const std::vector<std::vector<int>>& groups) {
  std::vector<int> all;
  for (const std::vector<int>& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

void check_count(std::size_t crossings, const char* of) {
  if (crossings < 1 || crossings > most_crossings)
    throw FileError(fmt::format("a {} of {} crossings; give 1 to {}", of, crossings, most_crossings));
}

/// Of as many strands as its generators need, where none are given.
Link close_braid(std::optional<int> strands, const std::vector<int>& word, std::size_t line) {
  if (word.size() > most_crossings)
    throw FileError(fmt::format("a braid of {} generators; {} at most", word.size(), most_crossings));
  if (!strands) {
    strands = 1;
    for (const int g : word)
      strands = std::max<int>(*strands, std::min(std::abs(std::int64_t{g}), std::int64_t{most_strands}) + 1);
  }
  if (*strands < 1 || *strands > most_strands)
    throw FileError(fmt::format("line {}: a braid of {} strands; give 1 to {}", line, *strands, most_strands));
  try {
    return braid_closure(*strands, word);
  } catch (const std::invalid_argument& e) {
    throw FileError(fmt::format("line {}: {}", line, e.what()));
  }
}

Link read_braid(std::vector<Line> lines, std::size_t first) {
  Line& line = lines[first];
  line.text.remove_prefix(std::string_view("braid").size());
  const std::size_t colon = line.text.find(':');
  if (colon == line.text.npos)
    throw FileError(
        fmt::format("line {}: a braid is written 'braid STRANDS: GENERATORS', as in 'braid 2: 1 1 1'", line.number));
  const std::vector<int> strands = joined(groups_of({Line{line.number, line.text.substr(0, colon)}}, ""));
  line.text.remove_prefix(colon + 1);
  lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first));
  const std::vector<int> word = joined(groups_of(lines, ""));
  if (strands.size() != 1)
    throw FileError(
        fmt::format("line {}: give one number of strands, 1 to {}, before the ':'", lines[0].number, most_strands));
  return close_braid(strands[0], word, lines[0].number);
}

/// BR[3, {1, -2, 1, -2}], or the generators alone.
Link read_braid_representative(const std::vector<std::vector<int>>& groups, std::size_t line) {
  if (groups.size() == 2 && groups[0].size() == 1) return close_braid(groups[0][0], groups[1], line);
  return close_braid({}, joined(groups), line);
}

/// Edges are numbered from 1, or from 0 as SnapPy does.
Link read_planar_diagram(const std::vector<std::vector<int>>& groups) {
  const std::vector<int> numbers = joined(groups);
  if (numbers.size() % 4 != 0)
    throw FileError(
        fmt::format("a planar diagram code has four edges a crossing; this one has {} numbers", numbers.size()));
  check_count(numbers.size() / 4, "planar diagram code");
  const int shift = *std::min_element(numbers.begin(), numbers.end()) == 0 ? 1 : 0;
  PlanarCode code;
  for (std::size_t k = 0; k < numbers.size(); k += 4)
    code.push_back({numbers[k] + shift, numbers[k + 1] + shift, numbers[k + 2] + shift, numbers[k + 3] + shift});
  return lay_out(code);
}

Link read_dowker_thistlethwaite(const std::vector<std::vector<int>>& groups) {
  check_count(joined(groups).size(), "Dowker-Thistlethwaite code");
  return lay_out(planar_code(gauss_code(groups)));
}

/// The numbers that letters stand for, a: 1, b: 2, ...; capitals below 0.
std::vector<int> letters_as_numbers(std::string_view word) {
  std::vector<int> numbers;
  for (const char c : word) numbers.push_back(c >= 'a' ? c - 'a' + 1 : -(c - 'A' + 1));
  return numbers;
}

/// Half of each number of a Dowker-Thistlethwaite code as a letter. Before them may stand the number of crossings and
/// that of components, and then the lengths of the components' lists (not needed where there is one).
Link read_lettered_code(std::string_view word) {
  std::vector<int> numbers = letters_as_numbers(word);
  std::vector<std::size_t> lengths{numbers.size()};
  if (const std::size_t n = numbers.size(); n >= 2 && numbers[0] > 0 && numbers[1] > 0) {
    const auto crossings = static_cast<std::size_t>(numbers[0]), components = static_cast<std::size_t>(numbers[1]);
    const bool has_lengths = n == 2 + components + crossings;
    if (has_lengths || (components == 1 && n == 2 + crossings)) {
      lengths.assign(1, crossings);
      if (has_lengths)
        lengths.assign(numbers.begin() + 2, numbers.begin() + 2 + static_cast<std::ptrdiff_t>(components));
      numbers.erase(numbers.begin(), numbers.end() - static_cast<std::ptrdiff_t>(crossings));
    }
  }
  std::vector<std::vector<int>> groups;
  auto at = numbers.begin();
  for (const std::size_t length : lengths) {
    if (length > static_cast<std::size_t>(numbers.end() - at))
      throw FileError("'" + std::string(word) +
                      "' is no Dowker-Thistlethwaite code in letters: its components are longer than it");
    groups.emplace_back(at, at + static_cast<std::ptrdiff_t>(length));
    for (int& number : groups.back()) number *= 2;
    at += static_cast<std::ptrdiff_t>(length);
  }
  return read_dowker_thistlethwaite(groups);
}

/// Numbers above 0 are passed above, unless all are: then above and below alternate. `has_signs`: the last group has
/// one for each crossing.
Link read_gauss_code(std::vector<std::vector<int>> groups, bool has_signs) {
  GaussCode code;
  if (has_signs && groups.size() > 1) {
    code.signs = groups.back();
    for (const int sign : code.signs)
      if (sign != 1 && sign != -1)
        throw FileError(fmt::format("Gauss code: {} is not a crossing's sign, 1 or -1", sign));
    groups.pop_back();
  }
  const std::vector<int> all = joined(groups);
  check_count(all.size() / 2, "Gauss code");
  const bool alternates = std::all_of(all.begin(), all.end(), [](int number) { return number > 0; });
  bool over = true;
  for (const std::vector<int>& group : groups) {
    auto& component = code.components.emplace_back();
    for (const int number : group) {
      component.push_back(
          {static_cast<int>(std::min<std::int64_t>(std::abs(std::int64_t{number}), 2 * most_crossings)) - 1,
           alternates ? over : number > 0});
      over = !over;
    }
  }
  return lay_out(planar_code(std::move(code)));
}

/// O1-U2-O3-U1-O2-U3-: over or under, the crossing, and its sign or none. '|' or a new line begins a component.
Link read_lettered_gauss_code(const std::vector<Line>& lines) {
  GaussCode code;
  std::vector<int> signs;
  for (const Line& line : lines) {
    code.components.emplace_back();
    const char* at = line.text.data();
    const char* const end = at + line.text.size();
    while (at != end) {
      if (*at == '|') code.components.emplace_back();
      if (*at == '|' || *at == ' ' || *at == '\t' || *at == ',') {
        ++at;
        continue;
      }
      int crossing = 0;
      const auto [after, error] = std::from_chars(at + 1, end, crossing);
      if ((*at != 'O' && *at != 'U') || error != std::errc{} || crossing < 1 ||
          crossing > static_cast<int>(most_crossings))
        throw FileError(fmt::format("line {}: '{}' is not a passage of a Gauss code, as in O1- or U2+", line.number,
                                    some_of(at, end)));
      code.components.back().push_back({crossing - 1, *at == 'O'});
      signs.resize(std::max(signs.size(), static_cast<std::size_t>(crossing)), 0);
      at = after;
      if (at == end || (*at != '+' && *at != '-')) continue;
      int& sign = signs[static_cast<std::size_t>(crossing) - 1];
      if (sign != 0 && sign != (*at == '+' ? 1 : -1))
        throw FileError(fmt::format("line {}: crossing {} has both signs", line.number, crossing));
      sign = *at == '+' ? 1 : -1;
      ++at;
    }
  }
  std::erase_if(code.components, [](const auto& component) { return component.empty(); });
  const auto unsigned_count = std::count(signs.begin(), signs.end(), 0);
  if (unsigned_count == 0)
    code.signs = std::move(signs);
  else if (unsigned_count != static_cast<std::ptrdiff_t>(signs.size()))
    throw FileError("Gauss code: some crossings have a sign and some have none");
  return lay_out(planar_code(std::move(code)));
}

bool is_each_twice(std::vector<int> numbers) {
  std::sort(numbers.begin(), numbers.end());
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (numbers[k] != numbers[k ^ 1] || (k > 1 && numbers[k] == numbers[k - 2])) return false;
  return numbers.size() % 2 == 0;
}

/// Numbers in brackets, by which of the codes they can be.
Link read_bracketed(const std::vector<Line>& lines, std::string_view text) {
  const std::vector<std::vector<int>> groups = groups_of(lines, "");
  const std::vector<int> numbers = joined(groups);
  if (numbers.empty()) throw FileError("brackets without numbers");
  std::vector<int> sizes;
  for (const int number : numbers)
    sizes.push_back(static_cast<int>(std::min<std::int64_t>(std::abs(std::int64_t{number}), 4 * most_crossings)));
  const bool has_negative = std::any_of(numbers.begin(), numbers.end(), [](int n) { return n < 0; });
  std::vector<int> sorted = sizes;
  std::sort(sorted.begin(), sorted.end());
  bool is_even = true;
  for (std::size_t k = 0; k < sorted.size(); ++k) is_even = is_even && sorted[k] == 2 * static_cast<int>(k + 1);
  if (is_even) return read_dowker_thistlethwaite(groups);
  std::size_t brackets = 0;
  for (const char c : text)
    if (c == '[' || c == '{' || c == '(')
      ++brackets;
    else if (!std::isspace(static_cast<unsigned char>(c)))
      break;
  if (brackets >= 3) return read_gauss_code(groups, true);
  std::vector<int> distinct = numbers;
  std::sort(distinct.begin(), distinct.end());
  if (has_negative && is_each_twice(sizes) && std::adjacent_find(distinct.begin(), distinct.end()) == distinct.end())
    return read_gauss_code(groups, false);
  const bool is_nested = std::all_of(groups.begin(), groups.end(), [](const auto& group) { return group.size() == 4; });
  if (!has_negative && (text[0] != '{' || brackets > 1) && (is_nested || is_each_twice(numbers)))
    return read_planar_diagram(groups);
  return read_braid_representative(groups, lines[0].number);
}

Link read_points(const std::vector<Line>& lines) {
  Link link;
  std::vector<double> points;
  const auto close = [&] {
    const std::size_t n = points.size();
    if (n >= 6 && std::equal(points.begin(), points.begin() + 3, points.end() - 3)) points.resize(n - 3);
    if (!points.empty()) link.components.push_back(std::move(points));
    points = {};
  };
  for (const Line& line : lines) {
    if (line.text.empty()) {
      close();
      continue;
    }
    const char* at = line.text.data();
    const char* const end = at + line.text.size();
    int count = 0;
    while (at != end) {
      if (*at == ' ' || *at == '\t' || *at == ',') {
        ++at;
        continue;
      }
      double value = 0;
      const auto [after, error] = read_number(at, end, value);
      if (error != std::errc{} || !std::isfinite(value) ||
          (after != end && *after != ' ' && *after != '\t' && *after != ','))
        throw FileError(fmt::format("line {}: '{}' is not a coordinate; a point is written 'x y z'", line.number,
                                    some_of(at, end)));
      points.push_back(value);
      at = after;
      ++count;
    }
    if (count != 3) throw FileError(fmt::format("line {}: {} numbers; a point has three, 'x y z'", line.number, count));
  }
  close();
  return link;
}

}  // namespace

Link parse_link(std::string_view text) {
  std::vector<Line> lines = lines_of(text);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (lines[k].text.empty()) continue;
    const std::string_view line = lines[k].text;
    if (line.starts_with("braid")) return read_braid(std::move(lines), k);
    const std::size_t word_end = std::find_if_not(line.begin(), line.end(), is_letter) - line.begin();
    const std::string word(line.substr(0, word_end));
    const auto rest = [&](std::string_view letters) {
      std::vector<Line> others(lines.begin() + static_cast<std::ptrdiff_t>(k), lines.end());
      others[0].text.remove_prefix(word_end);
      return groups_of(others, letters);
    };
    if (word == "BR" || word == "Braid") return read_braid_representative(rest(""), lines[k].number);
    if (word == "PD" || word == "X") return read_planar_diagram(rest("X"));
    if (word == "GaussCode" || word == "Gauss" || word == "gauss") return read_gauss_code(rest(""), false);
    if (word == "DT" || word == "DTCode") {
      std::string_view code = line.substr(word_end);
      while (!code.empty() && std::string_view(" \t:[]").find(code.front()) != std::string_view::npos)
        code.remove_prefix(1);
      while (!code.empty() && code.back() == ']') code.remove_suffix(1);
      if (!code.empty() && std::all_of(code.begin(), code.end(), is_letter)) return read_lettered_code(code);
      return read_dowker_thistlethwaite(rest(""));
    }
    if ((word == "O" || word == "U") && word_end < line.size() &&
        std::isdigit(static_cast<unsigned char>(line[word_end])))
      return read_lettered_gauss_code({lines.begin() + static_cast<std::ptrdiff_t>(k), lines.end()});
    if (word.size() > 1 && word_end == line.size()) return read_lettered_code(line);
    if (std::string_view("[({").find(line[0]) != std::string_view::npos)
      return read_bracketed({lines.begin() + static_cast<std::ptrdiff_t>(k), lines.end()}, line);
    return read_points(lines);
  }
  throw FileError(
      "nothing in it: give points ('x y z', one a line), a code of a diagram (PD, DT, Gauss) or a braid word");
}

std::string link_text(const Link& link) {
  std::string text;
  for (const std::vector<double>& component : link.components) {
    if (!text.empty()) text += "\n";
    for (std::size_t k = 0; k + 2 < component.size(); k += 3)
      text += fmt::format("{} {} {}\n", component[k], component[k + 1], component[k + 2]);
  }
  return text;
}

}  // namespace unsnarl
