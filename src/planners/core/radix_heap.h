// Radix heap (Ahuja, Mehlhorn, Orlin & Tarjan 1990): a monotone priority queue of unsigned integer
// keys.
//
//   RadixHeap<std::uint32_t> open;
//   open.push(f, node);
//   while (!open.empty()) node = open.pop();
//
// Guaranteed: pop() returns a value of the least key, and the order of equal keys depends on
// nothing but the calls. Not guaranteed: anything for a key that is less than that of the last
// value popped, which only a consistent heuristic excludes, or for a 64-bit key from 2^63 on.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace grid_path_planner::planners {

template <class Key>
class RadixHeap {
 public:
  struct Entry {
    Key key;
    std::uint32_t value;
  };

  // Removes all entries; the next keys may be any. Keeps the memory.
  void clear() {
    for (std::vector<Entry>& bucket : buckets_) bucket.clear();
    filled_ = 0;
    last_ = 0;
    size_ = peak_size_ = 0;
  }

  bool empty() const { return size_ == 0; }

  // Precondition: `key` is not less than that of the last value popped.
  void push(Key key, std::uint32_t value) {
    put({key, value});
    if (++size_ > peak_size_) peak_size_ = size_;
  }

  // Precondition: not empty().
  std::uint32_t pop() {
    if (buckets_[0].empty()) spreadLowest();
    const std::uint32_t value = buckets_[0].back().value;
    buckets_[0].pop_back();
    --size_;
    return value;
  }

  // The largest number of entries since clear().
  std::size_t peakSize() const { return peak_size_; }

 private:
  static_assert(!std::numeric_limits<Key>::is_signed);
  static constexpr std::size_t kBuckets =
      std::min(64, 1 + std::numeric_limits<Key>::digits);  // bits of filled_

  void put(const Entry& entry) {
    const Key difference = entry.key ^ last_;
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
    last_ = bucket.front().key;
    for (const Entry& entry : bucket) last_ = std::min(last_, entry.key);
    for (const Entry& entry : bucket) put(entry);
    bucket.clear();
    filled_ &= ~(std::uint64_t{1} << lowest);
  }

  // Bucket b > 0 holds the keys whose highest bit that differs from last_ is bit b - 1; bucket 0
  // the equal ones.
  std::array<std::vector<Entry>, kBuckets> buckets_;
  std::uint64_t filled_ = 0;  // bit b: bucket b may hold entries
  Key last_ = 0;              // the least key when a bucket was spread last
  std::size_t size_ = 0;
  std::size_t peak_size_ = 0;
};

}  // namespace grid_path_planner::planners
