// What waits, by tiles, against a plain list of all that waits.
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

// A map on which labels are written at random.
class Labelled {
 public:
  explicit Labelled(std::mt19937& random) : random_(random), map_(openMap()) {
    moves_.build(map_, StopToken());
    labels_.prepare(map_, moves_);
    labels_.setMap(map_);
    waiting_.prepare(map_.geometry());
    begin();
  }

  void begin() {
    labels_.begin(0);
    labels_.setState(0, BackwardNodes::CLOSED);
    keys_.begin(labels_, map_, test::randomCell(random_, map_.geometry()));
    waiting_.begin(40 * kPackedScale.straight, 2 * kPackedScale.straight);
    open_.clear();
  }

  BackwardNodes& labels() { return labels_; }
  DStarKeys& keys() { return keys_; }
  TiledOpenList& waiting() { return waiting_; }
  const std::set<Index>& open() const { return open_; }

  void wait() {
    const auto index = static_cast<Index>(random_() % map_.geometry().size());
    const bool known = labels_.state(index) != BackwardNodes::UNLABELLED;
    const SearchKey label = (20 + random_() % 300) * kPackedScale.straight + random_() % 1000;
    if (index == labels_.root() || (known && labels_.g(index) <= label)) return;
    labels_.set(index, label, 0, BackwardNodes::OPEN);
    waiting_.push(keys_, index);
    open_.insert(index);
  }
  void close(Index index) {
    labels_.setState(index, BackwardNodes::CLOSED);
    open_.erase(index);
  }
  void closeAny() {
    if (!open_.empty()) close(*open_.begin());
  }
  void move() {
    Cell start = keys_.start();
    start.column = std::min(start.column + static_cast<int>(random_() % 3), 199);
    start.row = std::min(start.row + static_cast<int>(random_() % 3), 139);
    keys_.move(start);
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
  BackwardNodes labels_;
  DStarKeys keys_;
  TiledOpenList waiting_;
  std::set<Index> open_;
};

TEST(WaitingCellsLaw, WhatIsBelowABoundComesInOrderAndNothingElse) {
  std::mt19937 random(41);
  for (int trial = 0; trial < 20; ++trial) {
    Labelled map(random);
    for (int round = 0; round < 60; ++round) {
      if (round % 25 == 24) {
        map.begin();
        ASSERT_EQ(map.waiting().size(), 0U);
        ASSERT_EQ(map.waiting().first(kInfiniteKey, map.keys()), nullptr);
      }
      for (int i = 0; i < 80; ++i) map.wait();
      for (int i = 0; i < 9; ++i) map.closeAny();
      map.move();
      const SearchKey bound = map.keys().withKeyModifier((50 + 4 * static_cast<SearchKey>(round)) *
                                                         kPackedScale.straight);
      const std::size_t expected = map.below(bound);
      std::size_t taken = 0;
      SearchKey last = 0;
      while (map.waiting().first(bound, map.keys()) != nullptr) {
        const TiledOpenList::Entry entry = map.waiting().pop();
        if (map.labels().state(entry.index) != BackwardNodes::OPEN) continue;
        const SearchKey key = map.keys().of(entry.index);
        ASSERT_LE(entry.key, key);
        if (entry.key < key) {
          map.waiting().push(map.keys(), entry.index);
          continue;
        }
        ASSERT_LT(key, bound);
        ASSERT_GE(key, last);
        last = key;
        map.close(entry.index);
        ++taken;
      }
      ASSERT_EQ(taken, expected) << "round " << round;
      ASSERT_EQ(map.below(bound), 0U);
      ASSERT_GE(map.waiting().size(), map.open().size());
    }
  }
}

TEST(RisingKeysLaw, NoCellIsBelowTheLeastOfItsRectangle) {
  std::mt19937 random(43);
  Labelled map(random);
  for (int i = 0; i < 4000; ++i) map.wait();
  for (int trial = 0; trial < 2000; ++trial) {
    const CellRect rect{static_cast<int>(random() % 190), static_cast<int>(random() % 130), 10, 10};
    SearchKey least = kInfiniteKey, least_label = kInfiniteKey;
    for (const Index index : map.open()) {
      if (!rect.contains(map.labels().cell(index))) continue;
      least = std::min(least, map.keys().of(index));
      least_label = std::min(least_label, map.labels().g(index));
    }
    if (least == kInfiniteKey) continue;
    ASSERT_LE(map.keys().leastOf(rect, least_label), least);
    if (trial % 8 == 0) map.move();
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
