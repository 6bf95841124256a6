// Plans a path between two poses on an occupancy map: costmap, end cells, search, path.
//
//   PathPlanner planner(options);
//   planner.setMap(std::make_shared<const OccupancyGrid>(readMapFile("site.yaml")));
//   Plan plan = planner.plan({start, goal}, StopSource());
//
// The path starts and ends at the requested poses. Whether these are passable is decided on the
// inflated map at full resolution; where only the block of the kernel around one is blocked, the
// search runs at full resolution until it reaches an open block. No call changes the caller's map.
//
// No point of the path is nearer to an occupied cell than `radius`, nor to unknown cells and the
// map's border than radius_to_unknown and outside ask, for every planner, kernel and smoothing;
// except on the first segment of a start that is itself nearer, with cut_corners, and with the rule
// filter2d. A goal that is nearer to any of these is GOAL_OCCUPIED.
// With a footprint (a vehicle that is not round) radius is at least its inscribed radius, and the footprint
// meets no obstacle anywhere on the path: planning/footprint/fitted_plan.h says what is tried, and what is not.
// What a planner prepared of the map is kept for each planner and options that were asked for, as
// far as the memory limit goes, so that a question to another one in between costs nothing later.
// Not thread-safe: one call at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/costmap_options.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/path.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planners/search_options.h"
#include "grid_path_planner/planning/plan.h"

namespace grid_path_planner::vehicle {
class Footprint;
}

namespace grid_path_planner::grid {
class ThresholdFit;
}

namespace grid_path_planner::planning {

class MapSeries;
class MapStore;
class MultiResolutionPlanner;
class SharedCostmap;
struct CostmapPair;

struct PlannerOptions {
  costmap::CostmapOptions costmap;
  std::string planner = "weighted_jump_point";
  planners::SearchOptions search;
  double tolerance = 0.0;            // m
  double start_escape_radius = 0.0;  // m
  std::string footprint;             // "[[x, y], ...]", m; "": round, of costmap.radius
  double min_turning_radius = 0.0;   // m; 0: turns on the spot
  bool keep_sharp_corners = false;
  bool retry_finer = true;
  bool smooth = true;
  double timeout = 5.0;  // s; 0: none
  path::HeadingMode heading = path::HeadingMode::FORWARD;
  path::PathZ path_z = path::PathZ::INTERPOLATE;
  double fixed_z = 0.0;             // m
  double waypoint_tolerance = 0.0;  // m
  double waypoint_spacing = 0.0;    // m; 0: as few as the tolerance allows
};

// A group of the options, in the order of visitOptions.
template <class Visitor>
void visitShapeOptions(PlannerOptions& o, Visitor&& visit) {
  visit("footprint", o.footprint,
        base::OptionInfo{
            "Corners of a vehicle that is not round, [[x, y], [x, y], [x, y], ...] in base_link "
            "about "
            "the origin: no path on which it meets an obstacle, turns on the spot included; radius "
            "counts where it is above the inscribed one; empty: round, of radius",
            "m"}
            .under("The vehicle's shape"));
  visit(
      "min_turning_radius", o.min_turning_radius,
      base::OptionInfo{
          "Smallest radius that the vehicle can turn with while it drives: corners become curves "
          "of at "
          "least that, from the start's heading to the goal's; needs heading forward, backward or "
          "none; 0: it turns on the spot",
          "m", 0, 1000});
  visit("keep_sharp_corners", o.keep_sharp_corners,
        base::OptionInfo{
            "Whether a path is given though at some corners no such curve fits, which the message "
            "counts; false: UNREACHABLE",
            ""});
}

template <class Visitor>
void visitOptions(PlannerOptions& o, Visitor&& visit) {
  visit("planner", o.planner,
        base::OptionInfo{"Name of the algorithm", ""}
            .under("The search")
            .oneOf(planners::plannerNames));
  visitOptions(o.search, visit);
  visitOptions(o.costmap, visit);
  visitShapeOptions(o, visit);
  visit("tolerance", o.tolerance,
        base::OptionInfo{
            "How far from an occupied or unreachable goal a path may end; 0: no path then", "m", 0,
            10000}
            .under("What is asked for"));
  visit("start_escape_radius", o.start_escape_radius,
        base::OptionInfo{
            "How far the nearest passable cell may be from a start that is occupied or too near to "
            "something, on a straight line that comes no nearer than the start is; from inside "
            "occupied cells it leads out by their nearest edge; 0: no path then",
            "m", 0, 10000});
  visit("retry_finer", o.retry_finer,
        base::OptionInfo{
            "Whether the search is repeated at kernel 1 where the kernel closes every path; "
            "false: UNREACHABLE",
            ""});
  visit("smooth", o.smooth,
        base::OptionInfo{
            "Whether a path over the grid is straightened where that is legal and costs "
            "nothing; false: it follows the grid's eight directions; without effect with "
            "connectivity 4 and diagonal_cost unit",
            ""});
  visit("timeout", o.timeout, base::OptionInfo{"Limit of one planning; 0: none", "s", 0, 86400});
  visit("heading", o.heading, base::OptionInfo{"Where the vehicle looks along the path", ""});
  visit("path_z", o.path_z, base::OptionInfo{"Where the z of the path comes from", ""});
  visit("fixed_z", o.fixed_z, base::OptionInfo{"z of the path with path_z fixed", "m", -1e6, 1e6});
  visit("waypoint_tolerance", o.waypoint_tolerance,
        base::OptionInfo{"How far the line through a waypoint file's poses may be from the path, "
                         "where the file has fewer poses for it and the line keeps radius; 0: it "
                         "has every corner",
                         "m", 0, 100});
  visit("waypoint_spacing", o.waypoint_spacing,
        base::OptionInfo{
            "Distance between a waypoint file's poses at most, in equal parts between corners; 0: "
            "no poses between corners",
            "m", 0, 10000});
}

// Throws InputError naming the option for a value outside its limits, for an unknown planner and for
// combinations that contradict each other.
void checkPlannerOptions(const PlannerOptions& options);

// Both in the map's frame.
struct PoseRequest {
  path::Pose start;
  path::Pose goal;
  bool record_expanded = false;
  bool any_goal_heading = false;  // the goal is passed: a footprint is not turned to its yaw there
};

class PathPlanner {
 public:
  // Throws InputError for options that cannot be used.
  explicit PathPlanner(const PlannerOptions& options = {},
                       planners::PlannerMaker make_planner = planners::makePlanner);
  // Of a map that others plan on too, each in a thread of its own: they share its costmaps.
  explicit PathPlanner(std::shared_ptr<MapStore> store, const PlannerOptions& options = {},
                       planners::PlannerMaker make_planner = planners::makePlanner);
  ~PathPlanner();
  PathPlanner(PathPlanner&&) noexcept;
  PathPlanner& operator=(PathPlanner&&) noexcept;

