// What a search over few cells of a large map remembers of them, and its open list.
//
// Nodes lie one after the other in the order in which they were first seen; a hash table finds them
// by cell. Both grow with the search and are small again at the next one, so that a query on a map
// of any size works in the processor's caches and clears no more than it used.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::planners {

// `Key`: an unsigned integer that orders costs.
template <class Key>
class HashedNodes {
 public:
  struct Node {
    std::uint32_t place;   // packed cell
    std::uint32_t parent;  // number of a node
    Key g;
    std::uint8_t arrived;  // bit n: reached at this g by the straight step n
    std::uint8_t waiting;  // of these, the ones that were not expanded yet
  };

  // Packs cells of maps up to this width.
  void begin(int width) {
    shift_ = width > 1 ? 32 - __builtin_clz(static_cast<unsigned>(width - 1)) : 0;
    nodes_.clear();
    for (std::vector<Entry>& bucket : buckets_) bucket.clear();
    filled_ = 0;
    last_ = 0;
    open_ = peak_open_ = 0;
    resizeTable(kFirstTableBits);
  }

  grid::Cell cell(std::uint32_t number) const {
    const std::uint32_t place = nodes_[number].place;
    return {static_cast<int>(place & ((std::uint32_t{1} << shift_) - 1)),
            static_cast<int>(std::uint64_t{place} >> shift_)};
  }
  Node& operator[](std::uint32_t number) { return nodes_[number]; }
  const Node& operator[](std::uint32_t number) const { return nodes_[number]; }

  // The node of a cell; a new one has arrived == 0.
  std::uint32_t find(grid::Cell cell) {
    const std::uint32_t place =
        static_cast<std::uint32_t>(std::uint64_t(cell.row) << shift_) | std::uint32_t(cell.column);
    const std::uint32_t mask = static_cast<std::uint32_t>(table_.size() - 1);
    for (std::uint32_t slot = slotOf(place); true; slot = (slot + 1) & mask) {
      if (table_[slot] == 0) return insert(place, slot);
      if (nodes_[table_[slot] - 1].place == place) return table_[slot] - 1;
    }
  }

  bool open() const { return open_ != 0; }
  // No f may be less than that of the last popped node.
  void push(Key f, std::uint32_t number) {
    put({f, number});
    if (++open_ > peak_open_) peak_open_ = open_;
  }
  // The one of least f, of equal ones the one put there last. Precondition: open().
  std::uint32_t pop() {
    if (buckets_[0].empty()) spreadLowest();
    const std::uint32_t number = buckets_[0].back().number;
    buckets_[0].pop_back();
    --open_;
    return number;
  }

  std::size_t peakOpen() const { return peak_open_; }
  // Of the nodes, their table and the open list at its longest.
  std::size_t bytes() const {
    return nodes_.size() * sizeof(Node) + table_.size() * sizeof(std::uint32_t) +
           peak_open_ * sizeof(Entry);
  }

 private:
  static constexpr int kFirstTableBits = 8;

  struct Entry {
    Key f;
    std::uint32_t number;
  };
  static constexpr int kKeyBits = 8 * static_cast<int>(sizeof(Key));

  // A radix heap (Ahuja, Mehlhorn, Orlin & Tarjan 1990): bucket b > 0 holds the keys whose highest
  // bit that differs from the last popped one is bit b - 1; bucket 0 the equal ones.
  void put(const Entry& entry) {
    const Key difference = entry.f ^ last_;
    const int bucket =
        difference == 0 ? 0 : 64 - __builtin_clzll(static_cast<std::uint64_t>(difference));
    buckets_[static_cast<std::size_t>(bucket)].push_back(entry);
    filled_ |= std::uint64_t{1} << bucket;
  }
  // Precondition: bucket 0 is empty, another one is not.
  void spreadLowest() {
    filled_ &= ~std::uint64_t{1};
    const int lowest = __builtin_ctzll(filled_);
    std::vector<Entry>& bucket = buckets_[static_cast<std::size_t>(lowest)];
    last_ = bucket.front().f;
    for (const Entry& entry : bucket) last_ = std::min(last_, entry.f);
    for (const Entry& entry : bucket) put(entry);
    bucket.clear();
    filled_ &= ~(std::uint64_t{1} << lowest);
  }

  std::uint32_t slotOf(std::uint32_t place) const {
    return (place * 0x9E3779B1U) >> (32 - table_bits_);
  }
  std::uint32_t insert(std::uint32_t place, std::uint32_t slot) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({place, 0, 0, 0, 0});
    table_[slot] = number + 1;
    if (nodes_.size() * 2 > table_.size()) resizeTable(table_bits_ + 1);
    return number;
  }
  void resizeTable(int bits) {
    table_bits_ = bits;
    table_.assign(std::size_t{1} << bits, 0);
    const std::uint32_t mask = static_cast<std::uint32_t>(table_.size() - 1);
    for (std::uint32_t number = 0; number < nodes_.size(); ++number) {
      std::uint32_t slot = slotOf(nodes_[number].place);
      while (table_[slot] != 0) slot = (slot + 1) & mask;
      table_[slot] = number + 1;
    }
  }

  int shift_ = 0;
  int table_bits_ = 0;
  std::vector<std::uint32_t> table_;  // number + 1, 0 where there is none
  std::vector<Node> nodes_;
  std::array<std::vector<Entry>, kKeyBits> buckets_;
  std::uint64_t filled_ = 0;  // a bit a bucket
  Key last_ = 0;
  std::size_t open_ = 0;
  std::size_t peak_open_ = 0;
};

}  // namespace grid_path_planner::planners
