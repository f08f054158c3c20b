#pragma once

#include <zlib.h>

#include <string>
#include <utility>
#include <vector>

#include "io/packed_numbers.h"

namespace unsnarl {

/// A ZIP archive of these entries, stored or deflated.
inline std::string zip_of(const std::vector<std::pair<std::string, std::string>>& entries, bool is_compressed) {
  constexpr std::endian little = std::endian::little;
  const auto words = [](std::initializer_list<double> numbers) { return packed<std::uint16_t>(numbers, little); };
  const auto longs = [](std::initializer_list<double> numbers) { return packed<std::uint32_t>(numbers, little); };
  std::string bytes, directory;
  for (const auto& [name, content] : entries) {
    std::string data = content;
    if (is_compressed) {
      data.resize(compressBound(content.size()) + 64);
      z_stream z{};
      deflateInit2(&z, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
      z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
      z.avail_in = static_cast<uInt>(content.size());
      z.next_out = reinterpret_cast<Bytef*>(data.data());
      z.avail_out = static_cast<uInt>(data.size());
      deflate(&z, Z_FINISH);
      data.resize(z.total_out);
      deflateEnd(&z);
    }
    const auto checksum = crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
    // Version, flags, method, time and date (2020-01-01 12:00), checksum, sizes, lengths of name and extra fields.
    const std::string common = words({20, 0, is_compressed ? 8. : 0., 0x6000, 0x5021}) +
                               longs({double(checksum), double(data.size()), double(content.size())}) +
                               words({double(name.size()), 0});
    directory += "PK\1\2" + words({20}) + common + words({0, 0, 0}) + longs({0, double(bytes.size())}) + name;
    bytes += "PK\3\4" + common + name + data;
  }
  const double n = double(entries.size());
  return bytes + directory + "PK\5\6" + words({0, 0, n, n}) + longs({double(directory.size()), double(bytes.size())}) +
         words({0});
}

}  // namespace unsnarl
