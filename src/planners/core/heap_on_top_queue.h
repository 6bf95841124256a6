// An open list for repairs, where most of what waits will never be asked for: sorted as far as it
// has been asked for, and thrown into buckets beyond.
//
//   HeapOnTopQueue queue;
//   queue.begin(first, width);
//   queue.push({key, order, index});
//   while (queue.first(bound, renew) != nullptr) use(queue.pop());
//
// Keys below the horizon are in a heap. What lies beyond waits unsorted, in buckets as wide as
// begin() was told and in a list behind them; a bucket is looked through when the heap is used up
// and the horizon passes it. renew(entry) is asked then: false for an entry that means nothing any
// more, else it may raise the entry's key. So entries that go out of date in the buckets cost a few
// nanoseconds. Keys may be pushed in any order.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "grid_path_planner/planners/keys.h"

namespace grid_path_planner::planners {

class HeapOnTopQueue {
 public:
  struct Entry {
    SearchKey key;
    std::uint32_t order;  // of equal keys the larger comes first
    std::uint32_t index;
  };

  // Forgets everything. Keys below `first` are sorted at once.
  void begin(SearchKey first, SearchKey width) {
    heap_.clear();
    for (auto& bucket : buckets_) bucket.clear();
    beyond_.clear();
    in_buckets_ = 0;
    horizon_ = first;
    width_ = width;
    size_ = 0;
  }

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }

  void push(const Entry& entry) {
    ++size_;
    place(entry);
  }

  // The entry with the least key, null where that is above `bound`.
  template <class Renew>
  const Entry* first(SearchKey bound, const Renew& renew) {
    while (heap_.empty() && size_ > 0 && horizon_ <= bound) passBucket(renew);
    return heap_.empty() || heap_.front().key > bound ? nullptr : &heap_.front();
  }
  // Takes what first() gave.
  Entry pop() {
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    const Entry entry = heap_.back();
    heap_.pop_back();
    --size_;
    return entry;
  }

  std::size_t bytes() const {
    std::size_t entries = heap_.capacity() + beyond_.capacity();
    for (const auto& bucket : buckets_) entries += bucket.capacity();
    return entries * sizeof(Entry);
  }

 private:
  static constexpr std::size_t kBuckets = 256;

  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.key != b.key ? a.key > b.key : a.order < b.order;
    }
  };

  void place(const Entry& entry) {
    if (entry.key < horizon_) {
      heap_.push_back(entry);
      std::push_heap(heap_.begin(), heap_.end(), Later());
      return;
    }
    const SearchKey number = (entry.key - horizon_) / width_;
    if (number >= kBuckets) return beyond_.push_back(entry);
    buckets_[(first_ + number) % kBuckets].push_back(entry);
    ++in_buckets_;
  }

  template <class Renew>
  void passBucket(const Renew& renew) {
    if (in_buckets_ == 0) return passToBeyond(renew);
    moved_.swap(buckets_[first_]);
    in_buckets_ -= moved_.size();
    first_ = (first_ + 1) % kBuckets;
    horizon_ += width_;
    placeMoved(renew);
    if (first_ == 0) {  // the buckets have passed what was beyond them
      moved_.swap(beyond_);
      placeMoved(renew);
    }
  }

  // Precondition: there is nothing in the heap and the buckets.
  template <class Renew>
  void passToBeyond(const Renew& renew) {
    horizon_ = kInfiniteKey;
    for (const Entry& entry : beyond_) horizon_ = std::min(horizon_, entry.key);
    moved_.swap(beyond_);
    placeMoved(renew);
  }

  template <class Renew>
  void placeMoved(const Renew& renew) {
    for (Entry& entry : moved_) {
      if (renew(entry))
        place(entry);
      else
        --size_;
    }
    moved_.clear();
  }

  std::vector<Entry> heap_;
  std::array<std::vector<Entry>, kBuckets> buckets_;  // from the horizon on, the first at first_
  std::vector<Entry> beyond_;
  std::vector<Entry> moved_;
  std::size_t in_buckets_ = 0;
  std::size_t first_ = 0;
  SearchKey horizon_ = 0;
  SearchKey width_ = 1;
  std::size_t size_ = 0;
};

}  // namespace grid_path_planner::planners
