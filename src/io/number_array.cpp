#include "io/number_array.h"

#include <fmt/format.h>

#include <cmath>

#include "io/byte_order.h"
#include "io/text_scanner.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

/// Whole numbers below it are exact, 2^53 (fixed by float64)
constexpr double largest_exact = 9007199254740992;

/// Calls use(T{}) with the C++ type of the stored numbers.
template <class Use>
auto with_type(NumberType type, Use use) {
  switch (type) {
    case NumberType::int8: return use(std::int8_t{});
    case NumberType::uint8: return use(std::uint8_t{});
    case NumberType::int16: return use(std::int16_t{});
    case NumberType::uint16: return use(std::uint16_t{});
    case NumberType::int32: return use(std::int32_t{});
    case NumberType::uint32: return use(std::uint32_t{});
    case NumberType::int64: return use(std::int64_t{});
    case NumberType::uint64: return use(std::uint64_t{});
    case NumberType::float32: return use(float{});
    default: return use(double{});
  }
}

}  // namespace

std::size_t size_of(NumberType type) {
  return with_type(type, [](auto zero) { return sizeof(zero); });
}

bool is_integer(NumberType type) {
  return type != NumberType::float32 && type != NumberType::float64;
}

std::optional<NumberType> number_type(std::string_view name, std::span<const NumberTypeName> names) {
  const auto found = std::find_if(names.begin(), names.end(), [&](const NumberTypeName& t) { return t.name == name; });
  return found != names.end() ? std::optional(found->type) : std::nullopt;
}

double load_number(const char* from, NumberType type, std::endian order) {
  return with_type(type, [&](auto zero) { return static_cast<double>(load<decltype(zero)>(from, order)); });
}

std::optional<std::int64_t> load_whole_number(const char* from, NumberType type, std::endian order) {
  return with_type(type, [&](auto zero) -> std::optional<std::int64_t> {
    using T = decltype(zero);
    const T value = load<T>(from, order);
    if constexpr (!std::is_integral_v<T>) {
      if (!(std::abs(value) < largest_exact) || value != std::floor(value)) return std::nullopt;
    }
    return static_cast<std::int64_t>(value);
  });
}

void NumberArray::check_size(std::string_view file) const {
  if (is_text) {
    if (count > (text.size + 1) / 2) {
      TextScanner(file, {}).fail(
          fmt::format("{} should hold {} numbers, but only {} characters follow; the file is cut short or damaged",
                      where, count, text.size),
          text.begin);
    }
    return;
  }
  const std::size_t available = data(file).size() < start ? 0 : data(file).size() - start;
  if (count <= available / size_of(type)) return;
  throw FileError(
      fmt::format("{}{} should hold {} numbers of {} bytes, but has {} bytes; the file is cut short or damaged",
                  encoded ? std::string() : fmt::format("byte {}: ", start), where, count, size_of(type), available));
}

std::vector<std::int64_t> whole_numbers(const NumberArray& array, std::string_view file, std::size_t* end) {
  array.check_size(file);
  std::vector<std::int64_t> result(array.count);
  if (!array.is_text) {
    const char* at = array.data(file).data() + array.start;
    for (std::size_t i = 0; i < array.count; ++i) {
      const std::optional<std::int64_t> number =
          load_whole_number(at + i * size_of(array.type), array.type, array.order);
      if (!number) throw FileError(fmt::format("{}: number {} (counting from 0) is not whole", array.where, i));
      result[i] = *number;
    }
    return result;
  }
  TextScanner text(file.substr(0, array.text.begin + array.text.size), {});
  text.seek(array.text.begin);
  for (std::int64_t& number : result) {
    if (!text.skip_space())
      text.fail(fmt::format("{} ends after {} of {} numbers; the file is cut short or damaged", array.where,
                            &number - result.data(), array.count));
    if (text.integer(number)) continue;
    const std::string_view token = text.peek();
    double value = 0;  // some write 3.0
    if (is_integer(array.type) || text.number(value) != TextScanner::Number::ok || value != std::floor(value) ||
        !(std::abs(value) < largest_exact))
      text.fail(fmt::format("{} in {} where a whole number should be", in_quotes(token), array.where));
    number = static_cast<std::int64_t>(value);
  }
  if (end != nullptr) *end = text.offset();
  return result;
}

}  // namespace unsnarl
