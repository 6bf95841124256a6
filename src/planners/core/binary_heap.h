// A binary heap (Williams 1964), the open list of searches whose keys buckets cannot hold.
//
//   BinaryHeap<int, std::greater<>> open;
//   open.push(3);
//   while (!open.empty()) use(open.pop());  // the least first
//
// `Worse(a, b)`: whether a comes after b. Of several entries that may come first any does; the same
// calls give the same order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace grid_path_planner::planners {

template <class Entry, class Worse>
class BinaryHeap {
 public:
  bool empty() const { return entries_.empty(); }
  std::size_t size() const { return entries_.size(); }
  void clear() { entries_.clear(); }

  void push(const Entry& entry) {
    entries_.push_back(entry);
    std::push_heap(entries_.begin(), entries_.end(), Worse());
  }

  // Precondition of both: not empty().
  const Entry& top() const { return entries_.front(); }
  Entry pop() {
    std::pop_heap(entries_.begin(), entries_.end(), Worse());
    const Entry entry = entries_.back();
    entries_.pop_back();
    return entry;
  }

  // Memory that is held.
  std::size_t bytes() const { return entries_.capacity() * sizeof(Entry); }

 private:
  std::vector<Entry> entries_;
};

}  // namespace grid_path_planner::planners
