#include "applications/curves/files/path_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/portable_math.h"
#include "text/read_number.h"

namespace unsnarl {
namespace {

constexpr double most_pieces = 10000;  ///< A curve is cut into this many pieces at most (unit: pieces)
constexpr double rough_pieces = 16;    ///< Pieces of a curve that is only measured (unit: pieces)

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::size_t offset() const { return at_; }
  void skip() {
    while (at_ < text_.size() && (is_space(text_[at_]) || text_[at_] == ',')) ++at_;
  }
  bool at_end() {
    skip();
    return at_ == text_.size();
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  char take() { return text_[at_++]; }
  bool at_number() {
    skip();
    const char c = peek();
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  }
  double number() {
    skip();
    const std::size_t begin = at_;
    if (peek() == '+') ++at_;
    double value = 0;
    const auto [end, error] = read_number(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) {
      const std::string_view word = text_.substr(begin, 20);
      throw FileError(fmt::format("'{}' at character {} is not a number that can be used", word, begin));
    }
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }
  Vec2 point() {
    const double x = number();
    return {x, number()};
  }
  bool flag() {
    skip();
    const char c = peek();
    if (c != '0' && c != '1') throw FileError(fmt::format("the flag of an arc at character {} is not 0 or 1", at_));
    ++at_;
    return c == '1';
  }
  std::string_view word() {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]))) ++at_;
    return text_.substr(begin, at_ - begin);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
  std::string_view text_;
  std::size_t at_ = 0;
};

/// A number of pieces: `wanted`, rounded up, in bounds.
int pieces(double wanted, double tolerance) {
  const double least = std::isinf(tolerance) ? rough_pieces : 1;
  return static_cast<int>(std::ceil(wanted > least ? std::min(wanted, most_pieces) : least));  // `least` for no number
}

/// Pieces of equal parameter that a Bézier curve of a degree needs: a bound by its second differences (Wang 1984).
int pieces_of(double second_difference, int degree, double tolerance) {
  return pieces(std::sqrt(degree * (degree - 1) / 8.0 * second_difference / tolerance), tolerance);
}

/// Adds points to a subpath, with the pieces that lead to them.
class Flattening {
 public:
  Flattening(Subpath& subpath, int command, double tolerance)
      : subpath_(subpath), command_(command), tolerance_(tolerance) {}

  void line(const Vec2& to) {
    subpath_.points.push_back(to);
    subpath_.pieces.emplace_back();
  }
  void quadratic(const Vec2& b, const Vec2& c) {
    const Vec2 a = subpath_.points.back();
    add(
        pieces_of((a - 2 * b + c).norm(), 2, tolerance_), c,
        [&](double t, double u) -> Vec2 { return u * u * a + 2 * t * u * b + t * t * c; },
        [&](double t, double u) -> Vec2 { return 2 * (u * (b - a) + t * (c - b)); });
  }
  void cubic(const Vec2& b, const Vec2& c, const Vec2& d) {
    const Vec2 a = subpath_.points.back();
    add(
        pieces_of(std::max((a - 2 * b + c).norm(), (b - 2 * c + d).norm()), 3, tolerance_), d,
        [&](double t, double u) -> Vec2 {
          return u * u * u * a + 3 * t * u * u * b + 3 * t * t * u * c + t * t * t * d;
        },
        [&](double t, double u) -> Vec2 { return 3 * (u * u * (b - a) + 2 * t * u * (c - b) + t * t * (d - c)); });
  }
  /// SVG 1.1, appendix F.6: from end points to centre.
  void arc(Vec2 radii, double degrees, bool large, bool sweep, const Vec2& to) {
    const Vec2 from = subpath_.points.back();
    radii = radii.cwiseAbs();
    if (from == to) return;
    if (radii.x() == 0 || radii.y() == 0) return line(to);
    const double angle = degrees * std::numbers::pi / 180;
    Eigen::Matrix2d turn;
    turn << portable::cos(angle), -portable::sin(angle), portable::sin(angle), portable::cos(angle);
    const Vec2 p = turn.transpose() * (0.5 * (from - to));
    const double too_small = p.cwiseQuotient(radii).squaredNorm();
    if (too_small > 1) radii *= std::sqrt(too_small);
    const Vec2 q = p.cwiseQuotient(radii);
    const double factor = std::sqrt(std::max(0.0, 1 / q.squaredNorm() - 1)) * (large == sweep ? -1 : 1);
    const Vec2 centre_unit(factor * q.y(), -factor * q.x());
    const Vec2 centre = turn * centre_unit.cwiseProduct(radii) + 0.5 * (from + to);
    const Vec2 u = q - centre_unit, v = -q - centre_unit;
    const double first = portable::atan2(u.y(), u.x());
    double swept = portable::atan2(v.y(), v.x()) - first;
    if (sweep && swept < 0) swept += 2 * std::numbers::pi;
    if (!sweep && swept > 0) swept -= 2 * std::numbers::pi;
    const double step = 2 * portable::acos(std::max(0.0, 1 - tolerance_ / radii.maxCoeff()));
    turn_ = std::abs(swept);
    add(
        pieces(turn_ / step, tolerance_), to,
        [&](double t, double) -> Vec2 {
          const double at = first + swept * t;
          return centre + turn * Vec2(radii.x() * portable::cos(at), radii.y() * portable::sin(at));
        },
        [&](double t, double) -> Vec2 {
          const double at = first + swept * t;
          return swept * (turn * Vec2(-radii.x() * portable::sin(at), radii.y() * portable::cos(at)));
        });
  }

