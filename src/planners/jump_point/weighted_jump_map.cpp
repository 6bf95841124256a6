#include "planners/jump_point/weighted_jump_map.h"

#include <algorithm>

#include "planners/core/simd_neighbourhood.h"
#include "planners/core/steps.h"
#include "planners/jump_point/tile_stops.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken, base::ZeroedArray;
using costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

// Where more of a tile changed, it is given up: a repair takes longer a cell than a new tile, and a
// tile that no search comes to again costs nothing.
constexpr int kRepairedCells = WeightedJumpMap::kTile * WeightedJumpMap::kTile / 3;

void setBit(std::uint64_t& word, int at, bool value) {
  const std::uint64_t bit = std::uint64_t{1} << (unsigned(at) & 63U);
  word = value ? word | bit : word & ~bit;
}

std::size_t squaresAlong(int cells, int side) {
  return (std::size_t(cells) + std::size_t(side) - 1) / std::size_t(side);
}

// Calls use() for the squares of a raster that meet a rectangle inside the map, cut off at the map's
// border.
template <class Use>
void forSquares(int side, const CellRect& rect, const CellRect& map, const Use& use) {
  for (int row = rect.row / side * side; row < rect.row + rect.height; row += side)
    for (int column = rect.column / side * side; column < rect.column + rect.width; column += side)
      use(CellRect{column, row, side, side}.intersection(map));
}

bool weightChanges(const CostGrid& map, Cell from, Cell to) {
  return !map.geometry().contains(to) || map.weight(from) != map.weight(to);
}

template <class Use>
void forCells(const CellRect& rect, const Use& use) {
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      use(Cell{column, row});
}

}  // namespace

std::size_t WeightedJumpMap::bytesFor(const GridGeometry& geometry) {
  const auto width = std::size_t(geometry.width()), height = std::size_t(geometry.height());
  return StraightJumpTable::bytesFor(height, width) + StraightJumpTable::bytesFor(width, height) +
         geometry.size() * sizeof(Mark) +
         squaresAlong(geometry.width(), kBlock) * squaresAlong(geometry.height(), kBlock) * 2 +
         WindowCache::bytesFor(geometry.size());
}

void WeightedJumpMap::reset(const CostGrid& map) {
  const GridGeometry& geometry = map.geometry();
  width_ = geometry.width();
  tile_columns_ = squaresAlong(width_, kTile);
  tiles_ready_ = 0;
  tile_ready_.assign(tile_columns_ * squaresAlong(geometry.height(), kTile), 0);
  block_columns_ = squaresAlong(width_, kBlock);
  block_ready_.assign(block_columns_ * squaresAlong(geometry.height(), kBlock), 0);
  rows_.reset(std::size_t(geometry.height()), std::size_t(geometry.width()));
  columns_.reset(std::size_t(geometry.width()), std::size_t(geometry.height()));
  marks_ = ZeroedArray<Mark>();
  marks_ = ZeroedArray<Mark>(geometry.size());
  windows_ = WindowCache(geometry.size());
  id_of_natural_.clear();
  Window open;
  open.fill(1);
  natural_of_id_ = {naturalMoves(open), 0};  // kOpenId, kBlockedId
}

void WeightedJumpMap::makeReady(const CostGrid& map, Cell cell) {
  makeReady(map, CellRect{cell.column, cell.row, 1, 1});
}

void WeightedJumpMap::makeReady(const CostGrid& map, const CellRect& rect) {
  forSquares(kTile, rect, map.geometry().rect(), [&](const CellRect& tile) {
    if (tileReady({tile.column, tile.row}) == 0) makeTile(map, tile);
  });
}

void WeightedJumpMap::makeAllReady(const CostGrid& map, const StopToken& stop) {
  if (allReady()) return;
  StopPoll poll(stop, 1);
  forSquares(kTile, map.geometry().rect(), map.geometry().rect(), [&](const CellRect& tile) {
    poll();
    makeReady(map, tile);
  });
}

void WeightedJumpMap::update(const CostGrid& map, const std::vector<CellRect>& changed,
                             const StopToken& stop) {
  const CellRect all = map.geometry().rect();
  const auto windowsOf = [&all](const CellRect& rect) { return rect.grown(1).intersection(all); };
  const auto near = [&all](const CellRect& rect) {
    return rect.grown(kDepth + 2).intersection(all);
  };
  for (const CellRect& rect : changed)
    forSquares(kBlock, windowsOf(rect), all, [&](const CellRect& block) {
      blockReady({block.column, block.row}) = 0;
    });
  giveUpTiles(map, changed);
  StopPoll poll(stop, 1);
  for (const CellRect& rect : changed)
    forSquares(kTile, near(rect), all, [&](const CellRect& tile) {
      poll();
      if (tileReady({tile.column, tile.row}) != 0)
        repair(map, tile.intersection(near(rect)), windowsOf(rect));
    });
}

