// An open list that costs a few nanoseconds an entry: cell indices in buckets of nearly equal keys.
//
//   BucketQueue open;
//   open.reset(f_of_the_start, width_shift);
//   open.push(f, index);
//   while (!open.empty()) index = open.pop();
//
// Guaranteed: pop() removes an entry of the lowest bucket that is not empty, the one pushed last, so
// the order depends on nothing but the calls. A key below the lowest bucket goes into it. Keys
// within a bucket (of width 2^shift) are NOT ordered: a search must re-open cells that get cheaper,
// and may stop only when lowest() has reached the cost of the goal it found.
//
// Entries are 4 bytes, in chunks that the buckets share. There is a window of buckets from the
// lowest one on; keys beyond it are in a list until the window is used up. Buckets become wider
// where many were passed for few entries. What was measured: doc/notes/engine_experiments.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "planners/core/keys.h"

namespace grid_path_planner::planners {

class BucketQueue {
 public:
  using Index = std::uint32_t;

  // Makes it empty, in time proportional to its size; for keys from about `first` on, in buckets
  // 2^shift wide.
  void reset(SearchKey first, unsigned shift);

  void push(SearchKey key, Index index) {
    ++size_;
    const SearchKey number = key >> shift_;
    if (number >= window_end_) {
      later_.push_back({key, index});
      return;
    }
    put(number <= current_ ? current_ : number, index);
  }

  // Precondition of both: not empty().
  Index pop() {
    if (bucket(current_).chunk == nullptr) advance();
    --size_;
    ++popped_;
    Bucket& lowest = bucket(current_);
    const Index index = lowest.chunk->entries[--lowest.used];
    if (lowest.used == 0) releaseChunk(lowest);
    return index;
  }
  // A lower bound of the least key: only a key pushed below the lowest bucket may be less.
  SearchKey lowest() {
    if (bucket(current_).chunk == nullptr) advance();
    return current_ << shift_;
  }

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }

 private:
  static constexpr std::size_t kBuckets = 1024;
  static constexpr std::uint32_t kChunkEntries = 62;
  static constexpr std::size_t kChunksTogether = 64;

  struct Chunk {
    Chunk* below;  // of the same bucket, full
    std::array<Index, kChunkEntries> entries;
  };
  struct Bucket {
    Chunk* chunk = nullptr;
    std::uint32_t used = kChunkEntries;  // entries of chunk
  };
  struct Later {
    SearchKey key;
    Index index;
  };

  Bucket& bucket(SearchKey number) { return buckets_[number % kBuckets]; }
  void put(SearchKey number, Index index) {
    Bucket& to = bucket(number);
    if (to.used == kChunkEntries) addChunk(to, number);
    to.chunk->entries[to.used++] = index;
  }
  void setWindow(SearchKey first);
  void addChunk(Bucket& to, SearchKey number);
  void releaseChunk(Bucket& from);  // its uppermost chunk, which is empty
  void advance();
  void nextWindow();

  // Bucket n % kBuckets holds the keys with key >> shift_ == n, for n in a window whose end is a
  // multiple of kBuckets.
  std::array<Bucket, kBuckets> buckets_;
  std::array<std::uint64_t, kBuckets / 64> filled_{};  // a bit a bucket: 0 where it is empty
  SearchKey current_ = 0;                              // the lowest n that may hold any
  SearchKey window_end_ = 0;
  unsigned shift_ = 0;
  std::size_t size_ = 0;
  std::size_t popped_ = 0;  // since the window began
  std::vector<Later> later_;
  Chunk* spare_ = nullptr;
  std::vector<std::unique_ptr<std::array<Chunk, kChunksTogether>>> chunks_;
};

}  // namespace grid_path_planner::planners
