#include "io/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <new>

#include "io/text_scanner.h"
#include "unsnarl/depth_limit.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

/// Goes through the elements without recursion.
struct DepthCheck : pugi::xml_tree_walker {
  bool for_each(pugi::xml_node& node) override {
    if (node.type() != pugi::node_element || static_cast<std::size_t>(depth()) < deepest_nesting) return true;
    place = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    return false;
  }
  std::optional<std::size_t> place;
};

}  // namespace

XmlText::XmlText(std::string_view text, const char* root, std::string_view ending)
    : text_(text), buffer_(std::string(text).append(ending)) {
  if (text.empty()) throw FileError(fmt::format("the file is empty; an XML text of <{}> should be here", root));
  // No option that changes a character: then what is in the buffer is where it was in the text.
  const pugi::xml_parse_result result =
      document_.load_buffer_inplace(buffer_.data(), buffer_.size(), pugi::parse_cdata, pugi::encoding_utf8);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result) {
    fail(
        std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)), text.size()),
        fmt::format("this is not XML ({}); the file is cut short, damaged or of another format", result.description()));
  }
  if (const std::optional<std::size_t> place = too_deep_element(document_))
    fail(std::min(*place, text.size()),
         fmt::format("nested too deeply: more than {} elements within each other", deepest_nesting));
  root_ = document_.document_element();
  if (std::strcmp(root_.name(), root) != 0) {
    fail(root_, fmt::format("the root element is <{}>, but <{}> should be here; check the format",
                            std::string_view(root_.name()).substr(0, 30), root));
  }
}

std::size_t XmlText::begin(const pugi::xml_node& element) const {
  return std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(element.offset_debug(), 0)), text_.size());
}

ByteRange XmlText::range(const pugi::xml_attribute& attribute) const {
  return {static_cast<std::size_t>(attribute.value() - buffer_.data()), std::strlen(attribute.value())};
}

ByteRange XmlText::content(const pugi::xml_node& element) const {
  ByteRange result{begin(element), 0};
  for (const pugi::xml_node& child : element.children()) {
    if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) continue;
    if (result.size > 0) fail(element, fmt::format("the text of <{}> should be one piece", element.name()));
    result = {static_cast<std::size_t>(child.value() - buffer_.data()), std::strlen(child.value())};
  }
  return result;
}

std::size_t XmlText::whole_number(const pugi::xml_node& element, const char* attribute, std::size_t otherwise) const {
  const pugi::xml_attribute found = element.attribute(attribute);
  if (!found) return otherwise;
  std::string_view digits = found.value();
  while (digits.starts_with(' ')) digits.remove_prefix(1);
  while (digits.ends_with(' ')) digits.remove_suffix(1);
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size())
    fail(range(found).begin, fmt::format("{} in attribute {} of <{}> where a whole number should be", in_quotes(digits),
                                         attribute, element.name()));
  return value;
}

std::string XmlText::value(const pugi::xml_attribute& attribute) {
  const std::string text = fmt::format("<value>{}</value>", attribute.value());
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_escapes | pugi::parse_ws_pcdata, pugi::encoding_utf8);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  return document.document_element().text().get();
}

void XmlText::fail(const pugi::xml_node& at, const std::string& message) const {
  fail(begin(at), message);
}

void XmlText::fail(std::size_t offset, const std::string& message) const {
  TextScanner(text_, {}).fail(message, offset);
}

std::optional<std::size_t> too_deep_element(const pugi::xml_document& document) {
  DepthCheck check;
  document.root().traverse(check);
  return check.place;
}

std::string in_attribute(std::string_view text) {
  constexpr std::string_view special = "&<>\"'";
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos || (c >= 0 && c < ' '))
      result += fmt::format("&#{};", static_cast<int>(c));
    else
      result += c;
  }
  return result;
}

}  // namespace unsnarl