 private:
  /// A curve up to `to`, in n pieces of equal parameter t; functions of t and 1 - t.
  template <class Position, class Derivative>
  void add(int n, const Vec2& to, Position&& position, Derivative&& derivative) {
    Vec2 direction = derivative(0.0, 1.0);
    for (int k = 1; k <= n; ++k) {
      const double t = static_cast<double>(k) / n, before = static_cast<double>(k - 1) / n;
      const Vec2 next = derivative(t, 1 - t);
      subpath_.pieces.push_back({command_, before, t, direction, next, turn_});
      subpath_.points.push_back(k < n ? position(t, 1 - t) : to);
      direction = next;
    }
  }

  Subpath& subpath_;
  int command_;
  double tolerance_;
  double turn_ = 0;
};

/// State between the commands of a path.
struct Pen {
  Vec2 at = Vec2::Zero();
  Vec2 control = Vec2::Zero();  ///< the last one of a Bézier, which S and T reflect
  char last = 0;                ///< the command before, as a capital
};

/// Adds to the subpath what a command other than M draws. False: there is no such command.
bool draw(char kind, bool relative, Reader& reader, Pen& pen, Subpath& subpath, int command, double tolerance) {
  const Vec2 origin = relative ? pen.at : Vec2(0, 0);
  const auto follows = [&](char one, char other) { return pen.last == one || pen.last == other; };
  Flattening flattened(subpath, command, tolerance);
  Vec2 to = pen.at;
  switch (kind) {
    case 'Z':
      subpath.closed = true;
      subpath.end = reader.offset();
      pen.at = subpath.start;
      return true;
    case 'L':
      to = reader.point() + origin;
      flattened.line(to);
      break;
    case 'H':
      to.x() = reader.number() + origin.x();
      flattened.line(to);
      break;
    case 'V':
      to.y() = reader.number() + origin.y();
      flattened.line(to);
      break;
    case 'C':
    case 'S': {
      Vec2 first = pen.at;
      if (kind == 'C') {
        first = reader.point() + origin;
      } else if (follows('C', 'S')) {
        first = 2 * pen.at - pen.control;
      }
      pen.control = reader.point() + origin;
      to = reader.point() + origin;
      flattened.cubic(first, pen.control, to);
      break;
    }
    case 'Q':
    case 'T':
      if (kind == 'Q') {
        pen.control = reader.point() + origin;
      } else {
        pen.control = follows('Q', 'T') ? Vec2(2 * pen.at - pen.control) : pen.at;
      }
      to = reader.point() + origin;
      flattened.quadratic(pen.control, to);
      break;
    case 'A': {
      const Vec2 radii = reader.point();
      const double degrees = reader.number();
      const bool large = reader.flag(), sweep = reader.flag();
      to = reader.point() + origin;
      flattened.arc(radii, degrees, large, sweep, to);
      break;
    }
    default: return false;
  }
  subpath.has_curves |= kind != 'L' && kind != 'H' && kind != 'V';
  pen.at = to;
  return true;
}

}  // namespace

