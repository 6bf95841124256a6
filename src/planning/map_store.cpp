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
using costmap::CostmapOptions, costmap::KeptDistances;
using grid::CellRect, grid::DoubleBuffered, grid::OccupancyGrid;

namespace {

constexpr auto kNewerThanAll = std::numeric_limits<std::uint64_t>::max();  // of revisions

}  // namespace

MapSeries::MapSeries(std::shared_ptr<const OccupancyGrid> first, std::string frame_id)
    : geometry_(first->geometry()), frame_id_(std::move(frame_id)) {
  newest_.changes.restart(DoubleBuffered<OccupancyGrid>::nextSeries());
  newest_.map = std::move(first);
}

MapSeries::Newest MapSeries::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return newest_;
}

void MapSeries::update(std::shared_ptr<const OccupancyGrid> map, std::vector<CellRect> changed) {
  assert(map->geometry() == geometry_);
  const std::lock_guard<std::mutex> lock(mutex_);
  Newest next{std::move(map), newest_.changes};
  next.changes.add(std::move(changed));
  std::swap(newest_, next);  // all or nothing where memory is short
}

std::shared_ptr<SharedCostmap> MapSeries::costmap(const CostmapOptions& options,
                                                  const KeptDistances& kept) {
  const std::lock_guard<std::mutex> lock(mutex_);
  costmaps_.erase(std::remove_if(costmaps_.begin(), costmaps_.end(),
                                 [](const auto& each) { return each.expired(); }),
                  costmaps_.end());
  for (const std::weak_ptr<SharedCostmap>& each : costmaps_) {
    std::shared_ptr<SharedCostmap> known = each.lock();
    if (known && known->keptDistances() == kept && sameOptions(known->options(), options))
      return known;
  }
  auto made = std::make_shared<SharedCostmap>(shared_from_this(), options, kept);
  costmaps_.push_back(made);
  return made;
}

SharedCostmap::SharedCostmap(std::shared_ptr<const MapSeries> series, const CostmapOptions& options,
                             const KeptDistances& kept)
    : series_(std::move(series)), options_(options), kept_(kept), builder_(options, kept) {}

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
  const std::uint64_t wanted = std::min(at_least, series_->newest().changes.newest());
  const Turn turn(*this, wanted, stop);
  if (turn.made()) return *turn.made();
  try {
    return make(stop);
  } catch (const Stopped&) {
    throw;  // the next one goes on
  } catch (...) {
    revision_.reset();  // the costmaps may be half made
    throw;
  }
}

void SharedCostmap::makeReadyForChanges(const StopToken& stop) {
  const Turn turn(*this, kNewerThanAll, stop);
  builder_.makeReadyForChanges(stop);
}

// Precondition: mutex_ is held.
std::optional<SharedCostmap::Result> SharedCostmap::madeSince(std::uint64_t revision) const {
  return made_ && made_revision_ >= revision ? made_ : std::nullopt;
}

SharedCostmap::Result SharedCostmap::make(const StopToken& stop) {
  takeMap();
  auto downsampled = builder_.downsampled(stop);
  Result result{map_,
                {builder_.fullResolution(stop), std::move(downsampled),
                 builder_.fullResolutionChanges(), builder_.downsampledChanges()}};
  const std::lock_guard<std::mutex> lock(mutex_);
  made_ = result;
  made_revision_ = *revision_;
  return result;
}

void SharedCostmap::takeMap() {
  MapSeries::Newest newest = series_->newest();
  const std::uint64_t revision = newest.changes.newest();
  if (revision_ == revision) return;
  const auto known = std::exchange(revision_, std::nullopt);  // until the builder has the map
  map_ = std::move(newest.map);
  if (!known)
    builder_.setMap(map_);
  else if (const auto changed = newest.changes.since(*known))
    builder_.updateMap(map_, *changed);
  else
    builder_.updateMap(map_, {series_->geometry().rect()});
  revision_ = revision;
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
  return newest ? newest->newest().changes.newest() : 0;
}

std::shared_ptr<MapSeries> MapStore::series() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return series_;
}

}  // namespace grid_path_planner::planning
