#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "io/text_edits.h"

namespace unsnarl {

/// An XML text and the places of its parts, so that single values can be replaced and all else stays as it was.
/// Entities are not resolved, so none can grow.
class XmlText {
 public:
  /// `text`, in UTF-8, has to outlive this. `ending` is read after it, to close elements of a text that goes on as
  /// something else. Throws FileError, naming the line, where it is no XML, where it is nested deeper than
  /// deepest_nesting, and unless its root element is called `root`.
  XmlText(std::string_view text, const char* root, std::string_view ending = {});
  XmlText(const XmlText&) = delete;
  XmlText& operator=(const XmlText&) = delete;

  pugi::xml_node root() const { return root_; }
  /// Place of an element: of its name.
  std::size_t begin(const pugi::xml_node& element) const;
  /// Place of an attribute that is there: of its value, without the quotes.
  ByteRange range(const pugi::xml_attribute& attribute) const;
  /// Place of the text (also CDATA) in an element, before or after other elements. Throws FileError unless it is one
  /// piece.
  ByteRange content(const pugi::xml_node& element) const;
  /// A whole number of at least 0, or `otherwise` where there is no such attribute. Throws FileError.
  std::size_t whole_number(const pugi::xml_node& element, const char* attribute, std::size_t otherwise) const;

  /// The value of an attribute with its entities resolved (those of XML itself; others stay as they are).
  static std::string value(const pugi::xml_attribute& attribute);

  [[noreturn]] void fail(const pugi::xml_node& at, const std::string& message) const;
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;

 private:
  std::string_view text_;
  std::string buffer_;  ///< the copy that pugixml works in; its strings tell their places
  pugi::xml_document document_;
  pugi::xml_node root_;
};

/// Place in the text of the first element that is nested deeper than deepest_nesting, if there is one. Every reader of
/// XML asks this before it follows the elements down.
std::optional<std::size_t> too_deep_element(const pugi::xml_document& document);

/// A text as it stands in an attribute, whichever quotes are around it.
std::string in_attribute(std::string_view text);

}  // namespace unsnarl
