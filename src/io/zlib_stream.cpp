#include "io/zlib_stream.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace unsnarl {
namespace {

/// Deflate makes nothing smaller than this; zlib's Technical Details, "Maximum Compression Factor" (fixed by deflate)
constexpr std::size_t largest_zlib_ratio = 1032;
/// Window bits that ask zlib to detect the wrapper (fixed by zlib)
constexpr int any_wrapper = MAX_WBITS + 32;
/// Window bits that ask zlib for a gzip wrapper (fixed by zlib)
constexpr int gzip_wrapper = MAX_WBITS + 16;

/// Gives the stream as many bytes as its counters can count.
void offer(z_stream& z, std::string_view& input, char*& output, std::size_t& room) {
  constexpr std::size_t most = std::numeric_limits<uInt>::max();
  if (z.avail_in == 0) {
    z.avail_in = static_cast<uInt>(std::min(input.size(), most));
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(input.data()));  // zlib only reads it
    input.remove_prefix(z.avail_in);
  }
  if (z.avail_out == 0) {
    z.avail_out = static_cast<uInt>(std::min(room, most));
    z.next_out = reinterpret_cast<Bytef*>(output);
    output += z.avail_out;
    room -= z.avail_out;
  }
}

}  // namespace

std::optional<std::string> inflated(std::string_view stream, std::size_t size) {
  if (size / largest_zlib_ratio > stream.size()) return std::nullopt;
  std::string result(size + 1, '\0');  // one more, to see a stream that is too long
  z_stream z{};
  if (inflateInit2(&z, any_wrapper) != Z_OK) throw std::bad_alloc();
  char* output = result.data();
  std::size_t room = result.size();
  int status = Z_OK;
  while (status == Z_OK) {
    offer(z, stream, output, room);
    status = inflate(&z, Z_NO_FLUSH);
  }
  const std::size_t got = result.size() - room - z.avail_out;
  inflateEnd(&z);
  if (status != Z_STREAM_END || got != size) return std::nullopt;
  result.pop_back();
  return result;
}

std::string deflated(std::string_view bytes, bool as_gzip) {
  z_stream z{};
  if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, as_gzip ? gzip_wrapper : MAX_WBITS, 8, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::bad_alloc();
  std::string result(deflateBound(&z, static_cast<uLong>(bytes.size())), '\0');
  char* output = result.data();
  std::size_t room = result.size();
  int status = Z_OK;
  while (status == Z_OK) {
    offer(z, bytes, output, room);
    status = deflate(&z, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
  }
  result.resize(result.size() - room - z.avail_out);
  deflateEnd(&z);
  if (status != Z_STREAM_END) throw std::logic_error("zlib cannot compress");
  return result;
}

}  // namespace unsnarl
