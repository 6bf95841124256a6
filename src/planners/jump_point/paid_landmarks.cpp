#include "planners/jump_point/paid_landmarks.h"

#include <algorithm>
#include <utility>

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::CostGrid;
using grid::CellRect, grid::GridGeometry;

namespace {

// Of the tables, however much memory there is: 16 landmarks at 1448x1448 cells.
constexpr std::size_t kMostBytes = std::size_t{128} << 20;
// Fewer say too little to pay for themselves.
constexpr int kFewest = LandmarkTable::kLanes;
// Each is chosen by one search of the whole map and known by another.
constexpr std::size_t kSearchesEach = 2;
constexpr std::size_t kLeastShare = 8;

}  // namespace

void PaidLandmarks::release() {
  tables_.reset();
  paid_ = passable_ = 0;
}

std::size_t PaidLandmarks::bytes() const {
  if (!tables_) return 0;
  return tables_->work().pending ? LandmarkTable::makingBytesFor(geometry_, count_)
                                 : tables_->work().bytes;
}

// As many as memory holds; 0 where that is too few.
int PaidLandmarks::affordable(const GridGeometry& geometry, std::size_t room) const {
  int count = most_;
  const auto fits = [&] {
    return LandmarkTable::bytesFor(geometry, count) <= kMostBytes &&
           LandmarkTable::makingBytesFor(geometry, count) <= room;
  };
  while (count >= kFewest && !fits())
    count = (count - 1) / LandmarkTable::kLanes * LandmarkTable::kLanes;
  return count >= std::min(kFewest, most_) && fits() ? count : 0;
}

// Tables that are worn when they are made, or of which nothing came, are paid for again.
bool PaidLandmarks::wanted(const CostGrid& map, std::size_t room) {
  if (tables_) {
    if (tables_->work().pending) return true;
    if (tables_->made() && !tables_->worn()) return false;
    release();
  }
  const int count = affordable(map.geometry(), room);
  return count > 0 && paidFor(map, count);
}

// Cells are counted once enough is paid for a map of which few are passable.
bool PaidLandmarks::paidFor(const CostGrid& map, int count) {
  const std::size_t searches = kSearchesEach * static_cast<std::size_t>(count);
  const auto& weights = map.weights().values();
  if (paid_ < searches * weights.size() / kLeastShare) return false;
  if (passable_ == 0)
    passable_ = weights.size() - static_cast<std::size_t>(std::count(weights.begin(), weights.end(),
                                                                     CostGrid::kBlocked));
  return paid_ >= searches * passable_;
}

void PaidLandmarks::make(std::shared_ptr<const CostGrid> map, std::size_t room,
                         const StopToken& stop) {
  if (!wanted(*map, room)) return;
  if (!tables_) {
    geometry_ = map->geometry();
    count_ = affordable(geometry_, room);
    tables_ = std::make_unique<PrecomputedTable<LandmarkTable>>(
        [count = count_](const CostGrid& costs, const StopToken& end) {
          return LandmarkTable(costs, count, end);
        });
    tables_->prepare(std::move(map));
    paid_ = 0;
  }
  tables_->wait(stop);
}

void PaidLandmarks::update(const CostGrid& before, std::shared_ptr<const CostGrid> map,
                           const std::vector<CellRect>& changed) {
  if (!tables_) return;
  tables_->follow(before, *map, changed);
  if (tables_->worn()) release();
}

std::optional<LandmarkBound> PaidLandmarks::boundTo(std::uint32_t goal, const KeyScale& scale) {
  const LandmarkTable* table = tables_ ? tables_->ready() : nullptr;
  if (!table || table->landmarks().empty()) return std::nullopt;
  return LandmarkBound(*table, tables_->decreases(), goal, scale);
}

}  // namespace grid_path_planner::planners
