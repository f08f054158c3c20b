#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/document.h"

namespace unsnarl {

/// Small whole numbers in a fixed order, the same on every machine.
class FixedNumbers {
 public:
  std::uint32_t next(std::uint32_t below) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::uint32_t>(state_ >> 33) % below;
  }

 private:
  std::uint64_t state_ = 1;
};

inline bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

/// The main file after moving to `positions`.
inline std::string patched_bytes(const Document& document, std::span<const double> positions,
                                 bool float32_digits = false) {
  return document.patched(positions, float32_digits).front().bytes;
}

/// The message of the error that parsing ends with; empty when it does not.
inline std::string parse_error(std::string bytes, Format format) {
  try {
    Document::parse(std::move(bytes), format);
  } catch (const FileError& error) {
    return error.what();
  }
  return {};
}

#define EXPECT_PARSE_ERROR(bytes, format, part) EXPECT_PRED2(message_contains, parse_error(bytes, format), part)
inline bool message_contains(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

/// What every document promises, tried on this one: no motion gives the bytes back; any motion reads back, bit for
/// bit, as as_written() said, leaves what did not move alone, and moving back by re-reading changes nothing more.
inline void check_patching(const std::string& bytes, Format format) {
  SCOPED_TRACE(bytes.substr(0, 60));
  const Document document = Document::parse(bytes, format);
  const std::vector<double>& old = document.surface().positions;
  ASSERT_FALSE(old.empty());
  FixedNumbers numbers;
  for (const bool float32_digits : {false, true}) {
    EXPECT_EQ(patched_bytes(document, old, float32_digits), bytes);
    EXPECT_TRUE(same_bits(document.as_written(old, float32_digits), old));
    std::vector<double> moved = old;
    for (double& x : moved) {
      if (numbers.next(2) == 0) x += (numbers.next(2001) - 1000.0) / 997 * (1 + std::abs(x));
    }
    const std::vector<double> written = document.as_written(moved, float32_digits);
    const Document again = Document::parse(patched_bytes(document, moved, float32_digits), format);
    EXPECT_TRUE(same_bits(again.surface().positions, written));
    EXPECT_EQ(again.surface().corners, document.surface().corners);
    EXPECT_EQ(again.surface().offsets, document.surface().offsets);
    for (std::size_t v = 0; v < old.size() / 3; ++v) {
      const bool is_moved = !std::equal(moved.begin() + 3 * v, moved.begin() + 3 * v + 3, old.begin() + 3 * v);
      for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) {
        if (!is_moved) {
          EXPECT_EQ(written[i], old[i]);
        } else {
          EXPECT_NEAR(written[i], moved[i], 1e-5 * (1 + std::abs(moved[i])));
        }
      }
    }
    EXPECT_EQ(patched_bytes(again, written, float32_digits), patched_bytes(document, moved, float32_digits));
  }
}

/// Cut short anywhere and with any byte changed, a file is either read or refused with a FileError; and what was read
/// still keeps the promises that no motion demands.
inline void check_damage(const std::string& bytes, Format format) {
  const auto survive = [format](std::string damaged) {
    try {
      const std::string copy = damaged;
      const Document document = Document::parse(std::move(damaged), format);
      EXPECT_EQ(patched_bytes(document, document.surface().positions), copy);
      const SurfaceView view = document.surface();
      for (std::size_t f = 0; f < view.face_count(); ++f) {
        EXPECT_GE(view.face(f).size(), 3u);
        for (const std::int32_t v : view.face(f)) {
          EXPECT_GE(v, 0);
          EXPECT_LT(static_cast<std::size_t>(v), view.vertex_count());
        }
      }
    } catch (const FileError&) {
    }
  };
  for (std::size_t size = 0; size < bytes.size(); ++size) survive(bytes.substr(0, size));
  FixedNumbers numbers;
  constexpr std::string_view nasty = "09-+.eE/\\# \t\r\n\"{}[],:\xFF\x7F\x80\x01";
  for (std::size_t round = 0; round < 4000; ++round) {
    std::string damaged = bytes;
    const std::uint32_t changes = 1 + numbers.next(4);
    for (std::uint32_t k = 0; k < changes; ++k) {
      char& c = damaged[numbers.next(static_cast<std::uint32_t>(bytes.size()))];
      const std::uint32_t kind = numbers.next(static_cast<std::uint32_t>(nasty.size()) + 8);
      c = kind < nasty.size() ? nasty[kind] : static_cast<char>(numbers.next(256));
    }
    survive(damaged);
  }
}

/// The text with its first `from` replaced.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace unsnarl
