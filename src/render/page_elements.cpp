#include "render/page_elements.h"

#include "geometry/bit_cast.h"
#include "render/packed_words.h"

namespace unsnarl {
namespace {

std::string stride_attribute(std::size_t stride) {
  return " data-stride=\"" + std::to_string(stride) + '"';
}

}  // namespace

void PageElements::add_json(std::string_view id, const nlohmann::ordered_json& json) {
  // Names may hold any bytes, and "</script>" too.
  std::string text = json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  add("application/json", id, "", text);
}

void PageElements::add_words(std::string_view id, const std::vector<Index>& words, std::size_t stride) {
  add_list(id, "int", words.size(), stride_attribute(stride),
           pack_words(std::span<const Index>(words), {.stride = stride, .like = {}}));
}

void PageElements::add_words(std::string_view id, const std::vector<float>& words, std::size_t stride) {
  add_list(id, "float", words.size(), stride_attribute(stride),
           pack_words(std::span<const float>(words), {.stride = stride, .like = {}}));
}

void PageElements::add_words_like(std::string_view id, const std::vector<float>& words, std::string_view like_id,
                                  const std::vector<float>& like) {
  std::vector<std::uint32_t> bits(like.size());
  for (std::size_t i = 0; i < like.size(); ++i) bits[i] = bit_cast<std::uint32_t>(like[i]);
  add_list(id, "float", words.size(), " data-like=\"" + std::string(like_id) + '"',
           pack_words(std::span<const float>(words), {.stride = 0, .like = bits}));
}

void PageElements::add_bytes(std::string_view id, std::string_view bytes) {
  add("text/plain", id, "", base64(bytes));
}

void PageElements::add(std::string_view type, std::string_view id, const std::string& attributes,
                       std::string_view text) {
  for (const std::string_view part :
       {std::string_view("<script type=\""), type, std::string_view("\" id=\""), id, std::string_view("\""),
        std::string_view(attributes), std::string_view(">"), text, std::string_view("</script>\n")})
    html_ += part;
}

void PageElements::add_list(std::string_view id, std::string_view kind, std::size_t count,
                            const std::string& prediction, std::string_view text) {
  add("text/plain", id,
      " data-kind=\"" + std::string(kind) + "\" data-count=\"" + std::to_string(count) + '"' + prediction, text);
}

}  // namespace unsnarl