  // Throws InputError where they cannot be used. Whatever it throws, the old options stay.
  void setOptions(const PlannerOptions& options);
  const PlannerOptions& options() const { return options_; }

  // Throws InputError for a map without cells or with values outside -1..100 and keeps the old map.
  void setMap(std::shared_ptr<const grid::OccupancyGrid> map);
  // `map` has the geometry of the present one and differs from it only inside `changed`. Takes time
  // in proportion to `changed`, as does the update of the costmaps by the next call.
  void updateMap(std::shared_ptr<const grid::OccupancyGrid> map,
                 const std::vector<grid::CellRect>& changed);
  // Takes the newest map that was set here or in the shared store; the calls that follow may take
  // later ones of the same geometry and frame by themselves, and no others. `at_least`: an earlier map
  // of that revision (MapStore) or a higher one will do where its costmaps are there. Throws
  // InputError for a map without cells. Whatever it throws, the old map stays.
  void takeMap(std::uint64_t at_least = std::numeric_limits<std::uint64_t>::max());
  bool hasMap() const { return map_ != nullptr; }
  // That of the last call.
  const std::shared_ptr<const grid::OccupancyGrid>& map() const { return map_; }
  // As it was given with the map; empty before the first. Precondition: the map is of a shared store.
  const std::string& frameId() const;

  // What planning may take where that is less than options().search.memory_limit: the maps (as many
  // as grid/double_buffered.h keeps), the costmaps and the planner.
  void limitMemory(std::size_t bytes) { memory_limit_ = bytes; }
  // What it takes for the present map; 0 without one.
  std::size_t bytes() const;
  // The part of it that nobody shares.
  std::size_t bytesOfSearches() const;

