#include <optional>
#include <string>

#include "fuzz/promise.h"
#include "fuzz/targets.h"
#include "io/content.h"
#include "io/formats.h"

namespace unsnarl::fuzz {

void content(Bytes bytes) {
  const std::string start(bytes.begin(), bytes.end());
  const std::optional<Format> found = format_of_content(start);
  for (const FormatEntry& entry : formats) {
    bool is_refused = false;
    try {
      refuse_other_content(start, entry.format);
    } catch (const FileError& refusal) {
      promise(refusal.what()[0] != '\0', "a refusal has a reason");
      is_refused = true;
    }
    if (found) promise(is_refused == (*found != entry.format), "the format that the content tells is read, no other");
  }
}

}  // namespace unsnarl::fuzz
