#include "io/token_edits.h"

#include <fmt/format.h>

#include <cmath>

#include "io/text_scanner.h"
#include "text/read_number.h"
#include "text/write_number.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

float to_float(double value) {
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded)) throw WriteError(fmt::format("coordinate {} is too large for a 32-bit float", value));
  return rounded;
}

char* print(char* begin, char* end, double value, TextPrecision precision) {
  return precision == TextPrecision::double_digits ? write_number(begin, end, value)
                                                   : write_number(begin, end, to_float(value));
}

}  // namespace

double value_as_written(double value, TextPrecision precision) {
  switch (precision) {
    case TextPrecision::double_digits: return value;
    case TextPrecision::stored_float: return to_float(value);
    case TextPrecision::float_digits: break;
  }
  // The fewest digits of a float are not the float itself for somebody who reads them as a double.
  std::array<char, 32> digits;
  const char* end = print(digits.data(), digits.data() + digits.size(), value, precision);
  double result = 0;
  read_number(digits.data(), end, result);
  return result;
}

std::string number_text(double value, TextPrecision precision) {
  std::array<char, 32> digits;
  return {digits.data(), print(digits.data(), digits.data() + digits.size(), value, precision)};
}

void TokenEdits::replace_number(std::string_view text, std::size_t begin, double value, TextPrecision precision) {
  Edit edit{begin, static_cast<std::uint32_t>(number_token(text, begin).size()), 0, {}};
  const char* end = print(edit.digits.data(), edit.digits.data() + edit.digits.size(), value, precision);
  edit.new_length = static_cast<std::uint8_t>(end - edit.digits.data());
  edits_.push_back(edit);
}

std::string TokenEdits::apply(std::string_view text) {
  const auto before = [](const Edit& a, const Edit& b) { return a.begin < b.begin; };
  if (!std::is_sorted(edits_.begin(), edits_.end(), before)) std::sort(edits_.begin(), edits_.end(), before);
  std::string result;
  std::size_t size = text.size();
  for (const Edit& edit : edits_) size = size + edit.new_length - edit.old_length;
  result.reserve(size);
  std::size_t done = 0;
  for (const Edit& edit : edits_) {
    result.append(text, done, edit.begin - done);
    result.append(edit.digits.data(), edit.new_length);
    done = edit.begin + edit.old_length;
  }
  result.append(text, done, text.size() - done);
  return result;
}

std::vector<double> coordinates_as_written(std::span<const double> old, std::span<const double> positions,
                                           TextPrecision precision) {
  std::vector<double> result(old.begin(), old.end());
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (positions[i] == old[i]) continue;
    const double written = value_as_written(positions[i], precision);
    if (written != old[i]) result[i] = written;
  }
  return result;
}

void edit_coordinates(TokenEdits& edits, std::string_view text, std::span<const std::size_t> begins,
                      std::span<const double> old, std::span<const double> positions, TextPrecision precision) {
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (positions[i] == old[i] || value_as_written(positions[i], precision) == old[i]) continue;
    edits.replace_number(text, begins[i], positions[i], precision);
  }
}

}  // namespace unsnarl
