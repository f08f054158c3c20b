#include "same_bytes/known_hashes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace unsnarl::same_bytes {
namespace {

struct Known {
  std::string_view name;
  std::uint64_t hash;
};
constexpr Known known_hashes[] = {
#include "same_bytes/known_hashes.inc"
};

}  // namespace

void expect_known(std::string_view name, const Bytes& bytes) {
  const std::uint64_t hash = bytes.hash();
  std::printf("{\"%.*s\", 0x%016llxULL},\n", static_cast<int>(name.size()), name.data(),
              static_cast<unsigned long long>(hash));
  const auto* known =
      std::find_if(std::begin(known_hashes), std::end(known_hashes), [&](const Known& k) { return k.name == name; });
  ASSERT_NE(known, std::end(known_hashes)) << name << " has no line in known_hashes.inc";
  EXPECT_EQ(known->hash, hash) << name << ": this machine or compiler gives other bytes";
}

}  // namespace unsnarl::same_bytes
