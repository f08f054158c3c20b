#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// What a computation gave, as bytes: numbers by their bits, so that two results are the same or not.
namespace unsnarl::same_bytes {

class Bytes {
 public:
  Bytes& operator<<(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  Bytes& operator<<(double number) {
    append(number);
    return *this;
  }
  /// As 64 bits: some whole numbers have another size elsewhere.
  template <class Whole, class = std::enable_if_t<std::is_integral_v<Whole> || std::is_enum_v<Whole>>>
  Bytes& operator<<(Whole number) {
    append(static_cast<std::int64_t>(number));
    return *this;
  }
  template <class Number>
  Bytes& operator<<(const std::vector<Number>& numbers) {
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
    return *this;
  }

  /// FNV-1a, 64 bits.
  std::uint64_t hash() const {
    std::uint64_t value = 0xcbf29ce484222325;
    for (const char c : bytes_) value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return value;
  }

 private:
  template <class Number>
  void append(Number number) {
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }

  std::string bytes_;
};

/// Fails unless the bytes are those that known_hashes.inc has by this name. Prints its line: the lines that begin with
/// `{"` of what all programs of this folder print are the file.
void expect_known(std::string_view name, const Bytes& bytes);

}  // namespace unsnarl::same_bytes
