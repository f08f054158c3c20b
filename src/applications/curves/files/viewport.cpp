#include "applications/curves/files/viewport.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/portable_math.h"
#include "text/read_number.h"

namespace unsnarl {
namespace {

struct LengthUnit {
  std::string_view name;
  double pixels;
};
constexpr double inch = 96;          ///< Length of an inch in pixels (fixed by CSS)
constexpr double inch_in_cm = 2.54;  ///< Length of an inch in centimetres (fixed by its definition)
constexpr std::array<LengthUnit, 8> length_units = {{{"", 1},
                                                     {"px", 1},
                                                     {"in", inch},
                                                     {"cm", inch / inch_in_cm},
                                                     {"mm", inch / (10 * inch_in_cm)},
                                                     {"q", inch / (40 * inch_in_cm)},
                                                     {"pt", inch / 72},
                                                     {"pc", inch / 6}}};
constexpr std::array<LengthUnit, 5> angle_units = {{{"", std::numbers::pi / 180},
                                                    {"deg", std::numbers::pi / 180},
                                                    {"grad", std::numbers::pi / 200},
                                                    {"rad", 1},
                                                    {"turn", 2 * std::numbers::pi}}};

std::string_view without_spaces_around(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// A number and what stands behind it.
std::pair<double, std::string> number_and_unit(std::string_view given) {
  std::string_view text = without_spaces_around(given);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = read_number(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) throw FileError(fmt::format("'{}' is not a length", given));
  std::string unit(without_spaces_around({end, static_cast<std::size_t>(text.data() + text.size() - end)}));
  for (char& c : unit) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return {value, unit};
}

double parse_angle(std::string_view text) {
  const auto [value, name] = number_and_unit(text);
  for (const LengthUnit& unit : angle_units)
    if (name == unit.name) return value * unit.pixels;
  throw FileError(fmt::format("'{}' is not an angle in deg, grad, rad or turn", text));
}

/// The words of a text between spaces and commas.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  const std::string_view between = " \t\r\n\f,";
  for (std::size_t begin = text.find_first_not_of(between); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(between, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(between, end);
  }
  return words;
}

/// One function of a transform; false: there is none of this name and number of arguments.
bool parse_function(std::string_view name, const std::vector<std::string_view>& given, const Viewport& viewport,
                    Affine& step) {
  const auto number = [&](std::size_t k) {
    const auto [value, unit] = number_and_unit(given[k]);
    if (unit == "%") return value / 100;
    if (!unit.empty()) throw FileError(fmt::format("'{}' is not a number", given[k]));
    return value;
  };
  const auto turned = [](double angle) {
    Eigen::Matrix2d turn;
    const double c = portable::cos(angle), s = portable::sin(angle);
    turn << c, -s, s, c;
    return turn;
  };
  const std::size_t n = given.size();
  if (name == "translate" && (n == 1 || n == 2)) {
    step.offset = {parse_length(given[0], viewport.whole('x')),
                   n == 2 ? parse_length(given[1], viewport.whole('y')) : 0};
  } else if (name == "translatex" && n == 1) {
    step.offset.x() = parse_length(given[0], viewport.whole('x'));
  } else if (name == "translatey" && n == 1) {
    step.offset.y() = parse_length(given[0], viewport.whole('y'));
  } else if (name == "scale" && (n == 1 || n == 2)) {
    step.linear << number(0), 0, 0, number(n - 1);
  } else if (name == "scalex" && n == 1) {
    step.linear(0, 0) = number(0);
  } else if (name == "scaley" && n == 1) {
    step.linear(1, 1) = number(0);
  } else if (name == "rotate" && n == 1) {
    step.linear = turned(parse_angle(given[0]));
  } else if (name == "rotate" && n == 3) {
    const Vec2 centre(parse_length(given[1], viewport.whole('x')), parse_length(given[2], viewport.whole('y')));
    step.linear = turned(parse_angle(given[0]));
    step.offset = centre - step.linear * centre;
  } else if (name == "skewx" && n == 1) {
    step.linear(0, 1) = portable::tan(parse_angle(given[0]));
  } else if (name == "skewy" && n == 1) {
    step.linear(1, 0) = portable::tan(parse_angle(given[0]));
  } else if (name == "skew" && (n == 1 || n == 2)) {
    step.linear(0, 1) = portable::tan(parse_angle(given[0]));
    if (n == 2) step.linear(1, 0) = portable::tan(parse_angle(given[1]));
  } else if (name == "matrix" && n == 6) {
    step.linear << number(0), number(2), number(1), number(3);
    step.offset << number(4), number(5);
  } else {
    return false;
  }
  return true;
}

double attribute_length(const pugi::xml_node& node, const char* name, double whole, double otherwise) {
  const pugi::xml_attribute attribute = node.attribute(name);
  if (!attribute || std::string_view(attribute.value()) == "auto") return otherwise;
  return parse_length(attribute.value(), whole);
}

}  // namespace

double Viewport::whole(char direction) const {
  if (direction == 'x') return size.x();
  if (direction == 'y') return size.y();
  return std::sqrt(0.5 * size.squaredNorm());
}

double parse_length(std::string_view text, double whole) {
  const auto [value, name] = number_and_unit(text);
  if (name == "%") {
    if (std::isinf(whole)) throw FileError(fmt::format("'{}' of a page of unknown size", text));
    return value / 100 * whole;
  }
  for (const LengthUnit& unit : length_units)
    if (name == unit.name) return value * unit.pixels;
  throw FileError(fmt::format("'{}' has a unit that is not px, in, cm, mm, pt, pc or %", text));
}

Affine parse_css_transform(std::string_view text, const Viewport& viewport) {
  Affine result;
  std::string_view rest = without_spaces_around(text);
  if (rest == "none" || rest.empty()) return result;
  while (!rest.empty()) {
    const std::size_t open = rest.find('('), close = rest.find(')');
    Affine step;
    if (close == std::string_view::npos || open > close ||
        !parse_function(without_spaces_around(rest.substr(0, open)), words_of(rest.substr(open + 1, close - open - 1)),
                        viewport, step))
      throw FileError(fmt::format("'{}' is not a transform of the plane", rest));
    result = result * step;
    rest.remove_prefix(close + 1);
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == ',' || rest.front() == '\t' ||
                             rest.front() == '\n' || rest.front() == '\r'))
      rest.remove_prefix(1);
  }
  return result;
}

