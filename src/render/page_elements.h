#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// The elements of the page that hold its data, one after another; viewer/src/page_data.js reads them.
class PageElements {
 public:
  void add_json(std::string_view id, const nlohmann::ordered_json& json);
  /// A list as pack_words packs it.
  void add_words(std::string_view id, const std::vector<Index>& words, std::size_t stride);
  void add_words(std::string_view id, const std::vector<float>& words, std::size_t stride);
  /// The same, predicted by the list `like` of the element `like_id`.
  void add_words_like(std::string_view id, const std::vector<float>& words, std::string_view like_id,
                      const std::vector<float>& like);
  /// Any bytes, as base64.
  void add_bytes(std::string_view id, std::string_view bytes);

  const std::string& html() const { return html_; }

 private:
  void add(std::string_view type, std::string_view id, const std::string& attributes, std::string_view text);
  void add_list(std::string_view id, std::string_view kind, std::size_t count, const std::string& prediction,
                std::string_view text);
  std::string html_;
};

}  // namespace unsnarl
