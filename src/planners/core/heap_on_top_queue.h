// A heap-on-top queue (Cherkassky, Goldberg & Silverstein 1999): an open list for repairs, in which
// most entries are never popped. Small keys are in a heap, all others unsorted in buckets.
//
//   HeapOnTopQueue queue;
//   queue.reset(first, width);
//   queue.push({key, order, index});
//   while (queue.first(bound, renew) != nullptr) use(queue.pop());
//
// Keys below the horizon are in the heap. Keys beyond it are in buckets of the width given to
// reset(), and behind those in a list. When the heap is empty the horizon advances by one bucket,
// whose entries go into the heap. renew(entry) is called for each of them: it returns false for an
// entry that is out of date, else it may increase the entry's key. So an entry that goes out of
// date in a bucket costs a few nanoseconds. Keys may be pushed in any order.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "planners/core/binary_heap.h"
#include "planners/core/keys.h"

namespace grid_path_planner::planners {

class HeapOnTopQueue {
 public:
  struct Entry {
    SearchKey key;
    std::uint32_t order;  // of equal keys the larger comes first
    std::uint32_t index;
  };
  struct Worse {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.key != b.key ? a.key > b.key : a.order < b.order;
    }
  };

  // Makes it empty. Keys below `first` go into the heap.
  void reset(SearchKey first, SearchKey width) {
    heap_.clear();
    for (auto& bucket : buckets_) bucket.clear();
    overflow_.clear();
    in_buckets_ = 0;
    horizon_ = first;
    width_ = width;
    size_ = 0;
  }

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }

  void push(const Entry& entry) {
    ++size_;
    insert(entry);
  }

  // The entry with the least key, null where that is above `bound`.
  template <class Renew>
  const Entry* first(SearchKey bound, const Renew& renew) {
    while (heap_.empty() && size_ > 0 && horizon_ <= bound) advance(renew);
    return heap_.empty() || heap_.top().key > bound ? nullptr : &heap_.top();
  }
  // Removes the entry that first() returned.
  Entry pop() {
    --size_;
    return heap_.pop();
  }

  std::size_t bytes() const {
    std::size_t entries = overflow_.capacity();
    for (const auto& bucket : buckets_) entries += bucket.capacity();
    return heap_.bytes() + entries * sizeof(Entry);
  }

 private:
  static constexpr std::size_t kBuckets = 256;

  void insert(const Entry& entry) {
    if (entry.key < horizon_) return heap_.push(entry);
    const SearchKey number = (entry.key - horizon_) / width_;
    if (number >= kBuckets) return overflow_.push_back(entry);
    buckets_[(first_ + number) % kBuckets].push_back(entry);
    ++in_buckets_;
  }

  // Moves the horizon by one bucket.
  template <class Renew>
  void advance(const Renew& renew) {
    if (in_buckets_ == 0) return advanceToOverflow(renew);
    moved_.swap(buckets_[first_]);
    in_buckets_ -= moved_.size();
    first_ = (first_ + 1) % kBuckets;
    horizon_ += width_;
    insertMoved(renew);
    if (first_ == 0) {  // the buckets have reached the keys of the list behind them
      moved_.swap(overflow_);
      insertMoved(renew);
    }
  }

  // Precondition: heap and buckets are empty.
  template <class Renew>
  void advanceToOverflow(const Renew& renew) {
    horizon_ = kInfiniteKey;
    for (const Entry& entry : overflow_) horizon_ = std::min(horizon_, entry.key);
    moved_.swap(overflow_);
    insertMoved(renew);
  }

  template <class Renew>
  void insertMoved(const Renew& renew) {
    for (Entry& entry : moved_) {
      if (renew(entry))
        insert(entry);
      else
        --size_;
    }
    moved_.clear();
  }

  BinaryHeap<Entry, Worse> heap_;
  std::array<std::vector<Entry>, kBuckets> buckets_;  // from the horizon on, the first at first_
  std::vector<Entry> overflow_;                       // behind the buckets
  std::vector<Entry> moved_;
  std::size_t in_buckets_ = 0;
  std::size_t first_ = 0;
  SearchKey horizon_ = 0;
  SearchKey width_ = 1;
  std::size_t size_ = 0;
};

}  // namespace grid_path_planner::planners
