// The corners at which the paths of a search turn, with a number for each.
//
// A hash table with linear probing and not an array over the map: a query touches some hundreds of
// corners of millions. Every query starts with a small table that grows, so that the corners of a
// small query stay in the processor's nearest cache, however large the queries before were.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/core/stamped_array.h"

namespace grid_path_planner::planners {

class CornerTable {
 public:
  CornerTable() : slots_(std::size_t{1} << kFewestBits) {}

  // Removes all corners, in constant time.
  void clear() {
    used_ = 0;
    bits_ = kFewestBits;
    clearSlots();
  }

  // The number of a corner, -1 for a new corner. The reference is valid until the next call.
  std::int32_t& operator[](std::uint64_t corner) {
    if (2 * (used_ + 1) > std::size_t{1} << bits_) grow();
    Slot& slot = find(corner);
    if (!stamp_.wrote(slot.stamp)) {
      slot = {corner, stamp_.word(), -1};
      ++used_;
    }
    return slot.value;
  }

  std::size_t bytes() const { return sizeof(Slot) << bits_; }

 private:
  struct Slot {
    std::uint64_t corner = 0;
    std::uint32_t stamp = 0;
    std::int32_t value = 0;
  };
  static constexpr int kFewestBits = 9;

  Slot& find(std::uint64_t corner) {
    const std::size_t mask = (std::size_t{1} << bits_) - 1;
    std::size_t at = corner * 0x9E3779B97F4A7C15U >> (64 - bits_);
    while (stamp_.wrote(slots_[at].stamp) && slots_[at].corner != corner) at = (at + 1) & mask;
    return slots_[at];
  }

  void grow() {
    std::vector<Slot> kept;
    kept.reserve(used_);
    for (std::size_t at = 0; at < std::size_t{1} << bits_; ++at)
      if (stamp_.wrote(slots_[at].stamp)) kept.push_back(slots_[at]);
    ++bits_;
    if (slots_.size() < std::size_t{1} << bits_) slots_.resize(std::size_t{1} << bits_);
    clearSlots();
    for (Slot slot : kept) {
      slot.stamp = stamp_.word();
      find(slot.corner) = slot;
    }
  }

  void clearSlots() {
    stamp_.next([this] { slots_.assign(slots_.size(), Slot()); });
  }

  std::vector<Slot> slots_;  // the first 2^bits_ are used
  int bits_ = kFewestBits;
  std::size_t used_ = 0;
  QueryStamp<std::uint32_t> stamp_;
};

}  // namespace grid_path_planner::planners
