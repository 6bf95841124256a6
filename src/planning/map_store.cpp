#include "planning/map_store.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <limits>
#include <utility>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::planning {

using base::sameOptions, base::Stopped, base::StopReason, base::StopToken;
using costmap::checkCostmapOptions, costmap::CostmapBuilder, costmap::CostmapOptions;
using grid::CellRect, grid::DoubleBuffered, grid::OccupancyGrid;

namespace {

constexpr auto kNewerThanAll = std::numeric_limits<std::uint64_t>::max();  // of revisions

MapSeries::Newest begun(std::shared_ptr<const OccupancyGrid> first) {
  MapSeries::Newest newest;
  newest.map = std::move(first);
  newest.changes.restart(DoubleBuffered<OccupancyGrid>::nextSeries());
  return newest;
}

}  // namespace

MapSeries::MapSeries(std::shared_ptr<const OccupancyGrid> first, std::string frame_id)
    : geometry_(first->geometry()),
      frame_id_(std::move(frame_id)),
      newest_(begun(std::move(first))) {}

void MapSeries::update(std::shared_ptr<const OccupancyGrid> map, std::vector<CellRect> changed) {
  assert(map->geometry() == geometry_);
  newest_.change([&](Newest& next) {
    next.map = std::move(map);
    next.changes.add(std::move(changed));
  });
}

std::shared_ptr<SharedCostmap> MapSeries::costmap(const CostmapOptions& options) {
  const std::lock_guard<std::mutex> lock(mutex_);
  costmaps_.erase(std::remove_if(costmaps_.begin(), costmaps_.end(),
                                 [](const auto& each) { return each.expired(); }),
                  costmaps_.end());
  for (const std::weak_ptr<SharedCostmap>& each : costmaps_) {
    std::shared_ptr<SharedCostmap> known = each.lock();
    if (known && sameOptions(known->options(), options)) return known;
  }
  auto made = std::make_shared<SharedCostmap>(shared_from_this(), options);
  costmaps_.push_back(made);
  return made;
}

SharedCostmap::SharedCostmap(std::shared_ptr<const MapSeries> series, const CostmapOptions& options)
    : series_(std::move(series)), options_(options), making_maps_([this] {
        return Making{CostmapBuilder(options_), nullptr, 0};
      }) {
  checkCostmapOptions(options);
}

// To make the costmaps, which one thread does at a time.
class SharedCostmap::Turn {
 public:
  // Waits until no other thread makes them, or one has made them since `revision`. A condition, as the
  // thread sanitizer does not know the waiting of a timed mutex.
  Turn(SharedCostmap& costmap, std::uint64_t revision, const StopToken& stop) : costmap_(costmap) {
    std::unique_lock<std::mutex> lock(costmap_.mutex_);
    while (costmap_.making_ && !costmap_.madeSince(revision)) {
      costmap_.ended_.wait_for(lock, std::chrono::milliseconds(5));
      const StopReason reason = stop.reason();
      if (costmap_.making_ && reason != StopReason::NONE) throw Stopped(reason);
    }
    made_ = costmap_.madeSince(revision);
    if (!made_) costmap_.making_ = true;
  }
  ~Turn() {
    if (made_) return;
    const std::lock_guard<std::mutex> lock(costmap_.mutex_);
    costmap_.making_ = false;
    costmap_.ended_.notify_all();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  // By another thread: nothing is left to make.
  const std::optional<Result>& made() const { return made_; }

 private:
  SharedCostmap& costmap_;
  std::optional<Result> made_;
};

SharedCostmap::Result SharedCostmap::newest(const StopToken& stop, std::uint64_t at_least) {
  const std::uint64_t wanted = std::min(at_least, series_->newest()->changes.newest());
  const Turn turn(*this, wanted, stop);
  if (turn.made()) return *turn.made();
  return making_maps_.change([&](Making& making) { return make(making, stop); });
}

void SharedCostmap::makeReadyForChanges(const StopToken& stop) {
  const Turn turn(*this, kNewerThanAll, stop);
  if (Making* making = making_maps_.get()) making->builder.makeReadyForChanges(stop);
}

// Precondition: mutex_ is held.
std::optional<SharedCostmap::Result> SharedCostmap::madeSince(std::uint64_t revision) const {
  return made_ && made_revision_ >= revision ? made_ : std::nullopt;
}

SharedCostmap::Result SharedCostmap::make(Making& making, const StopToken& stop) {
  takeMap(making);
  CostmapBuilder& builder = making.builder;
  auto downsampled = builder.downsampled(stop);
  Result result{making.map,
                {builder.fullResolution(stop), std::move(downsampled),
                 builder.fullResolutionChanges(), builder.downsampledChanges()}};
  const std::lock_guard<std::mutex> lock(mutex_);
  made_ = result;
  made_revision_ = making.revision;
  return result;
}

void SharedCostmap::takeMap(Making& making) const {
  const std::shared_ptr<const MapSeries::Newest> newest = series_->newest();
  const std::uint64_t revision = newest->changes.newest();
  if (making.map && making.revision == revision) return;
  if (!making.map)
    making.builder.setMap(newest->map);
  else if (const auto changed = newest->changes.since(making.revision))
    making.builder.updateMap(newest->map, *changed);
  else
    making.builder.updateMap(newest->map, {series_->geometry().rect()});
  making.map = newest->map;
  making.revision = revision;
}

void MapStore::setMap(std::shared_ptr<const OccupancyGrid> map, const std::string& frame_id) {
  auto series = std::make_shared<MapSeries>(std::move(map), frame_id);
  const std::lock_guard<std::mutex> lock(mutex_);
  series_.swap(series);
}

void MapStore::updateMap(std::shared_ptr<const OccupancyGrid> map,
                         const std::vector<CellRect>& changed) {
  series()->update(std::move(map), changed);
}

std::uint64_t MapStore::revision() const {
  const std::shared_ptr<MapSeries> newest = series();
  return newest ? newest->newest()->changes.newest() : 0;
}

std::shared_ptr<MapSeries> MapStore::series() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return series_;
}

}  // namespace grid_path_planner::planning