DrawnPiece transformed(DrawnPiece piece, const Affine& transform) {
  if (transform.is_identity()) return piece;
  piece.from = transform.linear * piece.from;
  piece.to = transform.linear * piece.to;
  return piece;
}

std::vector<double> parse_number_list(std::string_view text) {
  Reader reader(text);
  std::vector<double> numbers;
  while (!reader.at_end()) numbers.push_back(reader.number());
  return numbers;
}

Affine parse_transform(std::string_view text) {
  Affine result;
  Reader reader(text);
  while (!reader.at_end()) {
    const std::size_t begin = reader.offset();
    const std::string_view name = reader.word();
    std::vector<double> n;
    reader.skip();
    if (reader.peek() == '(') {
      reader.take();
      while (reader.at_number()) n.push_back(reader.number());
      reader.skip();
    }
    if (n.empty() || reader.peek() != ')')
      throw FileError(fmt::format("the transform at character {} cannot be read; give NAME(NUMBERS)", begin));
    reader.take();
    Affine step;
    constexpr double degree = std::numbers::pi / 180;  ///< A degree in radians (fixed by geometry)
    if (name == "matrix" && n.size() == 6) {
      step.linear << n[0], n[2], n[1], n[3];
      step.offset << n[4], n[5];
    } else if (name == "translate" && n.size() <= 2) {
      step.offset << n[0], n.size() == 2 ? n[1] : 0;
    } else if (name == "scale" && n.size() <= 2) {
      step.linear << n[0], 0, 0, n.back();
    } else if (name == "rotate" && (n.size() == 1 || n.size() == 3)) {
      const double c = portable::cos(n[0] * degree), s = portable::sin(n[0] * degree);
      step.linear << c, -s, s, c;
      if (n.size() == 3) step.offset = Vec2(n[1], n[2]) - step.linear * Vec2(n[1], n[2]);
    } else if (name == "skewX" && n.size() == 1) {
      step.linear(0, 1) = portable::tan(n[0] * degree);
    } else if (name == "skewY" && n.size() == 1) {
      step.linear(1, 0) = portable::tan(n[0] * degree);
    } else {
      throw FileError(
          fmt::format("'{}' with {} numbers is not a known transform (matrix, translate, scale, rotate, skewX, "
                      "skewY)",
                      name, n.size()));
    }
    result = result * step;
  }
  return result;
}

std::vector<Subpath> parse_path_data(std::string_view text, double tolerance) {
  std::vector<Subpath> result;
  Reader reader(text);
  Pen pen;
  char command = 0;
  // `behind`: the end of the subpath before, unless it was closed.
  const auto open = [&](const Vec2& start, std::size_t behind) {
    if (!result.empty() && result.back().end == 0) result.back().end = behind;
    result.emplace_back();
    result.back().start = pen.at = start;
    result.back().points.push_back(start);
  };
  int commands = 0;
  bool needs_subpath = true;  // after a close-path, unless a move-to follows
  while (!reader.at_end()) {
    const std::size_t begin = reader.offset();
    if (!reader.at_number()) {
      command = reader.take();
    } else if (command == 0 || command == 'Z' || command == 'z') {
      throw FileError(fmt::format("a command is missing at character {} of the path data", begin));
    }
    const bool relative = command >= 'a';
    const char kind = static_cast<char>(relative ? command - 'a' + 'A' : command);
    if (result.empty() && kind != 'M')
      throw FileError(fmt::format("path data starts with '{}'; it has to start with M or m", command));
    if (kind == 'M') {
      open(reader.point() + (relative ? pen.at : Vec2(0, 0)), begin);
      result.back().begin = reader.offset();
      command = relative ? 'l' : 'L';  // further pairs are lines
      if (reader.at_number()) result.back().implicit = command;
    } else {
      if (needs_subpath) {
        open(Vec2(result.back().start), begin);
        result.back().begin = begin;
      }
      if (!draw(kind, relative, reader, pen, result.back(), commands++, tolerance))
        throw FileError(fmt::format("'{}' at character {} is not a command of path data", command, begin));
    }
    needs_subpath = kind == 'Z';
    pen.last = kind;
  }
  if (!result.empty() && result.back().end == 0) result.back().end = text.size();
  return result;
}

}  // namespace unsnarl