// Those of which the changes together reach much.
void WeightedJumpMap::giveUpTiles(const CostGrid& map, const std::vector<CellRect>& changed) {
  const CellRect all = map.geometry().rect();
  std::unordered_map<std::size_t, int> reached;  // cells of each tile
  for (const CellRect& rect : changed) {
    const CellRect near = rect.grown(kDepth + 2).intersection(all);
    forSquares(kTile, near, all, [&](const CellRect& tile) {
      if (tileReady({tile.column, tile.row}) == 0) return;
      const CellRect part = tile.intersection(near);
      int& cells = reached[map.geometry().index({tile.column, tile.row}).value()];
      cells += part.width * part.height;
      if (cells > kRepairedCells) giveUpTile(map, tile);
    });
  }
}

void WeightedJumpMap::giveUpTile(const CostGrid& map, const CellRect& tile) {
  tileReady({tile.column, tile.row}) = 0;
  --tiles_ready_;
  forCells(tile, [&](Cell cell) { marks_[map.geometry().index(cell).value()].setReady(false); });
  for (int row = tile.row; row < tile.row + tile.height; ++row) {
    rows_.word(std::size_t(row), unsigned(tile.column)) = {};
    rows_.setEndsBefore<true>(std::size_t(row), unsigned(tile.column), End::UNKNOWN);
    rows_.setEndsBefore<false>(std::size_t(row), unsigned(tile.column + kTile - 1), End::UNKNOWN);
  }
  for (int column = tile.column; column < tile.column + tile.width; ++column) {
    columns_.word(std::size_t(column), unsigned(tile.row)) = {};
    columns_.setEndsBefore<true>(std::size_t(column), unsigned(tile.row), End::UNKNOWN);
    columns_.setEndsBefore<false>(std::size_t(column), unsigned(tile.row + kTile - 1),
                                  End::UNKNOWN);
  }
}

void WeightedJumpMap::repair(const CostGrid& map, const CellRect& part, const CellRect& changed) {
  computeLiveSteps(map, part);
  forCells(part.intersection(changed), [&](Cell cell) {
    setOpen(cell, marks_[map.geometry().index(cell).value()].naturalId() == kOpenId);
    setBit(rows_.word(std::size_t(cell.row), unsigned(cell.column)).change, cell.column,
           weightChanges(map, cell, {cell.column + 1, cell.row}));
    setBit(columns_.word(std::size_t(cell.column), unsigned(cell.row)).change, cell.row,
           weightChanges(map, cell, {cell.column, cell.row + 1}));
  });
  forCells(part,
           [&](Cell cell) { setStops(cell, steps(map, map.geometry().index(cell).value())); });
}

unsigned WeightedJumpMap::idOf(NaturalMoves natural) {
  const auto found = id_of_natural_.find(natural);
  if (found != id_of_natural_.end()) return found->second;
  if (natural_of_id_.size() == kNoId) return kNoId;
  const auto id = static_cast<unsigned>(natural_of_id_.size());
  natural_of_id_.push_back(natural);
  id_of_natural_.emplace(natural, id);
  return id;
}

void WeightedJumpMap::computeNaturalIds(const CostGrid& map, const CellRect& rect) {
  forSquares(kBlock, rect, map.geometry().rect(), [&](const CellRect& block) {
    std::uint8_t& ready = blockReady({block.column, block.row});
    if (ready == 0) computeNaturalIdsOf(map, block);
    ready = 1;
  });
}

void WeightedJumpMap::computeNaturalIdsOf(const CostGrid& map, const CellRect& block) {
  using Eight = SimdNeighbourhood::Eight;
  forEachEight(map, block, StopToken(),
               [this](std::size_t index, int number, const SimdNeighbourhood& cells) {
                 const Eight blocked = cells.blocked(0, 0), alike = cells.alike();
                 if (all(blocked | alike)) {
                   for (int i = 0; i < number; ++i)
                     marks_[index + i].setNaturalId(blocked[i] != 0 ? kBlockedId : kOpenId);
                   return;
                 }
                 std::array<Eight, 9> around;
                 for (int i = 0; i < 9; ++i) around[i] = cells.weights(i % 3 - 1, i / 3 - 1);
                 for (int i = 0; i < number; ++i)
                   marks_[index + i].setNaturalId(blocked[i] != 0 ? kBlockedId
                                                  : alike[i] != 0 ? kOpenId
                                                                  : naturalIdOf(around, i));
               });
}

