#include "planners/replanning/tiled_open_list.h"

#include <algorithm>

namespace grid_path_planner::planners {

using grid::CellRect, grid::GridGeometry;

void TiledOpenList::prepare(const GridGeometry& geometry) {
  const auto tiles = [](int cells) {
    return static_cast<std::uint32_t>((cells - 1) >> kSideBits) + 1;
  };
  across_ = tiles(geometry.width());
  tile_at_ = std::vector<Tile>(std::size_t{across_} * tiles(geometry.height()));  // without memory
  used_.clear();
  reserved_ = 0;
}

void TiledOpenList::reset(SearchKey first, SearchKey width) {
  for (const std::uint32_t number : used_) tile_at_[number] = Tile();
  used_.clear();
  reserved_ = 0;
  tiles_.reset(first, width);
  cells_.clear();
  size_ = 0;
}

std::size_t TiledOpenList::bytes() const {
  return tile_at_.size() * sizeof(Tile) + used_.capacity() * sizeof(std::uint32_t) +
         reserved_ * sizeof(Index) + tiles_.bytes() + cells_.bytes();
}

CellRect TiledOpenList::rectOf(std::uint32_t tile) const {
  constexpr int kSide = 1 << kSideBits;
  return {static_cast<int>(tile % across_) * kSide, static_cast<int>(tile / across_) * kSide, kSide,
          kSide};
}

void TiledOpenList::push(const DStarKeys& keys, Index index) {
  ++size_;
  const std::uint32_t number = tileOf(keys.nodes().cell(index));
  Tile& tile = tile_at_[number];
  const std::size_t reserved = tile.cells.capacity();
  if (reserved == 0) used_.push_back(number);
  tile.cells.push_back(index);
  reserved_ += tile.cells.capacity() - reserved;
  tile.least_g = std::min(tile.least_g, keys.nodes().g(index));
  const SearchKey key = keys.of(index);
  if (key < tile.queued) pushTile(number, key);
}

void TiledOpenList::pushTile(std::uint32_t number, SearchKey key) {
  tile_at_[number].queued = key;
  tiles_.push({key, 0, number});
}

const TiledOpenList::Entry* TiledOpenList::first(SearchKey below, const DStarKeys& keys) {
  const auto renew = [&](HeapOnTopQueue::Entry& entry) {
    Tile& tile = tile_at_[entry.index];
    if (entry.key != tile.queued) return false;
    tile.queued = std::max(tile.queued, keys.lowerBound(rectOf(entry.index), tile.least_g));
    entry.key = tile.queued;
    return true;
  };
  while (true) {
    const SearchKey bound = cells_.empty() ? below : std::min(below, cells_.top().key);
    const HeapOnTopQueue::Entry* next = tiles_.first(bound, renew);
    if (next == nullptr || next->key >= bound) break;
    HeapOnTopQueue::Entry entry = tiles_.pop();
    const SearchKey old = entry.key;
    if (!renew(entry)) continue;
    if (entry.key > old)
      tiles_.push(entry);
    else
      openTile(entry.index, below, keys);
  }
  return cells_.empty() || cells_.top().key >= below ? nullptr : &cells_.top();
}

TiledOpenList::Entry TiledOpenList::pop() {
  --size_;
  return cells_.pop();
}

void TiledOpenList::openTile(std::uint32_t number, SearchKey below, const DStarKeys& keys) {
  Tile& tile = tile_at_[number];
  SearchKey least = kInfiniteKey;
  tile.least_g = tile.queued = kInfiniteKey;
  std::size_t kept = 0;
  for (const Index index : tile.cells) {
    if (keys.nodes().state(index) != BackwardNodes::OPEN) {
      --size_;
      continue;
    }
    const SearchKey key = keys.of(index);
    if (key < below) {
      cells_.push({key, keys.order(index), index});
      continue;
    }
    tile.cells[kept++] = index;
    tile.least_g = std::min(tile.least_g, keys.nodes().g(index));
    least = std::min(least, key);
  }
  tile.cells.resize(kept);
  if (kept > 0) pushTile(number, least);
}

}  // namespace grid_path_planner::planners
