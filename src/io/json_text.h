#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace unsnarl {

/// A JSON text (RFC 8259) together with the place of each of its values, so that single numbers can be replaced and
/// all else stays as it was. Throws FileError, naming the byte, where the text is not JSON or is nested deeper than
/// deepest_nesting.
class JsonText {
 public:
  class Value;

  /// `text` has to outlive this and all its values.
  explicit JsonText(std::string_view text);
  Value root() const;

 private:
  friend class JsonParser;
  /// One value or key. The type is told by the first character of the text.
  struct Node {
    std::uint32_t begin, end;  ///< in the text
    std::uint32_t next;        ///< the node after this one and all within it
  };
  std::string_view text_;
  std::vector<Node> nodes_;  ///< in the order of the text; in an object, keys and values take turns
};

/// A value, or nothing: looking for a member that is not there, or in something that is no object, gives nothing.
class JsonText::Value {
 public:
  Value() = default;

  explicit operator bool() const { return json_ != nullptr; }
  bool is_object() const { return first() == '{'; }
  bool is_array() const { return first() == '['; }
  bool is_string() const { return first() == '"'; }
  bool is_number() const { return first() == '-' || (first() >= '0' && first() <= '9'); }

  /// Member of an object; the last one where a key comes twice.
  Value operator[](std::string_view key) const;
  /// Elements of an array; none for anything else.
  std::vector<Value> elements() const;
  std::optional<double> number() const;
  /// A number that is whole and not negative.
  std::optional<std::size_t> index() const;
  std::string string() const;  ///< decoded; empty for anything else

  /// The bytes of this value in the text.
  std::size_t begin() const { return json_->nodes_[node_].begin; }
  std::size_t end() const { return json_->nodes_[node_].end; }
  std::string_view text() const { return json_->text_.substr(begin(), end() - begin()); }

 private:
  friend class JsonText;
  Value(const JsonText* json, std::uint32_t node) : json_(json), node_(node) {}
  char first() const { return json_ == nullptr ? '\0' : json_->text_[begin()]; }

  const JsonText* json_ = nullptr;
  std::uint32_t node_ = 0;
};

}  // namespace unsnarl
