// The map that several planners search, and its costmaps, each made once: by whoever needs it first.
//
//   auto store = std::make_shared<MapStore>();
//   PathPlanner a(store, options), b(store, options);  // each in a thread of its own
//   store->setMap(map, "map");                         // in any thread
//   store->updateMap(next, changed);
//   a.takeMap();                                       // whoever plans takes the newest map
//
// setMap() and updateMap() wait for nobody. Whoever asks for a costmap waits while another makes the
// same one, and never while another plans: what is handed out does not change. Whoever comes seldom
// gets the newest map, and what changed since the one before in one list. Whoever has waited is
// content with the map that was the newest when he came: so maps that come faster than costmaps are
// made hold nobody up.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/committed.h"
#include "base/rebuildable.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/grid/double_buffered.h"
#include "planning/multi_resolution_planner.h"

namespace grid_path_planner::planning {

class SharedCostmap;

// Maps of one geometry in one frame, each of which follows from the one before by a change.
class MapSeries : public std::enable_shared_from_this<MapSeries> {
 public:
  // A map and what changed up to it.
  struct Newest {
    std::shared_ptr<const grid::OccupancyGrid> map;
    grid::ChangeLog<> changes;
  };

  MapSeries(std::shared_ptr<const grid::OccupancyGrid> first, std::string frame_id);

  const grid::GridGeometry& geometry() const { return geometry_; }
  const std::string& frameId() const { return frame_id_; }
  std::shared_ptr<const Newest> newest() const { return newest_.get(); }
  void update(std::shared_ptr<const grid::OccupancyGrid> map, std::vector<grid::CellRect> changed);

  // That of these options, which lives as long as somebody holds it.
  std::shared_ptr<SharedCostmap> costmap(const costmap::CostmapOptions& options);

 private:
  const grid::GridGeometry geometry_;
  const std::string frame_id_;
  base::Committed<Newest> newest_;
  std::mutex mutex_;  // of what follows
  std::vector<std::weak_ptr<SharedCostmap>> costmaps_;
};

// The costmaps of a series by options, for any thread.
class SharedCostmap {
 public:
  struct Result {
    std::shared_ptr<const grid::OccupancyGrid> map;
    CostmapPair costs;
  };

  SharedCostmap(std::shared_ptr<const MapSeries> series, const costmap::CostmapOptions& options);

  const costmap::CostmapOptions& options() const { return options_; }

  // Of the newest map, or of an earlier one of at least this revision where these are there. Throws
  // Stopped, also while another thread makes them.
  Result newest(const base::StopToken& stop,
                std::uint64_t at_least = std::numeric_limits<std::uint64_t>::max());

  // CostmapBuilder's, of what was made last. Throws Stopped.
  void makeReadyForChanges(const base::StopToken& stop);

 private:
  class Turn;
  // The costmaps of a map, of which it is known which it is.
  struct Making {
    costmap::CostmapBuilder builder;
    std::shared_ptr<const grid::OccupancyGrid> map;
    std::uint64_t revision = 0;  // of the map
  };

  std::optional<Result> madeSince(std::uint64_t revision) const;
  void takeMap(Making& making) const;
  Result make(Making& making, const base::StopToken& stop);

  const std::shared_ptr<const MapSeries> series_;
  const costmap::CostmapOptions options_;
  // Of the thread whose turn it is to make. What is stopped goes on.
  base::Rebuildable<Making, base::Stopped> making_maps_;
  mutable std::mutex mutex_;  // of what follows, held for no longer than it takes to read and write
  std::condition_variable ended_;  // a turn has
  bool making_ = false;
  std::optional<Result> made_;
  std::uint64_t made_revision_ = 0;  // of its map
};

class MapStore {
 public:
  // The map has a geometry, a frame or cells of its own: nothing is known of what changed.
  void setMap(std::shared_ptr<const grid::OccupancyGrid> map, const std::string& frame_id);
  // `map` has the geometry of the newest one and differs from it only inside `changed`.
  void updateMap(std::shared_ptr<const grid::OccupancyGrid> map,
                 const std::vector<grid::CellRect>& changed);
  // Null before the first map.
  std::shared_ptr<MapSeries> series() const;
  // Of the newest map; 0 before the first.
  std::uint64_t revision() const;

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<MapSeries> series_;
};

}  // namespace grid_path_planner::planning
