#pragma once

#include <array>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace unsnarl {

/// The name of an element without its prefix.
std::string_view local_name(const pugi::xml_node& node);

/// A value that a property is given, and how strong that is.
struct StyleValue {
  std::string value;
  bool important = false;
};

/// CSS as drawings have it (CSS 2.1, §5 and §6): selectors of types, classes, ids and attributes, lists of them,
/// descendants and children; the cascade by importance, specificity and order.
class StyleSheet {
 public:
  /// Adds the rules of the text of a <style> element. What is not understood is left out, and named in `unknown`.
  void add(std::string_view text, std::vector<std::string>& unknown);

  /// The value in lower case that rules, the `style` or the attribute of this name declare for a property of an
  /// element; empty: none. Nothing is inherited.
  std::string declared(const pugi::xml_node& node, std::string_view property) const;
  /// The same without the attribute.
  std::string declared_in_css(const pugi::xml_node& node, std::string_view property) const;

 private:
  struct Attribute {
    std::string name, value;
    bool any_value = false;
  };
  /// The conditions of a selector on one element.
  struct Compound {
    std::string type, id;  ///< empty: any
    std::vector<std::string> classes;
    std::vector<Attribute> attributes;
    bool is_child = false;  ///< of the element that the compound before it describes, not only within it
  };
  struct Rule {
    std::vector<Compound> selector;  ///< the last one is the element itself
    std::array<int, 3> specificity{};
    std::map<std::string, StyleValue, std::less<>> declarations;
  };
  static bool parse_selector(std::string_view text, Rule& rule);
  static bool matches(const pugi::xml_node& node, const Compound& compound);
  static bool matches(const pugi::xml_node& node, const std::vector<Compound>& selector, std::size_t count);

  std::vector<Rule> rules_;
};

}  // namespace unsnarl
