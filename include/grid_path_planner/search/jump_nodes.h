// What a search over few cells of a large map remembers of them, and its open list.
//
// Nodes lie one after the other in the order in which they were first seen; a hash table finds them
// by cell. Both grow with the search and are small again at the next one, so that a query on a map
// of any size works in the processor's caches and clears no more than it used.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner {

// `Key`: an unsigned integer that orders costs.
template <class Key>
class JumpNodes {
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
    open_.clear();
    peak_open_ = 0;
    resizeTable(kFirstTableBits);
  }

  Cell cell(std::uint32_t number) const {
    const std::uint32_t place = nodes_[number].place;
    return {static_cast<int>(place & ((std::uint32_t{1} << shift_) - 1)),
            static_cast<int>(std::uint64_t{place} >> shift_)};
  }
  Node& operator[](std::uint32_t number) { return nodes_[number]; }
  const Node& operator[](std::uint32_t number) const { return nodes_[number]; }

  // The node of a cell; a new one has arrived == 0.
  std::uint32_t find(Cell cell) {
    const std::uint32_t place =
        static_cast<std::uint32_t>(std::uint64_t(cell.row) << shift_) | std::uint32_t(cell.column);
    const std::uint32_t mask = static_cast<std::uint32_t>(table_.size() - 1);
    for (std::uint32_t slot = slotOf(place); true; slot = (slot + 1) & mask) {
      if (table_[slot] == 0) return insert(place, slot);
      if (nodes_[table_[slot] - 1].place == place) return table_[slot] - 1;
    }
  }

  bool open() const { return !open_.empty(); }
  void push(Key f, std::uint32_t number) {
    open_.push_back({f, ~number});
    std::push_heap(open_.begin(), open_.end(), Later());
    peak_open_ = std::max(peak_open_, open_.size());
  }
  // The one of least f, of equal ones the latest seen. Precondition: open().
  std::uint32_t pop() {
    std::pop_heap(open_.begin(), open_.end(), Later());
    const std::uint32_t number = ~open_.back().inverse;
    open_.pop_back();
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
    std::uint32_t inverse;
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.f != b.f ? a.f > b.f : a.inverse > b.inverse;
    }
  };

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
  std::vector<Entry> open_;
  std::size_t peak_open_ = 0;
};

}  // namespace grid_path_planner
