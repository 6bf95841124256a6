// Search nodes in a hash table by cell, for searches that visit few cells of a large map.
//
//   HashedNodes<std::uint32_t> nodes;
//   nodes.reset(map_width);
//   auto& node = nodes[nodes.findOrInsert(cell)];  // of a new node `reached_by` is 0
//
// Nodes lie one after the other in the order of their insertion; an open-addressing table finds
// them by cell. Both grow with the search and are small again after reset(), so that a query on a
// map of any size works in the processor's caches and clears no more than it used.
#pragma once

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
    std::uint32_t packed_cell;
    std::uint32_t parent;  // number of a node
    Key g;
    std::uint8_t reached_by;  // bit n: reached at this g by the straight step n
    std::uint8_t unexpanded;  // those of reached_by that were not expanded yet
  };

  // Removes all nodes. `width`: of the map.
  void reset(int width) {
    shift_ = width > 1 ? 32 - __builtin_clz(static_cast<unsigned>(width - 1)) : 0;
    nodes_.clear();
    resizeTable(kFirstTableBits);
  }

  grid::Cell cell(std::uint32_t number) const {
    const std::uint32_t packed = nodes_[number].packed_cell;
    return {static_cast<int>(packed & ((std::uint32_t{1} << shift_) - 1)),
            static_cast<int>(std::uint64_t{packed} >> shift_)};
  }
  Node& operator[](std::uint32_t number) { return nodes_[number]; }
  const Node& operator[](std::uint32_t number) const { return nodes_[number]; }

  // The number of the cell's node; that of a new node has reached_by == 0.
  std::uint32_t findOrInsert(grid::Cell cell) {
    const std::uint32_t packed =
        static_cast<std::uint32_t>(std::uint64_t(cell.row) << shift_) | std::uint32_t(cell.column);
    const std::uint32_t mask = static_cast<std::uint32_t>(table_.size() - 1);
    for (std::uint32_t slot = slotOf(packed); true; slot = (slot + 1) & mask) {
      if (table_[slot] == 0) return insert(packed, slot);
      if (nodes_[table_[slot] - 1].packed_cell == packed) return table_[slot] - 1;
    }
  }

  std::size_t bytes() const {
    return nodes_.size() * sizeof(Node) + table_.size() * sizeof(std::uint32_t);
  }

 private:
  static constexpr int kFirstTableBits = 8;

  std::uint32_t slotOf(std::uint32_t packed) const {
    return (packed * 0x9E3779B1U) >> (32 - table_bits_);
  }
  std::uint32_t insert(std::uint32_t packed, std::uint32_t slot) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({packed, 0, 0, 0, 0});
    table_[slot] = number + 1;
    if (nodes_.size() * 2 > table_.size()) resizeTable(table_bits_ + 1);
    return number;
  }
  void resizeTable(int bits) {
    table_bits_ = bits;
    table_.assign(std::size_t{1} << bits, 0);
    const std::uint32_t mask = static_cast<std::uint32_t>(table_.size() - 1);
    for (std::uint32_t number = 0; number < nodes_.size(); ++number) {
      std::uint32_t slot = slotOf(nodes_[number].packed_cell);
      while (table_[slot] != 0) slot = (slot + 1) & mask;
      table_[slot] = number + 1;
    }
  }

  int shift_ = 0;  // of the row in a packed cell
  int table_bits_ = 0;
  std::vector<std::uint32_t> table_;  // number + 1, 0 where there is none
  std::vector<Node> nodes_;
};

}  // namespace grid_path_planner::planners
