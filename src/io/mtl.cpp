#include "io/mtl.h"

#include <algorithm>
#include <optional>

#include "io/text_scanner.h"

namespace unsnarl {
namespace {

/// Numbers of the option here, which may be fewer than `most`.
std::size_t read_numbers(TextScanner& text, std::size_t most, double* numbers) {
  std::size_t count = 0;
  double value = 0;
  while (count < most && text.skip_blanks() && text.number(value) == TextScanner::Number::ok) numbers[count++] = value;
  return count;
}

/// Options of a map stand before its name: "-s 2 2 -clamp on skin.png".
void read_map(TextScanner& text, MtlMaterial& material) {
  while (text.skip_blanks() && text.peek().starts_with('-')) {
    const std::string_view option = text.token();
    std::array<double, 3> numbers{};
    if (option == "-o" || option == "-s" || option == "-t") {
      const std::size_t count = std::min<std::size_t>(read_numbers(text, 3, numbers.data()), 2);
      if (option != "-t")
        std::copy_n(numbers.begin(), count, (option == "-o" ? material.offset : material.scale).begin());
    } else if (option == "-mm") {
      read_numbers(text, 2, numbers.data());
    } else {  // -blendu, -blendv, -bm, -boost, -cc, -clamp, -imfchan, -texres, -type: one word
      text.skip_blanks();
      const std::string_view value = text.token();
      if (option == "-clamp") material.clamp = value == "on";
    }
  }
  material.image = text.rest_of_line();
}

}  // namespace

void read_mtl(std::string_view bytes, std::map<std::string, MtlMaterial, std::less<>>& materials) {
  TextScanner text(bytes, {.hash_comments = true});
  MtlMaterial* material = nullptr;
  while (text.skip_space()) {
    const std::string_view keyword = text.token();
    if (keyword == "newmtl") {
      material = &materials.try_emplace(std::string(text.rest_of_line())).first->second;
      continue;
    }
    if (material && keyword == "Kd") {
      std::array<double, 3> rgb{};
      if (read_numbers(text, 3, rgb.data()) == 3)
        for (std::size_t k = 0; k < 3; ++k) material->colour[k] = static_cast<float>(std::clamp(rgb[k], 0.0, 1.0));
    } else if (material && keyword == "map_Kd") {
      read_map(text, *material);
      continue;
    }
    text.next_line();
  }
}

}  // namespace unsnarl
