#include "applications/curves/files/style_sheet.h"

#include <algorithm>
#include <array>
#include <optional>

namespace unsnarl {
namespace {

bool is_css_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_css_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_css_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return result;
}

/// Parts of a text between separators that are not within brackets.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t k = 0; k <= text.size(); ++k) {
    if (k < text.size() && (text[k] == '(' || text[k] == '[')) ++depth;
    if (k < text.size() && (text[k] == ')' || text[k] == ']')) --depth;
    if (k < text.size() && (text[k] != separator || depth > 0)) continue;
    parts.push_back(trimmed(text.substr(begin, k - begin)));
    begin = k + 1;
  }
  return parts;
}

std::map<std::string, StyleValue, std::less<>> parse_declarations(std::string_view text) {
  std::map<std::string, StyleValue, std::less<>> result;
  for (const std::string_view declaration : split(text, ';')) {
    const std::size_t colon = declaration.find(':');
    if (colon == std::string_view::npos) continue;
    StyleValue value{lower_case(trimmed(declaration.substr(colon + 1))), false};
    if (const std::size_t mark = value.value.find('!'); mark != std::string::npos) {
      value.important = trimmed(std::string_view(value.value).substr(mark + 1)) == "important";
      value.value = std::string(trimmed(std::string_view(value.value).substr(0, mark)));
    }
    StyleValue& known = result[lower_case(trimmed(declaration.substr(0, colon)))];
    if (value.important || !known.important) known = std::move(value);
  }
  return result;
}

std::string without_comments(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t begin = text.find("/*");
    result += text.substr(0, begin);
    if (begin == std::string_view::npos) break;
    const std::size_t end = text.find("*/", begin + 2);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 2);
    result += ' ';
  }
  for (const std::string_view mark : {"<!--", "-->"})
    for (std::size_t at = result.find(mark); at != std::string::npos; at = result.find(mark))
      result.erase(at, mark.size());
  return result;
}

bool is_name_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool has_word(std::string_view list, std::string_view word) {
  for (std::size_t begin = 0; begin < list.size();) {
    while (begin < list.size() && is_css_space(list[begin])) ++begin;
    std::size_t end = begin;
    while (end < list.size() && !is_css_space(list[end])) ++end;
    if (end > begin && list.substr(begin, end - begin) == word) return true;
    begin = end;
  }
  return false;
}

}  // namespace

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

bool StyleSheet::parse_selector(std::string_view text, Rule& rule) {
  std::size_t i = 0;
  bool is_child = false;
  const auto name = [&] {
    const std::size_t begin = i;
    while (i < text.size() && is_name_char(text[i])) ++i;
    return std::string(text.substr(begin, i - begin));
  };
  while (i < text.size()) {
    if (is_css_space(text[i]) || text[i] == '>') {
      if (text[i] == '>') {
        if (is_child || rule.selector.empty()) return false;
        is_child = true;
      }
      ++i;
      continue;
    }
    Compound compound;
    compound.is_child = is_child;
    is_child = false;
    const std::size_t begin = i;
    if (text[i] == '*') {
      ++i;
    } else if (is_name_char(text[i])) {
      compound.type = name();
      ++rule.specificity[2];
    }
    while (i < text.size() && (text[i] == '.' || text[i] == '#' || text[i] == '[')) {
      const char kind = text[i++];
      if (kind == '[') {
        Attribute attribute{name(), {}, true};
        if (i < text.size() && text[i] == '=') {
          const std::size_t end = text.find(']', i);
          if (end == std::string_view::npos) return false;
          std::string_view value = trimmed(text.substr(i + 1, end - i - 1));
          if (value.size() > 1 && (value.front() == '"' || value.front() == '\''))
            value = value.substr(1, value.size() - 2);
          attribute.value = std::string(value);
          attribute.any_value = false;
          i = end;
        }
        if (attribute.name.empty() || i >= text.size() || text[i] != ']') return false;
        ++i;
        compound.attributes.push_back(std::move(attribute));
        ++rule.specificity[1];
        continue;
      }
      std::string word = name();
      if (word.empty()) return false;
      if (kind == '.') {
        compound.classes.push_back(std::move(word));
        ++rule.specificity[1];
      } else {
        if (!compound.id.empty() && compound.id != word) return false;
        compound.id = std::move(word);
        ++rule.specificity[0];
      }
    }
    if (i == begin) return false;  // a pseudo-class, another combinator
    if (i < text.size() && !is_css_space(text[i]) && text[i] != '>') return false;
    rule.selector.push_back(std::move(compound));
  }
  return !rule.selector.empty() && !is_child;
}

