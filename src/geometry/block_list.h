#pragma once

#include <cstddef>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "geometry/parallel.h"
#include "geometry/parallel_lists.h"

namespace unsnarl {

/// A list, in blocks, that grows without being copied: never is there room for more than its items and a block. For
/// lists that are most of the memory of their owner.
template <class Item>
class BlockList {
 public:
  using value_type = Item;

  std::size_t size() const { return blocks_.empty() ? 0 : (blocks_.size() - 1) * block_size + blocks_.back().size(); }
  bool empty() const { return blocks_.empty(); }

  void push_back(const Item& item) {
    if (blocks_.empty())
      blocks_.emplace_back();  // grows by itself: most lists are short
    else if (blocks_.back().size() == block_size)
      blocks_.emplace_back().reserve(block_size);
    blocks_.back().push_back(item);
  }
  /// Gives its memory back.
  void clear() { std::vector<std::vector<Item>>().swap(blocks_); }
  /// Removes the items for which is_out(item) is true; the others keep their order.
  template <class IsOut>
  void erase_if(IsOut&& is_out) {
    std::vector<std::vector<Item>> blocks = std::move(blocks_);
    blocks_.clear();
    for (std::vector<Item>& block : blocks) {
      for (const Item& item : block)
        if (!is_out(item)) push_back(item);
      std::vector<Item>().swap(block);
    }
  }

  /// Over all items, in order.
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Item;
    using difference_type = std::ptrdiff_t;
    using pointer = const Item*;
    using reference = const Item&;

    Iterator() = default;
    explicit Iterator(const std::vector<Item>* block) : block_(block) {}
    reference operator*() const { return (*block_)[at_]; }
    pointer operator->() const { return &**this; }
    Iterator& operator++() {
      if (++at_ == block_->size()) ++block_, at_ = 0;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) = default;

   private:
    const std::vector<Item>* block_ = nullptr;
    std::size_t at_ = 0;
  };
  Iterator begin() const { return Iterator(blocks_.data()); }
  Iterator end() const { return Iterator(blocks_.data() + blocks_.size()); }

  /// The same block by block.
  std::span<const std::vector<Item>> blocks() const { return blocks_; }

 private:
  /// Items of each block but the last, which has at least one [E243] (unit: items)
  static constexpr std::size_t block_size = 1024;

  std::vector<std::vector<Item>> blocks_;
};

/// Appends the lists (vectors, deques), one after the other, and gives each back at once.
template <class List, class Item>
void append_lists(std::vector<List>&& lists, BlockList<Item>& out) {
  for (List& list : lists) {
    for (const Item& item : list) out.push_back(item);
    List().swap(list);
  }
}

/// Builds a list in parallel that does not depend on the number of threads: `append(block, list)` adds what a block of
/// items contributes. `out` is replaced.
template <class From, class Item, class Append>
void gather_from_blocks(const BlockList<From>& items, std::vector<Item>& out, Append&& append) {
  const std::span<const std::vector<From>> blocks = items.blocks();
  std::vector<std::vector<Item>> lists(blocks.size());
  parallel_for(blocks.size(), [&](std::size_t k) { append(blocks[k], lists[k]); });
  join_lists(std::move(lists), out);
}

}  // namespace unsnarl
