// The corners that a search has turned at, with a number for each.
//
// A hash of what was touched and not an array over the map: a query touches some hundreds of
// corners of millions. It begins small for every query and grows with it, so that those of a small
// query stay in the processor's nearest cache whatever was asked before.
#pragma once

#include <cstdint>
#include <vector>

namespace grid_path_planner::planners {

class CornerTable {
 public:
  CornerTable() : slots_(std::size_t{1} << kLeastBits) {}

  // Forgets everything, in no time.
  void clear() {
    used_ = 0;
    bits_ = kLeastBits;
    nextQuery();
  }

  // The number kept for a corner, -1 where there is none. It may be written until the next call.
  std::int32_t& operator[](std::uint64_t corner) {
    if (2 * (used_ + 1) > std::size_t{1} << bits_) grow();
    Slot& slot = find(corner);
    if (slot.query != query_) {
      slot = {corner, query_, -1};
      ++used_;
    }
    return slot.value;
  }

  std::size_t bytes() const { return sizeof(Slot) << bits_; }

 private:
  struct Slot {
    std::uint64_t corner = 0;
    std::uint32_t query = 0;
    std::int32_t value = 0;
  };
  static constexpr int kLeastBits = 9;

  Slot& find(std::uint64_t corner) {
    const std::size_t mask = (std::size_t{1} << bits_) - 1;
    std::size_t at = corner * 0x9E3779B97F4A7C15U >> (64 - bits_);
    while (slots_[at].query == query_ && slots_[at].corner != corner) at = (at + 1) & mask;
    return slots_[at];
  }

  void grow() {
    std::vector<Slot> kept;
    kept.reserve(used_);
    for (std::size_t at = 0; at < std::size_t{1} << bits_; ++at)
      if (slots_[at].query == query_) kept.push_back(slots_[at]);
    ++bits_;
    if (slots_.size() < std::size_t{1} << bits_) slots_.resize(std::size_t{1} << bits_);
    nextQuery();
    for (Slot slot : kept) {
      slot.query = query_;
      find(slot.corner) = slot;
    }
  }

  void nextQuery() {
    if (++query_ != 0) return;
    slots_.assign(slots_.size(), Slot());
    query_ = 1;
  }

  std::vector<Slot> slots_;  // the first 2^bits_ are used
  int bits_ = kLeastBits;
  std::size_t used_ = 0;
  std::uint32_t query_ = 1;
};

}  // namespace grid_path_planner::planners