template <class Eights>
unsigned WeightedJumpMap::naturalIdOf(const Eights& around, int cell) {
  Window window;
  for (int i = 0; i < 9; ++i) window[i] = around[i][cell];
  return windows_.find(window, [this](const Window& fresh) { return idOf(naturalMoves(fresh)); });
}

void WeightedJumpMap::computeLiveSteps(const CostGrid& map, const CellRect& rect) {
  const GridGeometry& geometry = map.geometry();
  const CellRect window = rect.grown(kDepth + 1);
  const CellRect inside = window.intersection(geometry.rect());
  computeNaturalIds(map, inside);
  const int width = window.width + 2;
  branches_.reset(width, window.height + 2);
  for (int row = inside.row; row < inside.row + inside.height; ++row) {
    std::uint32_t index = geometry.index({inside.column, row}).value();
    std::uint32_t at = std::uint32_t(row - window.row + 1) * std::uint32_t(width) + 1 +
                       std::uint32_t(inside.column - window.column);
    for (int column = 0; column < inside.width; ++column, ++index, ++at)
      if (marks_[index].naturalId() != kBlockedId) branches_.set(at, natural(map, index));
  }
  const std::vector<std::uint8_t>& live = branches_.liveSteps(kDepth);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    const std::uint8_t* from = &live[std::size_t(row - window.row + 1) * width + 1 + kDepth + 1];
    std::uint32_t index = geometry.index({rect.column, row}).value();
    for (int column = 0; column < rect.width; ++column, ++index) marks_[index].live = from[column];
  }
}

void WeightedJumpMap::makeTile(const CostGrid& map, const CellRect& tile) {
  if (stop_ != nullptr) {
    if (tiles_left_-- == 0) throw TooManyTiles();
    const base::StopReason reason = stop_->reason();
    if (reason != base::StopReason::NONE) throw base::Stopped(reason);
  }
  computeLiveSteps(map, tile);
  TileStops stops;
  addStops(map, tile, stops);
  stops.finish();
  writeTile(map, tile, stops);
  tileReady({tile.column, tile.row}) = 1;
  ++tiles_ready_;
}

void WeightedJumpMap::addStops(const CostGrid& map, const CellRect& tile, TileStops& stops) {
  using Eight = SimdNeighbourhood::Eight;
  int at = 0;  // which eight cells of the tile
  const int in_row = (tile.width + kSimdCells - 1) / kSimdCells;
  forEachEight(
      map, tile, StopToken(), [&](std::size_t index, int number, const SimdNeighbourhood& cells) {
        const Eight here = cells.weights(0, 0);
        const auto along_row = reinterpret_cast<Eight>(here != cells.weights(1, 0));
        const auto along_column = reinterpret_cast<Eight>(here != cells.weights(0, 1));
        std::uint64_t changes = 0, stops_of_cells = 0;
        storeBytes((along_row & TileStops::kRowChange) | (along_column & TileStops::kColumnChange),
                   kSimdCells, reinterpret_cast<std::uint8_t*>(&changes));
        for (int i = 0; i < number; ++i) {
          Mark& mark = marks_[index + i];
          mark.setReady(true);
          const unsigned id = mark.naturalId();
          if (id == kOpenId) changes |= std::uint64_t{TileStops::kOpen} << (8 * i);
          if (id == kOpenId && mark.live == 255) continue;
          const std::uint8_t stop = id == kBlockedId
                                        ? TileStops::kBlocked
                                        : TileStops::stopsOf(steps(map, std::uint32_t(index + i)));
          stops_of_cells |= std::uint64_t{stop} << (8 * i);
        }
        stops.add(at / in_row, at % in_row, stops_of_cells, changes);
        ++at;
      });
}

void WeightedJumpMap::writeTile(const CostGrid& map, const CellRect& tile, const TileStops& stops) {
  for (int i = 0; i < tile.height; ++i) {
    StraightJumpTable::Word& word = rows_.word(std::size_t(tile.row + i), unsigned(tile.column));
    word.change = stops.rowChange()[i];
    word.open = stops.open()[i];
  }
  for (int i = 0; i < tile.width; ++i)
    columns_.word(std::size_t(tile.column + i), unsigned(tile.row)).change =
        stops.columnChange()[i];
  writeStopsOf<true>(map, tile, stops);
  writeStopsOf<false>(map, tile, stops);
}

