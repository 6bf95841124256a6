#include "planners/core/bucket_queue.h"

#include <algorithm>
#include <cassert>

namespace grid_path_planner::planners {

void BucketQueue::reset(SearchKey first, unsigned shift) {
  for (std::size_t word = 0; word < filled_.size(); ++word)
    for (; filled_[word] != 0;) {
      Bucket& left = buckets_[word * 64 + static_cast<std::size_t>(__builtin_ctzll(filled_[word]))];
      while (left.chunk != nullptr) releaseChunk(left);
      filled_[word] &= filled_[word] - 1;
    }
  later_.clear();
  size_ = 0;
  shift_ = shift;
  setWindow(first >> shift_);
}

void BucketQueue::setWindow(SearchKey first) {
  current_ = first;
  window_end_ = (first / kBuckets + 1) * kBuckets;
  popped_ = 0;
}

void BucketQueue::addChunk(Bucket& to, SearchKey number) {
  if (spare_ == nullptr) {
    chunks_.push_back(std::make_unique<std::array<Chunk, kChunksTogether>>());
    for (Chunk& chunk : *chunks_.back()) {
      chunk.below = spare_;
      spare_ = &chunk;
    }
  }
  if (to.chunk == nullptr) {
    const SearchKey bit = number % kBuckets;
    filled_[bit / 64] |= std::uint64_t{1} << (bit % 64);
  }
  Chunk* chunk = spare_;
  spare_ = chunk->below;
  chunk->below = to.chunk;
  to.chunk = chunk;
  to.used = 0;
}

void BucketQueue::releaseChunk(Bucket& from) {
  Chunk* chunk = from.chunk;
  from.chunk = chunk->below;
  from.used = kChunkEntries;
  chunk->below = spare_;
  spare_ = chunk;
}

void BucketQueue::advance() {
  assert(!empty());
  SearchKey bit = current_ % kBuckets;
  filled_[bit / 64] &= ~(std::uint64_t{1} << (bit % 64));
  std::size_t word = bit / 64;
  while (filled_[word] == 0) {
    if (++word < filled_.size()) continue;
    nextWindow();
    word = current_ % kBuckets / 64;
  }
  bit = word * 64 + static_cast<SearchKey>(__builtin_ctzll(filled_[word]));
  current_ = window_end_ - kBuckets + bit;
}

// Buckets become wider where few entries were popped: for many buckets, or for many entries beyond
// the window, all of which are distributed again.
void BucketQueue::nextWindow() {
  if (popped_ < std::max(kBuckets, later_.size())) ++shift_;
  SearchKey least = kInfiniteKey;
  for (const Later& entry : later_) least = std::min(least, entry.key);
  setWindow(least >> shift_);
  std::size_t kept = 0;
  for (const Later& entry : later_) {
    const SearchKey number = entry.key >> shift_;
    if (number < window_end_)
      put(number, entry.index);
    else
      later_[kept++] = entry;
  }
  later_.resize(kept);
}

}  // namespace grid_path_planner::planners
