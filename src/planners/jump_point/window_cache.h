// Numbers of natural steps by window of weights, as windows repeat: a cache in front of
// planners/core/natural_moves.h. A new window overwrites another of the same hash.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "planners/core/natural_moves.h"

namespace grid_path_planner::planners {

class WindowCache {
 public:
  static constexpr int kMostBits = 14;

  static std::size_t bytesFor(std::size_t cells) {
    return (std::size_t{1} << bitsFor(cells)) * sizeof(Entry);
  }

  WindowCache() = default;
  // `cells`: about as many windows will be asked for.
  explicit WindowCache(std::size_t cells)
      : bits_(bitsFor(cells)), entries_(std::size_t{1} << bits_) {}

  // The number of the window, or number() of it.
  template <class Number>
  std::uint32_t find(const Window& window, const Number& number) {
    const Packed packed(window);
    Entry& entry = entries_[packed.hash() >> (64 - bits_)];
    if (!entry.used || !(entry.window == packed)) entry = {packed, number(window), true};
    return entry.number;
  }

 private:
  struct Packed {
    std::uint64_t low = 0, high = 0;
    std::uint16_t last = 0;

    Packed() = default;
    explicit Packed(const Window& window) : last(window[8]) {
      std::memcpy(&low, window.data(), sizeof low);
      std::memcpy(&high, window.data() + 4, sizeof high);
    }
    std::uint64_t hash() const {
      std::uint64_t hash = (low ^ last) * 0x9E3779B97F4A7C15U;
      hash = (hash ^ hash >> 32 ^ high) * 0xC2B2AE3D27D4EB4FU;
      return (hash ^ hash >> 29) * 0x9E3779B97F4A7C15U;
    }
    friend bool operator==(const Packed& a, const Packed& b) {
      return a.low == b.low && a.high == b.high && a.last == b.last;
    }
  };
  struct Entry {
    Packed window;
    std::uint32_t number = 0;
    bool used = false;
  };

  static int bitsFor(std::size_t cells) {
    int bits = 1;
    while (bits < kMostBits && std::size_t{1} << bits < cells) ++bits;
    return bits;
  }

  int bits_ = 1;
  std::vector<Entry> entries_ = std::vector<Entry>(2);
};

}  // namespace grid_path_planner::planners
