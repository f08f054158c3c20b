#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_edits.h"
#include "unsnarl/file_stamp.h"

namespace unsnarl {

enum class NumberType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
std::size_t size_of(NumberType type);
bool is_integer(NumberType type);

/// The name that a format gives a type of numbers.
struct NumberTypeName {
  std::string_view name;
  NumberType type;
};
/// Nothing: none of `names` is this one.
std::optional<NumberType> number_type(std::string_view name, std::span<const NumberTypeName> names);

/// The number stored at `from`, which need not be aligned; whole numbers are exact up to 2^53.
double load_number(const char* from, NumberType type, std::endian order);
/// The whole number stored at `from`, negative where it exceeds 63 bits. Nothing: it is not whole.
std::optional<std::int64_t> load_whole_number(const char* from, NumberType type, std::endian order);

/// Numbers that a file holds encoded (base64, compressed).
class EncodedNumbers {
 public:
  EncodedNumbers() = default;
  EncodedNumbers(const EncodedNumbers&) = delete;
  EncodedNumbers& operator=(const EncodedNumbers&) = delete;
  virtual ~EncodedNumbers() = default;

  /// Adds what has to change in `file` so that it holds `changed`, which is of the size of `bytes`.
  virtual void replace(std::string_view file, std::string_view changed, std::vector<TextEdit>& edits) const = 0;

  std::string bytes;  ///< decoded
};

/// A file beside the main one that holds numbers of it.
struct ExternalFile {
  std::filesystem::path name;  ///< relative to the folder of the main file
  std::string bytes;
  FileStamp stamp;
};

/// Numbers of one type behind each other, wherever and however a file keeps them.
struct NumberArray {
  NumberType type = NumberType::float32;
  std::size_t count = 0;
  std::string where;  ///< for messages: "DataArray 1 (NIFTI_INTENT_POINTSET)"
  bool is_text = false;
  ByteRange text = {};  ///< tokens separated by white space, of text

  // Binary numbers:
  std::endian order = std::endian::little;
  std::size_t start = 0;                            ///< of the first, in data()
  std::shared_ptr<const EncodedNumbers> encoded{};  ///< null: not encoded
  std::shared_ptr<const ExternalFile> external{};   ///< null: the bytes of the file itself

  std::string_view data(std::string_view file) const {
    if (encoded) return encoded->bytes;
    return external ? std::string_view(external->bytes) : file;
  }
  /// Throws FileError unless so many numbers can be there.
  void check_size(std::string_view file) const;
};

/// All numbers of an array of whole numbers; `end`, where given, becomes the place after the last one (of text).
/// Throws FileError.
std::vector<std::int64_t> whole_numbers(const NumberArray& array, std::string_view file, std::size_t* end = nullptr);

}  // namespace unsnarl