void StyleSheet::add(std::string_view given, std::vector<std::string>& unknown) {
  const std::string all = without_comments(given);
  std::string_view text = all;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t open = text.find('{');
    if (text.front() == '@') {
      // Up to the semicolon, or the brace that closes its block.
      const std::size_t semicolon = text.find(';');
      std::size_t name_end = 1;
      while (name_end < text.size() && is_name_char(text[name_end])) ++name_end;
      const std::string_view name = text.substr(0, name_end);
      if (name != "@charset" && name != "@namespace" && name != "@font-face") unknown.emplace_back(name);
      std::size_t end = std::min(semicolon, text.size());
      if (open < semicolon) {
        int depth = 0;
        for (end = open; end < text.size(); ++end) {
          if (text[end] == '{') ++depth;
          if (text[end] == '}' && --depth == 0) break;
        }
      }
      text.remove_prefix(std::min(end + 1, text.size()));
      continue;
    }
    if (open == std::string_view::npos) return;
    const std::size_t close = std::min(text.find('}', open), text.size());
    const auto declarations = parse_declarations(text.substr(open + 1, close - open - 1));
    for (const std::string_view selector : split(text.substr(0, open), ',')) {
      Rule rule;
      rule.declarations = declarations;
      if (parse_selector(selector, rule)) {
        rules_.push_back(std::move(rule));
      } else {
        unknown.emplace_back(selector);
      }
    }
    text.remove_prefix(std::min(close + 1, text.size()));
  }
}

bool StyleSheet::matches(const pugi::xml_node& node, const Compound& compound) {
  if (!compound.type.empty() && local_name(node) != compound.type) return false;
  if (!compound.id.empty() && compound.id != node.attribute("id").value()) return false;
  for (const std::string& word : compound.classes)
    if (!has_word(node.attribute("class").value(), word)) return false;
  return std::all_of(compound.attributes.begin(), compound.attributes.end(), [&](const Attribute& wanted) {
    const pugi::xml_attribute found = node.attribute(wanted.name.c_str());
    return found && (wanted.any_value || wanted.value == found.value());
  });
}

bool StyleSheet::matches(const pugi::xml_node& node, const std::vector<Compound>& selector, std::size_t count) {
  const Compound& last = selector[count - 1];
  if (!matches(node, last)) return false;
  if (count == 1) return true;
  for (pugi::xml_node outer = node.parent(); outer.type() == pugi::node_element; outer = outer.parent()) {
    if (matches(outer, selector, count - 1)) return true;
    if (last.is_child) return false;
  }
  return false;
}

std::string StyleSheet::declared_in_css(const pugi::xml_node& node, std::string_view property) const {
  const StyleValue* best = nullptr;
  std::array<int, 3> specificity{};
  for (const Rule& rule : rules_) {
    const auto found = rule.declarations.find(property);
    if (found == rule.declarations.end() || !matches(node, rule.selector, rule.selector.size())) continue;
    const bool is_stronger =
        best == nullptr ||
        (found->second.important != best->important ? found->second.important : rule.specificity >= specificity);
    if (!is_stronger) continue;
    best = &found->second;
    specificity = rule.specificity;
  }
  const auto own = parse_declarations(node.attribute("style").value());
  if (const auto found = own.find(property); found != own.end())
    if (best == nullptr || found->second.important || !best->important) return found->second.value;
  return best != nullptr ? best->value : std::string();
}

std::string StyleSheet::declared(const pugi::xml_node& node, std::string_view property) const {
  const std::string in_css = declared_in_css(node, property);
  if (!in_css.empty()) return in_css;
  return lower_case(trimmed(node.attribute(std::string(property).c_str()).value()));
}

}  // namespace unsnarl