  // The costmaps that plan() works on, made if the map or the options changed. Throw Stopped, and
  // InputError where they would take more than the limit.
  // Precondition: hasMap().
  std::shared_ptr<const costmap::CostGrid> fullResolutionCosts(
      const base::StopToken& stop);  // kernel 1, inflated
  std::shared_ptr<const costmap::CostGrid> downsampledCosts(
      const base::StopToken& stop);  // options().costmap.kernel
  // What changed in the downsampled costmap, up to the one that was made last.
  const costmap::CostChanges& downsampledChanges() const { return downsampled_changes_; }

  // What plan() would do first: the costmaps, and what the planner cannot do without. Throws Stopped,
  // and InputError where the costmaps would take more than the limit. Precondition: hasMap().
  void prepare(const base::StopToken& stop);
  // The same, and everything else that searches use, without which the first plans take longer;
  // waits for the planner's background work. Throws Stopped too; what is done stays.
  void finishPreparation(const base::StopToken& stop);

  // Does now what would keep the first plan after the first change of the map: copies the costmaps that
  // were made, since they will change while others still read them. Throws Stopped; a copy that is not
  // finished is not kept.
  void makeReadyForChanges(const base::StopToken& stop);

  // Where the footprint of the options meets an obstacle on a path with headings as they say, in words: "the
  // footprint meets the occupied cell at ..."; "" where nowhere, and for a round vehicle. The vehicle first turns
  // from `start_yaw`, where it is given. Throws as fullResolutionCosts() does. Precondition: hasMap().
  std::string footprintContact(const path::Path& path, std::optional<double> start_yaw,
                               const base::StopToken& stop);
  // options(), with the radius that is searched for: no less than the footprint's inscribed one.
  const PlannerOptions& searchedOptions() const { return searched_; }

  // Every failure but a bug is a status; options().timeout runs beside the token's own limit. Where the thresholds do not
  // fit the map, the message says so.
  Plan plan(const PoseRequest& request, const base::StopSource& stop = {});

 private:
  struct Searches;

  // Takes the costmap of the series and the options; what was searched is of another one. Changes nothing
  // where it throws.
  void searchOn(std::shared_ptr<MapSeries> series, const PlannerOptions& options);
  std::size_t memoryLimit() const;
  // Of the maps and costmaps.
  std::size_t buffers() const;
  std::size_t bytesOfMaps() const;
  std::size_t bytesOfCosts() const;
  // Of costmaps and searches; throws InputError where `taken` leaves none for the costmaps.
  std::size_t memoryLeft(std::size_t taken) const;
  // The costmaps, brought up to date.
  CostmapPair costmaps(const base::StopToken& stop);
  // The same, after the planner was updated to them where that is cheap.
  CostmapPair followedCostmaps(const base::StopToken& stop);
  // Gives up searches that were asked for long ago, where the one to be prepared needs their memory.
  void makeRoom(const CostmapPair& maps);
  // What work() gives, which uses search(). What an error leaves half prepared is prepared anew next time.
  template <class Work>
  decltype(auto) withSearches(Work&& work);
  MultiResolutionPlanner& search() const;
  Plan planNow(const PoseRequest& request, const base::StopToken& stop);
  Plan planFor(const PoseRequest& request, const costmap::CostGrid& costs,
               const base::StopToken& stop);

  planners::PlannerMaker make_planner_;
  std::size_t memory_limit_ = std::numeric_limits<std::size_t>::max();
  PlannerOptions options_;
  PlannerOptions searched_;
  std::unique_ptr<const vehicle::Footprint> footprint_;  // null: round
  bool shared_;                                          // whether others use the store
  std::shared_ptr<MapStore> store_;
  std::shared_ptr<MapSeries> series_;  // null before takeMap()
  std::shared_ptr<const grid::OccupancyGrid> map_;
  std::shared_ptr<SharedCostmap> costmap_;  // of series_ and the options; null before takeMap()
  std::uint64_t at_least_ = std::numeric_limits<std::uint64_t>::max();  // as takeMap() was told
  costmap::CostChanges downsampled_changes_;
  std::unique_ptr<grid::ThresholdFit> threshold_fit_;  // null before the first plan
  std::unique_ptr<Searches> searches_;                 // of these costmaps
};

}  // namespace grid_path_planner::planning
