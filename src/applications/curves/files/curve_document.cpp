#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "applications/curves/curve_net.h"
#include "applications/curves/files/curve_file.h"
#include "geometry/portable_math.h"
#include "io/mesh_file.h"
#include "text/read_number.h"
#include "text/write_number.h"

namespace unsnarl {
namespace {

/// Moved coordinates are rounded to multiples of about this: far below any gap, and short in a text (unit: bounding-box
/// diagonal)
constexpr double written_rel = 1e-9;

/// Largest tolerance of flattening curves that may be asked for (unit: bounding-box diagonal)
constexpr double largest_flatten_rel = 0.1;

void check_flattening(double flatten_rel) {
  if (!(flatten_rel > 0 && flatten_rel <= largest_flatten_rel))
    throw std::invalid_argument(
        fmt::format("flatten_rel is {}; give a number in (0, {}]", flatten_rel, largest_flatten_rel));
}

}  // namespace

std::string digits_of(double value) {
  std::array<char, 32> digits;
  return {digits.data(), write_number(digits.data(), digits.data() + digits.size(), value)};
}

double rounded(double value, double rounding) {
  if (!(rounding > 0)) return value;
  constexpr double slack = 1e-9;  // far above the error of the logarithm of a power of ten (no unit)
  const double decimals = std::ceil(-portable::log(rounding) / portable::log(10) - slack);
  if (!(decimals >= 0 && decimals <= 300)) return value;
  // By way of the text, so that few digits give it back.
  const std::string text = fmt::format("{:.{}f}", value, static_cast<int>(decimals));
  double result = value;
  read_number(text.data(), text.data() + text.size(), result);
  return result == 0 ? 0 : result;
}

std::string_view to_string(CurveFormat format) {
  return format == CurveFormat::svg ? "svg" : "json";
}

std::optional<CurveFormat> curve_format_from_extension(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  std::string name(dot == std::string_view::npos ? path : path.substr(dot + 1));
  for (char& c : name) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (name == "svg") return CurveFormat::svg;
  if (name == "json") return CurveFormat::json;
  return {};
}

CurveDocument::CurveDocument(CurveFormat format, std::unique_ptr<CurveFile> file)
    : format_(format), file_(std::move(file)) {}
CurveDocument::CurveDocument(CurveDocument&&) noexcept = default;
CurveDocument& CurveDocument::operator=(CurveDocument&&) noexcept = default;
CurveDocument::~CurveDocument() = default;

CurveDocument CurveDocument::parse(std::string bytes, CurveFormat format, double flatten_rel) {
  check_flattening(flatten_rel);
  CurveDocument document(format, format == CurveFormat::svg ? parse_svg(std::move(bytes), flatten_rel)
                                                            : parse_curve_json(std::move(bytes)));
  try {
    check_curves(document.curves());
  } catch (const std::invalid_argument& e) {
    throw FileError(e.what());
  }
  return document;
}

CurveDocument CurveDocument::read(const std::string& path, double flatten_rel, std::optional<CurveFormat> format) {
  if (!format) format = curve_format_from_extension(path);
  if (!format) throw FileError(path + ": its name does not tell the format; name it *.svg or *.json");
  std::string bytes = read_file(path);
  try {
    return parse(std::move(bytes), *format, flatten_rel);
  } catch (const FileError& e) {
    throw FileError(fmt::format("{}: {}", path, e.what()), e.error_number());
  }
}

CurveFormat CurveDocument::format() const {
  return format_;
}
const std::vector<Curve>& CurveDocument::curves() const {
  return file_->curves;
}
const std::vector<std::string>& CurveDocument::ids() const {
  return file_->ids;
}
const std::vector<std::string>& CurveDocument::notes() const {
  return file_->notes;
}

std::string CurveDocument::patched(std::span<const Curve> curves, bool all_digits,
                                   std::span<const CurveWriting> writing) const {
  if (curves.size() != file_->curves.size())
    throw std::invalid_argument(fmt::format("{} curves for a file of {}", curves.size(), file_->curves.size()));
  if (!writing.empty() && writing.size() != curves.size())
    throw std::invalid_argument(fmt::format("ways to write {} curves, of {}", writing.size(), curves.size()));
  return file_->patched(curves, all_digits ? 0 : written_rel * diagonal_of(file_->curves), writing);
}

std::vector<Curve> CurveDocument::read_back(const std::string& bytes, double part_of_tolerance) const {
  if (!(part_of_tolerance > 0 && part_of_tolerance <= 1))
    throw std::invalid_argument(fmt::format("part_of_tolerance is {}; give a number in (0, 1]", part_of_tolerance));
  return file_->parse_alike(bytes, part_of_tolerance)->curves;
}

}  // namespace unsnarl
