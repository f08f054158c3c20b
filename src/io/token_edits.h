#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace unsnarl {

/// How a text file holds its coordinates.
enum class TextPrecision : std::uint8_t {
  double_digits,  ///< read as double; written so that the double comes back
  float_digits,   ///< read as double; written with the digits of the nearest float32
  stored_float,   ///< read as float32 (the file declares it so)
};

/// The value that a reader finds where `value` was written. Throws WriteError beyond float32.
double value_as_written(double value, TextPrecision precision);

/// The fewest digits that give `value` back at this precision. Throws WriteError beyond float32.
std::string number_text(double value, TextPrecision precision);

/// Replacements of tokens in a text, each at most 32 characters long.
class TokenEdits {
 public:
  /// The token that starts at `begin` becomes `value`, in the fewest digits that give it back at this precision.
  void replace_number(std::string_view text, std::size_t begin, double value, TextPrecision precision);
  /// The text with all replacements made.
  std::string apply(std::string_view text);

 private:
  struct Edit {
    std::size_t begin;
    std::uint32_t old_length;
    std::uint8_t new_length;
    std::array<char, 32> digits;
  };
  std::vector<Edit> edits_;
};

/// positions[i] where it reads back as different from old[i], else old[i]: what the text will hold.
std::vector<double> coordinates_as_written(std::span<const double> old, std::span<const double> positions,
                                           TextPrecision precision);

/// Replaces the tokens (starting at begins[i]) of all coordinates that read back as different from old[i].
void edit_coordinates(TokenEdits& edits, std::string_view text, std::span<const std::size_t> begins,
                      std::span<const double> old, std::span<const double> positions, TextPrecision precision);

}  // namespace unsnarl