template <bool kForward>
void WeightedJumpMap::writeStopsOf(const CostGrid& map, const CellRect& tile,
                                   const TileStops& stops) {
  constexpr unsigned kAlongRow = kForward ? 0 : 2, kAlongColumn = kForward ? 1 : 3;
  const Bits beyond_row = TileStops::beyond(tile.width),
             beyond_column = TileStops::beyond(tile.height);
  for (int i = 0; i < tile.height; ++i) {
    const Cell next{kForward ? tile.column + kTile : tile.column - 1, tile.row + i};
    StraightJumpTable::writeStops<kForward>(
        rows_.word(std::size_t(tile.row + i), unsigned(tile.column)),
        stops.stop(kAlongRow)[i] | beyond_row, stops.dead(kAlongRow)[i] | beyond_row,
        endAt<kAlongRow>(map, next));
  }
  for (int i = 0; i < tile.width; ++i) {
    const Cell next{tile.column + i, kForward ? tile.row + kTile : tile.row - 1};
    StraightJumpTable::writeStops<kForward>(
        columns_.word(std::size_t(tile.column + i), unsigned(tile.row)),
        stops.stop(kAlongColumn)[i] | beyond_column, stops.dead(kAlongColumn)[i] | beyond_column,
        endAt<kAlongColumn>(map, next));
  }
}

// What a jump by the step that comes to this cell ends at.
template <unsigned kStep>
WeightedJumpMap::End WeightedJumpMap::endAt(const CostGrid& map, Cell cell) {
  constexpr bool kForward = kStep / 2 == 0;
  if (!map.geometry().contains(cell)) return End::DEAD;
  if (tileReady(cell) == 0) return End::UNKNOWN;
  const bool stop = kStep % 2 == 0
                        ? rows_.isStop<kForward>(std::size_t(cell.row), unsigned(cell.column))
                        : columns_.isStop<kForward>(std::size_t(cell.column), unsigned(cell.row));
  if (!stop) return endOf<kStep>(cell);
  const NaturalMoves steps = this->steps(map, map.geometry().index(cell).value());
  return cell != goal_ && (steps >> (8 * kStep) & 255U) == 0 ? End::DEAD : End::LIVE;
}

template <unsigned kStep>
bool WeightedJumpMap::findEnd(const CostGrid& map, Cell cell) {
  constexpr bool kForward = kStep / 2 == 0;
  const int at = kStep % 2 == 0 ? cell.column : cell.row;
  int next = kForward ? at / kTile * kTile + kTile : at / kTile * kTile - 1;
  for (End end = End::UNKNOWN;; next += kForward ? kTile : -kTile) {
    const Cell to = kStep % 2 == 0 ? Cell{next, cell.row} : Cell{cell.column, next};
    makeReady(map, to);
    end = endAt<kStep>(map, to);
    if (end == End::UNKNOWN) continue;
    if (kStep % 2 == 0)
      rows_.setEndsBefore<kForward>(std::size_t(cell.row), unsigned(next), end);
    else
      columns_.setEndsBefore<kForward>(std::size_t(cell.column), unsigned(next), end);
    return end == End::DEAD;
  }
}

template bool WeightedJumpMap::findEnd<0>(const CostGrid&, Cell);
template bool WeightedJumpMap::findEnd<1>(const CostGrid&, Cell);
template bool WeightedJumpMap::findEnd<2>(const CostGrid&, Cell);
template bool WeightedJumpMap::findEnd<3>(const CostGrid&, Cell);

template <bool kForward>
void WeightedJumpMap::setStopsOf(Cell cell, NaturalMoves steps) {
  const unsigned along_row = kForward ? 0 : 2, along_column = kForward ? 1 : 3;
  const unsigned in_row = steps >> (8 * along_row) & 255U;
  const unsigned in_column = steps >> (8 * along_column) & 255U;
  rows_.setStop<kForward>(std::size_t(cell.row), unsigned(cell.column), in_row != 1U << along_row,
                          in_row == 0);
  columns_.setStop<kForward>(std::size_t(cell.column), unsigned(cell.row),
                             in_column != 1U << along_column, in_column == 0);
}

void WeightedJumpMap::setStops(Cell cell, NaturalMoves steps) {
  setStopsOf<true>(cell, steps);
  setStopsOf<false>(cell, steps);
}

void WeightedJumpMap::setOpen(Cell cell, bool open) {
  setBit(rows_.word(std::size_t(cell.row), unsigned(cell.column)).open, cell.column, open);
}

}  // namespace grid_path_planner::planners
