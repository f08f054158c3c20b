#include "io/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "text/read_number.h"
#include "unsnarl/depth_limit.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

void append_utf8(std::string& to, std::uint32_t code) {
  if (code < 0x80) {
    to += static_cast<char>(code);
  } else if (code < 0x800) {
    to += static_cast<char>(0xC0 | code >> 6);
    to += static_cast<char>(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    to += static_cast<char>(0xE0 | code >> 12);
    to += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    to += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    to += static_cast<char>(0xF0 | code >> 18);
    to += static_cast<char>(0x80 | (code >> 12 & 0x3F));
    to += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    to += static_cast<char>(0x80 | (code & 0x3F));
  }
}

/// `quoted` is a valid string token with its quotation marks.
std::string decode(std::string_view quoted) {
  std::string result;
  const auto unit = [quoted](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 4 | static_cast<std::uint32_t>(hex_digit(quoted[at + k]));
    return value;
  };
  for (std::size_t i = 1; i + 1 < quoted.size(); ++i) {
    if (quoted[i] != '\\') {
      result += quoted[i];
      continue;
    }
    constexpr std::string_view escapes = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
    const char c = quoted[++i];
    if (c != 'u') {
      result += meanings[escapes.find(c)];
      continue;
    }
    std::uint32_t code = unit(i + 1);
    i += 4;
    const bool is_pair = code >= 0xD800 && code < 0xDC00 && quoted.substr(i + 1, 2) == "\\u";
    if (is_pair) {
      const std::uint32_t low = unit(i + 3);
      if (low >= 0xDC00 && low < 0xE000) {
        code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
        i += 6;
      }
    }
    append_utf8(result, code);
  }
  return result;
}

}  // namespace

class JsonParser {
 public:
  explicit JsonParser(JsonText& json) : text_(json.text_), nodes_(json.nodes_) {}

  void parse() {
    if (text_.size() >= std::numeric_limits<std::uint32_t>::max()) throw FileError("the JSON text is larger than 4 GB");
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte order mark
    skip_space();
    value(0);
    skip_space();
    if (at_ != text_.size()) fail("something follows after the end of the JSON text");
  }

 private:
  [[noreturn]] void fail(const char* message) const { throw FileError(fmt::format("JSON byte {}: {}", at_, message)); }
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_space() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t')) {
      ++at_;
    }
  }

  void value(std::size_t depth) {
    const std::size_t node = open();
    const char c = here();
    if (c == '{' || c == '[') {
      if (depth == deepest_nesting) fail("nested too deeply: too many brackets within each other");
      container(c == '{', depth);
    } else if (c == '"') {
      string();
    } else if (c == '-' || (c >= '0' && c <= '9')) {
      number();
    } else if (!word("true") && !word("false") && !word("null")) {
      fail(at_ == text_.size() ? "the text ends too early; it is cut short" : "a value should be here");
    }
    close(node);
  }

  void container(bool is_object, std::size_t depth) {
    const char last = is_object ? '}' : ']';
    ++at_;
    skip_space();
    if (here() == last) {
      ++at_;
      return;
    }
    for (;;) {
      if (is_object) key();
      value(depth + 1);
      skip_space();
      const char c = here();
      ++at_;
      if (c == last) return;
      if (c != ',') {
        --at_;
        fail(at_ >= text_.size() ? "the text ends too early; it is cut short"
                                 : "',' or a closing bracket should be here");
      }
      skip_space();
    }
  }

  void key() {
    if (here() != '"') fail("a key in quotation marks should be here");
    const std::size_t node = open();
    string();
    close(node);
    skip_space();
    if (here() != ':') fail("':' should be here");
    ++at_;
    skip_space();
  }

  void string() {
    ++at_;
    for (;;) {
      if (at_ >= text_.size()) fail("the text ends within a string; it is cut short");
      const char c = text_[at_];
      if (static_cast<unsigned char>(c) < ' ') fail("a control character within a string");
      ++at_;
      if (c == '"') return;
      if (c == '\\') escape();
    }
  }
  void escape() {
    const char c = here();
    if (c == '\0' || std::string_view("\"\\/bfnrtu").find(c) == std::string_view::npos)
      fail("unknown escape in a string");
    ++at_;
    for (int k = 0; c == 'u' && k < 4; ++k, ++at_) {
      if (hex_digit(here()) < 0) fail("four hexadecimal digits should follow \\u");
    }
  }

  void digits() {
    if (here() < '0' || here() > '9') fail("a digit should be here");
    while (here() >= '0' && here() <= '9') ++at_;
  }
  void number() {
    if (here() == '-') ++at_;
    if (here() == '0') {
      ++at_;
    } else {
      digits();
    }
    if (here() == '.') {
      ++at_;
      digits();
    }
    if (here() == 'e' || here() == 'E') {
      ++at_;
      if (here() == '+' || here() == '-') ++at_;
      digits();
    }
  }

  bool word(std::string_view expected) {
    if (!text_.substr(std::min(at_, text_.size())).starts_with(expected)) return false;
    at_ += expected.size();
    return true;
  }

  std::size_t open() {
    nodes_.push_back({static_cast<std::uint32_t>(at_), 0, 0});
    return nodes_.size() - 1;
  }
  void close(std::size_t node) {
    nodes_[node].end = static_cast<std::uint32_t>(at_);
    nodes_[node].next = static_cast<std::uint32_t>(nodes_.size());
  }

  std::string_view text_;
  std::vector<JsonText::Node>& nodes_;
  std::size_t at_ = 0;
};

JsonText::JsonText(std::string_view text) : text_(text) {
  JsonParser(*this).parse();
}

JsonText::Value JsonText::root() const {
  return {this, 0};
}

JsonText::Value JsonText::Value::operator[](std::string_view key) const {
  Value result;
  if (!is_object()) return result;
  const std::vector<Node>& nodes = json_->nodes_;
  for (std::uint32_t i = node_ + 1; i < nodes[node_].next; i = nodes[i + 1].next) {
    const std::string_view quoted = json_->text_.substr(nodes[i].begin, nodes[i].end - nodes[i].begin);
    const bool is_plain = quoted.find('\\') == std::string_view::npos;
    if (is_plain ? quoted.substr(1, quoted.size() - 2) == key : decode(quoted) == key) result = {json_, i + 1};
  }
  return result;
}

std::vector<JsonText::Value> JsonText::Value::elements() const {
  std::vector<Value> result;
  if (!is_array()) return result;
  for (std::uint32_t i = node_ + 1; i < json_->nodes_[node_].next; i = json_->nodes_[i].next) {
    result.push_back({json_, i});
  }
  return result;
}

std::optional<double> JsonText::Value::number() const {
  double value = 0;
  if (!is_number()) return std::nullopt;
  const std::string_view token = text();
  if (read_number(token.data(), token.data() + token.size(), value).ec != std::errc{}) return std::nullopt;
  return value;
}

std::optional<std::size_t> JsonText::Value::index() const {
  const std::optional<double> value = number();
  /// Larger whole numbers are not exact, 2^53 (fixed by float64)
  constexpr double largest = 9007199254740992.0;
  if (!value || *value < 0 || *value > largest || *value != std::floor(*value)) return std::nullopt;
  return static_cast<std::size_t>(*value);
}

std::string JsonText::Value::string() const {
  return is_string() ? decode(text()) : std::string();
}

}  // namespace unsnarl
