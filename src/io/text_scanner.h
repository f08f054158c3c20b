#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

namespace unsnarl {

/// The text without the zeros and the control-Z with which some programs end a file.
inline std::string_view without_end_marks(std::string_view text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == '\x1a')) text.remove_suffix(1);
  return text;
}

/// Reads a text in memory from front to back; errors name the line. Numbers do not depend on the locale.
class TextScanner {
 public:
  struct Syntax {
    bool hash_comments = false;  ///< '#' starts a comment that ends with the line
    bool continuation = false;   ///< a backslash at the end of a line joins the next one
  };
  enum class Number : std::uint8_t { ok, missing, malformed, not_finite };

  TextScanner(std::string_view text, Syntax syntax)
      : begin_(text.data()), at_(begin_), end_(begin_ + text.size()), syntax_(syntax) {
    if (text.starts_with("\xEF\xBB\xBF")) at_ += 3;  // byte order mark
  }

  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }
  bool at_end() const { return at_ == end_; }
  void seek(std::size_t offset) { at_ = begin_ + offset; }

  /// To the next token of this line. False: there is none.
  bool skip_blanks() {
    while (at_ != end_) {
      const char c = *at_;
      if (c == ' ' || c == '\t' || c == '\v' || c == '\f') {
        ++at_;
      } else if (c == '\n' || c == '\r') {
        return false;
      } else if (c == '#' && syntax_.hash_comments) {
        return false;
      } else if (c == '\\' && syntax_.continuation && continues()) {
        skip_line_end();
      } else {
        return true;
      }
    }
    return false;
  }
  /// To the next token of the text. False: there is none.
  bool skip_space() {
    while (!skip_blanks()) {
      if (at_ == end_) return false;
      next_line();
    }
    return true;
  }
  /// To the start of the next line. Comments are never continued, other lines are where the syntax says so.
  void next_line() {
    bool comment = false;
    while (at_ != end_) {
      const char c = *at_;
      if (c == '\n' || c == '\r') return skip_line_end();
      if (c == '#' && syntax_.hash_comments) comment = true;
      if (c == '\\' && syntax_.continuation && !comment && continues()) {
        skip_line_end();
      } else {
        ++at_;
      }
    }
  }
  /// The rest of this line, without the blanks around it; goes to the next line.
  std::string_view rest_of_line();
  /// The token here (up to white space); steps over it.
  std::string_view token() {
    const char* start = at_;
    while (at_ != end_ && !ends_token(*at_)) ++at_;
    return {start, static_cast<std::size_t>(at_ - start)};
  }
  /// The token here, without stepping over it.
  std::string_view peek() {
    const char* start = at_;
    const std::string_view result = token();
    at_ = start;
    return result;
  }

  /// The number at this place, which has to fill its token; stays in front of anything else. A leading '+' is fine.
  template <class T>
  Number number(T& value);
  /// A whole number, which has to end where `stop` or white space begins; 0 stops only at white space.
  bool integer(std::int64_t& value, char stop = 0) {
    const char* start = at_;
    if (start != end_ && *start == '+') ++start;
    const auto [after, error] = std::from_chars(start, end_, value);
    if (error != std::errc{}) return false;
    if (after != end_ && !ends_token(*after) && (stop == 0 || *after != stop)) return false;
    at_ = after;
    return true;
  }
  /// A coordinate of a vertex (`vertex` as the format counts). Throws FileError unless a finite number is here.
  template <class T>
  double coordinate(std::size_t vertex) {
    T value{};
    skip_blanks();
    const Number result = number(value);
    if (result != Number::ok) fail_coordinate(result, vertex, sizeof(T) == sizeof(float));
    return value;
  }

  /// 1-based; lines end with LF, CR LF or CR.
  std::size_t line(std::size_t offset) const;
  [[noreturn]] void fail(const std::string& message) const { fail(message, offset()); }
  [[noreturn]] void fail(const std::string& message, std::size_t offset) const;

 private:
  bool ends_token(char c) const {
    return static_cast<unsigned char>(c) <= ' ' || (c == '\\' && syntax_.continuation) ||
           (c == '#' && syntax_.hash_comments);
  }
  bool continues() const { return at_ + 1 != end_ && (at_[1] == '\n' || at_[1] == '\r'); }
  void skip_line_end() {
    if (at_ != end_ && *at_ == '\\') ++at_;
    if (at_ != end_ && *at_ == '\r') {
      ++at_;
      if (at_ != end_ && *at_ == '\n') ++at_;
    } else if (at_ != end_ && *at_ == '\n') {
      ++at_;
    }
  }
  [[noreturn]] void fail_coordinate(Number reason, std::size_t vertex, bool is_float);

  const char* begin_;
  const char* at_;
  const char* end_;
  Syntax syntax_;
};

/// The token in `text` that starts at `begin`, as TextScanner delimits numbers.
std::string_view number_token(std::string_view text, std::size_t begin);

/// For messages: visible_text() of the first 30 bytes or so.
std::string in_quotes(std::string_view token);

}  // namespace unsnarl
