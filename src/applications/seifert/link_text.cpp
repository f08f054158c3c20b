#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "applications/seifert/planar_layout.h"
#include "text/read_number.h"
#include "unsnarl/document.h"
#include "unsnarl/link.h"

namespace unsnarl {
namespace {

/// Codes of more crossings and longer words are taken for a mistake (unit: crossings)
constexpr std::size_t most_crossings = 1000;
constexpr int most_strands = 100;  ///< Braids of more strands are taken for a mistake (unit: strands)

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

/// The integers of a text in which all else is brackets, commas, blanks and the letters of codes.
std::vector<int> integers_of(const std::vector<Line>& lines, std::string_view letters) {
  std::vector<int> numbers;
  for (const Line& line : lines) {
    const char* at = line.text.data();
    const char* const end = at + line.text.size();
    while (at != end) {
      if (std::isspace(static_cast<unsigned char>(*at)) ||
          std::string_view("[](){},;").find(*at) != std::string_view::npos || letters.find(*at) != letters.npos) {
        ++at;
        continue;
      }
      int value = 0;
      const auto [after, error] = std::from_chars(at, end, value);
      if (error != std::errc{})
        throw FileError(
            fmt::format("line {}: '{}' is not a whole number", line.number,
                        std::string_view(at, static_cast<std::size_t>(std::min<std::ptrdiff_t>(end - at, 20)))));
      numbers.push_back(value);
      at = after;
    }
  }
  return numbers;
}

Link read_braid(std::vector<Line> lines, std::size_t first) {
  Line& line = lines[first];
  line.text.remove_prefix(std::string_view("braid").size());
  const std::size_t colon = line.text.find(':');
  if (colon == line.text.npos)
    throw FileError(
        fmt::format("line {}: a braid is written 'braid STRANDS: GENERATORS', as in 'braid 2: 1 1 1'", line.number));
  const std::vector<int> strands = integers_of({Line{line.number, line.text.substr(0, colon)}}, "");
  line.text.remove_prefix(colon + 1);
  lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first));
  const std::vector<int> word = integers_of(lines, "");
  if (strands.size() != 1 || strands[0] < 1 || strands[0] > most_strands)
    throw FileError(
        fmt::format("line {}: give one number of strands, 1 to {}, before the ':'", lines[0].number, most_strands));
  if (word.size() > most_crossings)
    throw FileError(fmt::format("a braid of {} generators; {} at most", word.size(), most_crossings));
  try {
    return braid_closure(strands[0], word);
  } catch (const std::invalid_argument& e) {
    throw FileError(fmt::format("line {}: {}", lines[0].number, e.what()));
  }
}

Link read_planar_diagram(const std::vector<Line>& lines) {
  const std::vector<int> numbers = integers_of(lines, "PDX");
  if (numbers.size() % 4 != 0)
    throw FileError(
        fmt::format("a planar diagram code has four edges a crossing; this one has {} numbers", numbers.size()));
  if (numbers.empty() || numbers.size() / 4 > most_crossings)
    throw FileError(
        fmt::format("a planar diagram code of {} crossings; give 1 to {}", numbers.size() / 4, most_crossings));
  PlanarCode code;
  for (std::size_t k = 0; k < numbers.size(); k += 4)
    code.push_back({numbers[k], numbers[k + 1], numbers[k + 2], numbers[k + 3]});
  return lay_out(code);
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
        throw FileError(
            fmt::format("line {}: '{}' is not a coordinate; a point is written 'x y z'", line.number,
                        std::string_view(at, static_cast<std::size_t>(std::min<std::ptrdiff_t>(end - at, 20)))));
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
    if (lines[k].text.starts_with("braid")) return read_braid(std::move(lines), k);
    if (std::string_view("PX[({").find(lines[k].text[0]) != std::string_view::npos) return read_planar_diagram(lines);
    return read_points(lines);
  }
  throw FileError("nothing in it: give points ('x y z', one a line), a planar diagram code or a braid word");
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
