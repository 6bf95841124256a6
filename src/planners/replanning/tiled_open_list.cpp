#include "planners/replanning/tiled_open_list.h"

#include <algorithm>

namespace grid_path_planner::planners {

using grid::CellRect;
using grid::GridGeometry;

namespace {

constexpr auto kLater = [](const TiledOpenList::Entry& a, const TiledOpenList::Entry& b) {
  return a.key != b.key ? a.key > b.key : a.order < b.order;
};

}  // namespace

void TiledOpenList::prepare(const GridGeometry& geometry) {
  const auto tiles = [](int cells) {
    return static_cast<std::uint32_t>((cells - 1) >> kSideBits) + 1;
  };
  across_ = tiles(geometry.width());
  tile_at_.assign(std::size_t{across_} * tiles(geometry.height()), Tile());
  used_.clear();
}

void TiledOpenList::begin(SearchKey first, SearchKey width) {
  for (const std::uint32_t place : used_) tile_at_[place] = Tile();
  used_.clear();
  reserved_ = 0;
  tiles_.begin(first, width);
  sorted_.clear();
  size_ = 0;
}

std::size_t TiledOpenList::bytes() const {
  return tile_at_.size() * sizeof(Tile) + used_.capacity() * sizeof(std::uint32_t) +
         reserved_ * sizeof(Index) + tiles_.bytes() + sorted_.capacity() * sizeof(Entry);
}

CellRect TiledOpenList::rectOf(std::uint32_t place) const {
  constexpr int kSide = 1 << kSideBits;
  return {static_cast<int>(place % across_) * kSide, static_cast<int>(place / across_) * kSide,
          kSide, kSide};
}

void TiledOpenList::push(const DStarKeys& keys, Index index) {
  ++size_;
  const std::uint32_t place = placeOf(keys.labels().cell(index));
  Tile& tile = tile_at_[place];
  const std::size_t reserved = tile.cells.capacity();
  if (reserved == 0) used_.push_back(place);
  tile.cells.push_back(index);
  reserved_ += tile.cells.capacity() - reserved;
  tile.least_label = std::min(tile.least_label, keys.labels().g(index));
  const SearchKey key = keys.of(index);
  if (key < tile.queued) queue(place, key);
}

void TiledOpenList::queue(std::uint32_t place, SearchKey key) {
  tile_at_[place].queued = key;
  tiles_.push({key, 0, place});
}

void TiledOpenList::sort(const Entry& entry) {
  sorted_.push_back(entry);
  std::push_heap(sorted_.begin(), sorted_.end(), kLater);
}

const TiledOpenList::Entry* TiledOpenList::first(SearchKey below, const DStarKeys& keys) {
  const auto renew = [&](HeapOnTopQueue::Entry& entry) {
    Tile& tile = tile_at_[entry.index];
    if (entry.key != tile.queued) return false;
    tile.queued = std::max(tile.queued, keys.leastOf(rectOf(entry.index), tile.least_label));
    entry.key = tile.queued;
    return true;
  };
  while (true) {
    const SearchKey nearer = sorted_.empty() ? below : std::min(below, sorted_.front().key);
    const HeapOnTopQueue::Entry* next = tiles_.first(nearer, renew);
    if (next == nullptr || next->key >= nearer) break;
    HeapOnTopQueue::Entry entry = tiles_.pop();
    const SearchKey old = entry.key;
    if (!renew(entry)) continue;
    if (entry.key > old)
      tiles_.push(entry);
    else
      open(entry.index, below, keys);
  }
  return sorted_.empty() || sorted_.front().key >= below ? nullptr : &sorted_.front();
}

TiledOpenList::Entry TiledOpenList::pop() {
  std::pop_heap(sorted_.begin(), sorted_.end(), kLater);
  const Entry entry = sorted_.back();
  sorted_.pop_back();
  --size_;
  return entry;
}

void TiledOpenList::open(std::uint32_t place, SearchKey below, const DStarKeys& keys) {
  Tile& tile = tile_at_[place];
  SearchKey least = kInfiniteKey;
  tile.least_label = tile.queued = kInfiniteKey;
  std::size_t kept = 0;
  for (const Index index : tile.cells) {
    if (keys.labels().state(index) != BackwardNodes::OPEN) {
      --size_;
      continue;
    }
    const SearchKey key = keys.of(index);
    if (key < below) {
      sort({key, keys.order(index), index});
      continue;
    }
    tile.cells[kept++] = index;
    tile.least_label = std::min(tile.least_label, keys.labels().g(index));
    least = std::min(least, key);
  }
  tile.cells.resize(kept);
  if (kept > 0) queue(place, least);
}

}  // namespace grid_path_planner::planners
