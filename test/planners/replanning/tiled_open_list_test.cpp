// The tiled open list against a plain list of all open cells.
#include "planners/replanning/tiled_open_list.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::CostGrid;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;

namespace {

using Index = TiledOpenList::Index;

// A map with random g-values.
class RandomTree {
 public:
  explicit RandomTree(std::mt19937& random) : random_(random), map_(openMap()) {
    moves_.build(map_, StopToken());
    nodes_.prepare(map_, moves_);
    nodes_.setMap(map_);
    list_.prepare(map_.geometry());
    reset();
  }

  void reset() {
    nodes_.reset(0);
    nodes_.setState(0, BackwardNodes::CLOSED);
    keys_.reset(nodes_, map_, test::randomCell(random_, map_.geometry()));
    list_.reset(40 * kPackedScale.straight, 2 * kPackedScale.straight);
    open_.clear();
  }

  BackwardNodes& nodes() { return nodes_; }
  DStarKeys& keys() { return keys_; }
  TiledOpenList& list() { return list_; }
  const std::set<Index>& open() const { return open_; }

  void push() {
    const auto index = static_cast<Index>(random_() % map_.geometry().size());
    const bool known = nodes_.state(index) != BackwardNodes::NEW;
    const SearchKey g = (20 + random_() % 300) * kPackedScale.straight + random_() % 1000;
    if (index == nodes_.root() || (known && nodes_.g(index) <= g)) return;
    nodes_.set(index, g, 0, BackwardNodes::OPEN);
    list_.push(keys_, index);
    open_.insert(index);
  }
  void close(Index index) {
    nodes_.setState(index, BackwardNodes::CLOSED);
    open_.erase(index);
  }
  void closeAny() {
    if (!open_.empty()) close(*open_.begin());
  }
  void moveStart() {
    Cell start = keys_.start();
    start.column = std::min(start.column + static_cast<int>(random_() % 3), 199);
    start.row = std::min(start.row + static_cast<int>(random_() % 3), 139);
    keys_.moveStart(start);
  }
  std::size_t below(SearchKey bound) const {
    std::size_t number = 0;
    for (const Index index : open_) number += keys_.of(index) < bound ? 1 : 0;
    return number;
  }

 private:
  static CostGrid openMap() { return test::costMap(test::Weights(GridGeometry(200, 140, 1.0), 1)); }

  std::mt19937& random_;
  CostGrid map_;
  MovePruning moves_;
  BackwardNodes nodes_;
  DStarKeys keys_;
  TiledOpenList list_;
  std::set<Index> open_;
};

TEST(TiledOpenListLaw, PopsAllCellsBelowABoundInOrderAndNoOthers) {
  std::mt19937 random(41);
  for (int trial = 0; trial < 20; ++trial) {
    RandomTree map(random);
    for (int round = 0; round < 60; ++round) {
      if (round % 25 == 24) {
        map.reset();
        ASSERT_EQ(map.list().size(), 0U);
        ASSERT_EQ(map.list().first(kInfiniteKey, map.keys()), nullptr);
      }
      for (int i = 0; i < 80; ++i) map.push();
      for (int i = 0; i < 9; ++i) map.closeAny();
      map.moveStart();
      const SearchKey bound = map.keys().withKeyModifier((50 + 4 * static_cast<SearchKey>(round)) *
                                                         kPackedScale.straight);
      const std::size_t expected = map.below(bound);
      std::size_t popped = 0;
      SearchKey last = 0;
      while (map.list().first(bound, map.keys()) != nullptr) {
        const TiledOpenList::Entry entry = map.list().pop();
        if (map.nodes().state(entry.index) != BackwardNodes::OPEN) continue;
        const SearchKey key = map.keys().of(entry.index);
        ASSERT_LE(entry.key, key);
        if (entry.key < key) {
          map.list().push(map.keys(), entry.index);
          continue;
        }
        ASSERT_LT(key, bound);
        ASSERT_GE(key, last);
        last = key;
        map.close(entry.index);
        ++popped;
      }
      ASSERT_EQ(popped, expected) << "round " << round;
      ASSERT_EQ(map.below(bound), 0U);
      ASSERT_GE(map.list().size(), map.open().size());
    }
  }
}

TEST(DStarKeysLaw, NoKeyIsLessThanTheLowerBoundOfItsRectangle) {
  std::mt19937 random(43);
  RandomTree map(random);
  for (int i = 0; i < 4000; ++i) map.push();
  for (int trial = 0; trial < 2000; ++trial) {
    const CellRect rect{static_cast<int>(random() % 190), static_cast<int>(random() % 130), 10, 10};
    SearchKey least = kInfiniteKey, least_g = kInfiniteKey;
    for (const Index index : map.open()) {
      if (!rect.contains(map.nodes().cell(index))) continue;
      least = std::min(least, map.keys().of(index));
      least_g = std::min(least_g, map.nodes().g(index));
    }
    if (least == kInfiniteKey) continue;
    ASSERT_LE(map.keys().lowerBound(rect, least_g), least);
    if (trial % 8 == 0) map.moveStart();
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
