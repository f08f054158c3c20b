#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace unsnarl {

/// A power of two by which given numbers are divided, so that no product of lengths over- or underflows. Scaling in is
/// exact; scaling out is exact unless double has no such number.
class Scale {
 public:
  /// Coordinates from 2^-largest_exponent to 2^largest_exponent are taken as they are: products of eight lengths do not
  /// overflow [E180] (unit: binary exponent)
  static constexpr int largest_exponent = 100;

  Scale() = default;
  /// Brings the largest magnitude into [0.5, 1), or is one where that magnitude is moderate. Ignores numbers that are
  /// not finite.
  explicit Scale(std::span<const double> numbers) {
    double largest = 0, smallest = std::numeric_limits<double>::max();
    for (const double number : numbers) {
      const double magnitude = std::abs(number);
      if (!(magnitude > 0 && magnitude <= std::numeric_limits<double>::max())) continue;
      largest = std::max(largest, magnitude);
      smallest = std::min(smallest, magnitude);
    }
    if (largest == 0) return;
    exponent_ = exponent_of(largest);
    if (std::abs(exponent_) <= largest_exponent) exponent_ = 0;
    // No bit of the smallest may fall below what double holds.
    if (exponent_ > 0) exponent_ = std::min(exponent_, std::max(0, exponent_of(smallest) + 1021));
  }

  /// A number given is number_in * 2^exponent().
  int exponent() const { return exponent_; }
  bool is_one() const { return exponent_ == 0; }
  double in(double number) const { return is_one() ? number : std::ldexp(number, -exponent_); }
  /// Beyond double: its largest number.
  double out(double number) const {
    constexpr double largest = std::numeric_limits<double>::max();
    return is_one() ? number : std::clamp(std::ldexp(number, exponent_), -largest, largest);
  }
  std::vector<double> in(std::span<const double> numbers) const {
    std::vector<double> scaled(numbers.begin(), numbers.end());
    if (!is_one())
      for (double& number : scaled) number = in(number);
    return scaled;
  }

 private:
  static int exponent_of(double magnitude) {
    int exponent = 0;
    std::frexp(magnitude, &exponent);
    return exponent;
  }

  int exponent_ = 0;
};

}  // namespace unsnarl
