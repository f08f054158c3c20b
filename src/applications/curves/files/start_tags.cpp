#include "applications/curves/files/start_tags.h"

#include <algorithm>

namespace unsnarl {

Attributes attributes_of(std::string_view text, std::size_t name) {
  Attributes result;
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  std::size_t i = name;
  while (i < text.size() && !is_space(text[i]) && text[i] != '>' && text[i] != '/') ++i;
  while (i < text.size()) {
    while (i < text.size() && is_space(text[i])) ++i;
    if (i >= text.size() || text[i] == '>' || text[i] == '/') break;
    Attribute a;
    a.begin = i;
    while (i < text.size() && !is_space(text[i]) && text[i] != '=') ++i;
    std::string key(text.substr(a.begin, i - a.begin));
    while (i < text.size() && text[i] != '"' && text[i] != '\'') ++i;
    const char quote = i < text.size() ? text[i] : '"';
    a.value_begin = ++i;
    while (i < text.size() && text[i] != quote) ++i;
    a.value_end = i++;
    a.end = i;
    result.emplace(std::move(key), a);
  }
  return result;
}

std::size_t end_tag_of(std::string_view text, std::size_t at) {
  for (int depth = 1; (at = text.find('<', at)) != std::string_view::npos;) {
    const auto behind = [&](std::string_view mark) { return std::min(text.find(mark, at), text.size()); };
    const std::string_view tag = text.substr(at);
    if (tag.starts_with("<!--")) {
      at = behind("-->");
    } else if (tag.starts_with("<![CDATA[")) {
      at = behind("]]>");
    } else if (tag.starts_with("<?")) {
      at = behind("?>");
    } else if (tag.starts_with("</")) {
      if (--depth == 0) return at;
      at = behind(">");
    } else {
      std::size_t end = at + 1;
      for (const auto& [key, attribute] : attributes_of(text, end)) end = std::max(end, attribute.end);
      at = std::min(text.find('>', end), text.size());
      if (at > 0 && text[at - 1] != '/') ++depth;
    }
  }
  return at;
}

}  // namespace unsnarl
