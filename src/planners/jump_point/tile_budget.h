// How many tiles of the jumps searches may make: what A* expanded in their place pays for them.
//
// One is made in the time of some ten thousand expansions, and little is lost if it is never used.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace grid_path_planner::planners {

class TileBudget {
 public:
  std::uint64_t left() const { return left_; }

  void reset() { *this = TileBudget(); }
  void add(std::uint64_t tiles) { left_ += tiles; }
  void spend(std::uint64_t tiles) { left_ -= std::min(left_, tiles); }

  // Tiles that an update undid. Few are made anew by the searches that come to them: A* in their place would
  // take longer.
  void addUndone(std::uint64_t tiles) {
    if (tiles <= kMostRemade) add(tiles);
  }

  // By what A* expanded on a map of so many cells.
  void pay(std::size_t expanded, std::size_t cells) {
    expanded_ += expanded;
    const std::size_t price = expanded_ < kMapsAtFirst * cells ? kFirstTilePrice : kTilePrice;
    paid_ += expanded;
    add(paid_ / price);
    paid_ %= price;
  }

 private:
  // Expansions of A* for which a search may make one more tile: many at first, since most maps see a few
  // plans or idle time, fewer once A* has expanded as many cells as so many maps have.
  static constexpr std::size_t kFirstTilePrice = 786432;
  static constexpr std::size_t kTilePrice = 196608;
  static constexpr std::size_t kMapsAtFirst = 8;
  // Made again in the time of 1 to 5 ms.
  static constexpr std::uint64_t kMostRemade = 32;

  std::uint64_t left_ = 0;
  std::size_t paid_ = 0;      // expansions towards the next tile
  std::size_t expanded_ = 0;  // by A* since the map is prepared
};

}  // namespace grid_path_planner::planners
