#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

inline std::uint64_t mixed(std::uint64_t h) {  // finaliser of MurmurHash3
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ULL;
  return h ^ (h >> 33);
}

inline std::uint64_t hash_of(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return mixed(a + 0x9e3779b97f4a7c15ULL * mixed(b + 0x9e3779b97f4a7c15ULL * mixed(c)));
}

/// Open-addressing table from keys that somebody else stores to their ids.
class IdTable {
 public:
  explicit IdTable(std::size_t capacity) : slots_(std::bit_ceil(2 * capacity + 2), Slot{0, -1}) {}

  /// The id stored under a key with this hash for which same(id) holds; -1 and `id_if_new` stored where there is none.
  template <class Same>
  Index find_or_add(std::uint64_t hash, Index id_if_new, Same&& same) {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t i = hash & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1)) {
      if (slots_[i].id < 0) {
        slots_[i] = {tag, id_if_new};
        return -1;
      }
      if (slots_[i].tag == tag && same(slots_[i].id)) return slots_[i].id;
    }
  }
  template <class Same>
  Index find(std::uint64_t hash, Same&& same) const {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t i = hash & (slots_.size() - 1); slots_[i].id >= 0; i = (i + 1) & (slots_.size() - 1))
      if (slots_[i].tag == tag && same(slots_[i].id)) return slots_[i].id;
    return -1;
  }

 private:
  struct Slot {
    std::uint32_t tag;
    Index id;
  };
  std::vector<Slot> slots_;
};

}  // namespace unsnarl
