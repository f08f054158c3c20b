#include "io/zip_archive.h"

#include <gtest/gtest.h>

#include "archives.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

const std::vector<std::pair<std::string, std::string>> entries = {
    {"first.txt", std::string(1000, 'a') + "b"}, {"folder/second.txt", "two"}, {"third", ""}};

TEST(ZipArchive, reads_what_is_stored_or_deflated) {
  for (const bool is_compressed : {false, true}) {
    const std::string bytes = zip_of(entries, is_compressed);
    const ZipArchive archive(bytes);
    for (const auto& [name, content] : entries) EXPECT_EQ(archive.content(name), content);
    EXPECT_EQ(archive.content("FIRST.TXT"), entries[0].second);
    EXPECT_EQ(archive.content("fourth"), std::nullopt);
  }
}

TEST(ZipArchive, replaces_one_entry_and_keeps_the_others) {
  for (const bool is_compressed : {false, true}) {
    const std::string bytes = zip_of(entries, is_compressed);
    const std::string changed = ZipArchive(bytes).with_contents({{"folder/second.txt", "another text, longer"}});
    const ZipArchive archive(changed);
    EXPECT_EQ(archive.content("first.txt"), entries[0].second);
    EXPECT_EQ(archive.content("folder/second.txt"), "another text, longer");
    EXPECT_EQ(archive.content("third"), "");
    EXPECT_EQ(changed, ZipArchive(bytes).with_contents({{"folder/second.txt", "another text, longer"}}));
    // The first entry is where it was, as it was, of its own level of compression.
    EXPECT_EQ(changed.substr(0, bytes.find("PK\3\4", 4)), bytes.substr(0, bytes.find("PK\3\4", 4)));
  }
}

TEST(ZipArchive, refuses_what_is_damaged) {
  const std::string bytes = zip_of(entries, true);
  EXPECT_THROW(ZipArchive("no archive"), FileError);
  EXPECT_THROW(ZipArchive(bytes.substr(0, bytes.size() - 30)), FileError);
  std::string damaged = bytes;
  damaged[45] ^= 0x55;
  EXPECT_THROW(ZipArchive(damaged).content("first.txt"), FileError);
}

TEST(ZipArchive, asks_for_no_memory_that_cannot_be_filled) {
  std::string bytes = zip_of(entries, true);
  const std::size_t directory = bytes.find("PK\1\2");
  bytes.replace(directory + 24, 4, "\xff\xff\xff\x7f");  // the size before compression
  bytes.replace(22, 4, "\xff\xff\xff\x7f");
  EXPECT_THROW(ZipArchive(bytes).content("first.txt"), FileError);
}

}  // namespace
}  // namespace unsnarl