Affine about_origin(const Affine& transform, std::string_view origin, const Viewport& viewport) {
  std::vector<std::string_view> words = words_of(origin);
  if (words.empty() || words.size() > 3) throw FileError(fmt::format("the origin '{}' cannot be read", origin));
  if (words.size() == 1) words.emplace_back("center");
  if (words[0] == "top" || words[0] == "bottom" || words[1] == "left" || words[1] == "right")
    std::swap(words[0], words[1]);
  Vec2 at;
  for (int axis = 0; axis < 2; ++axis) {
    std::string_view word = words[axis];
    if (word == "left" || word == "top") word = "0%";
    if (word == "center") word = "50%";
    if (word == "right" || word == "bottom") word = "100%";
    at[axis] = parse_length(word, viewport.size[axis]);
    if (word.ends_with('%')) at[axis] += viewport.low[axis];
  }
  Affine result = transform;
  result.offset += at - transform.linear * at;
  return result;
}

Viewport viewport_of(const pugi::xml_node& svg, const Viewport& outer) {
  Viewport result;
  if (const pugi::xml_attribute box = svg.attribute("viewBox")) {
    const std::vector<double> n = parse_number_list(box.value());
    if (n.size() != 4 || !(n[2] > 0 && n[3] > 0))
      throw FileError(fmt::format("viewBox=\"{}\" is not a box of four numbers", box.value()));
    result.low = {n[0], n[1]};
    result.size = {n[2], n[3]};
    return result;
  }
  result.size = {attribute_length(svg, "width", outer.size.x(), outer.size.x()),
                 attribute_length(svg, "height", outer.size.y(), outer.size.y())};
  return result;
}

Affine placing_of(const pugi::xml_node& svg, const Viewport& outer) {
  Affine result;
  result.offset = {attribute_length(svg, "x", outer.size.x(), 0), attribute_length(svg, "y", outer.size.y(), 0)};
  if (!svg.attribute("viewBox")) return result;
  const Viewport own = viewport_of(svg, outer);
  const Vec2 size(attribute_length(svg, "width", outer.size.x(), outer.size.x()),
                  attribute_length(svg, "height", outer.size.y(), outer.size.y()));
  if (!size.allFinite()) throw FileError("an inner <svg> with a viewBox on a page of unknown size");
  Vec2 scale = size.cwiseQuotient(own.size);
  std::vector<std::string_view> words = words_of(svg.attribute("preserveAspectRatio").value());
  if (words.empty()) words.emplace_back("xMidYMid");
  Vec2 room = Vec2::Zero();
  if (words[0] != "none") {
    const bool slice = words.size() > 1 && words[1] == "slice";
    scale.setConstant(slice ? scale.maxCoeff() : scale.minCoeff());
    room = size - scale.cwiseProduct(own.size);
    const auto share = [&](std::string_view least, std::string_view most) {
      if (words[0].find(least) != std::string_view::npos) return 0.0;
      return words[0].find(most) != std::string_view::npos ? 1.0 : 0.5;
    };
    room = room.cwiseProduct(Vec2(share("xMin", "xMax"), share("YMin", "YMax")));
  }
  result.linear = scale.asDiagonal();
  result.offset += room - scale.cwiseProduct(own.low);
  return result;
}

}  // namespace unsnarl
