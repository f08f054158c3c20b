#include "io/number_array.h"

#include <gtest/gtest.h>

#include "packed_numbers.h"
#include "unsnarl/document.h"

namespace unsnarl::number_arrays {
namespace {

constexpr std::endian little = std::endian::little, big = std::endian::big;

TEST(NumberArray, loads_every_type_in_both_orders) {
  for (const std::endian order : {little, big}) {
    const auto loaded = [order](const std::string& bytes, NumberType type) {
      EXPECT_EQ(bytes.size(), size_of(type));
      return load_number(bytes.data(), type, order);
    };
    EXPECT_EQ(loaded(packed<std::int8_t>({-7}, order), NumberType::int8), -7);
    EXPECT_EQ(loaded(packed<std::uint8_t>({200}, order), NumberType::uint8), 200);
    EXPECT_EQ(loaded(packed<std::int16_t>({-700}, order), NumberType::int16), -700);
    EXPECT_EQ(loaded(packed<std::uint16_t>({60000}, order), NumberType::uint16), 60000);
    EXPECT_EQ(loaded(packed<std::int32_t>({-70000}, order), NumberType::int32), -70000);
    EXPECT_EQ(loaded(packed<std::uint32_t>({4e9}, order), NumberType::uint32), 4e9);
    EXPECT_EQ(loaded(packed<std::int64_t>({-5e12}, order), NumberType::int64), -5e12);
    EXPECT_EQ(loaded(packed<std::uint64_t>({5e12}, order), NumberType::uint64), 5e12);
    EXPECT_EQ(loaded(packed<float>({-1.5}, order), NumberType::float32), -1.5);
    EXPECT_EQ(loaded(packed<double>({0.1}, order), NumberType::float64), 0.1);
  }
}

TEST(NumberArray, whole_numbers_are_whole) {
  EXPECT_EQ(load_whole_number(packed<float>({3}, big).data(), NumberType::float32, big), 3);
  EXPECT_EQ(load_whole_number(packed<float>({3.5}, big).data(), NumberType::float32, big), std::nullopt);
  EXPECT_EQ(load_whole_number(packed<double>({1e300}, big).data(), NumberType::float64, big), std::nullopt);
  EXPECT_LT(*load_whole_number("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF", NumberType::uint64, big), 0);
}

TEST(NumberArray, sizes_are_checked_before_memory_is_asked_for) {
  const std::string bytes = "xx" + packed<std::int32_t>({1, 2, 3}, little);
  NumberArray array{.type = NumberType::int32, .count = 3, .where = "faces", .start = 2};
  EXPECT_EQ(whole_numbers(array, bytes), (std::vector<std::int64_t>{1, 2, 3}));
  array.count = std::size_t{1} << 61;
  EXPECT_THROW(whole_numbers(array, bytes), FileError);
  array.start = 100;
  array.count = 1;
  EXPECT_THROW(whole_numbers(array, bytes), FileError);
  EXPECT_THROW(whole_numbers({.count = 3, .where = "faces", .is_text = true, .text = {0, 4}}, "1 2 "), FileError);
}

TEST(NumberArray, text_says_where_it_ends) {
  std::size_t end = 0;
  const NumberArray array{.type = NumberType::int32, .count = 2, .where = "faces", .is_text = true, .text = {2, 8}};
  EXPECT_EQ(whole_numbers(array, "x 10\n 20 30", &end), (std::vector<std::int64_t>{10, 20}));
  EXPECT_EQ(end, 8u);
}

}  // namespace
}  // namespace unsnarl::number_arrays
