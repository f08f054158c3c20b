#include "io/text_edits.h"

#include <algorithm>

namespace unsnarl {

std::string with_edits(std::string_view text, std::vector<TextEdit> edits) {
  std::stable_sort(edits.begin(), edits.end(), [](const TextEdit& a, const TextEdit& b) { return a.begin < b.begin; });
  std::string result;
  std::size_t done = 0;
  for (const TextEdit& edit : edits) {
    result.append(text, done, edit.begin - done);
    result += edit.text;
    done = edit.end;
  }
  result.append(text, done, text.size() - done);
  return result;
}

}  // namespace unsnarl
