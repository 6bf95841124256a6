// The diagnostics of projected_map, once a second (~diagnostic_period): the clouds received and what
// became of them, and the size of the map.
//
//   clouds: received, inserted, waiting, dropped (each with its reason), last_insertion_s,
//           mean_insertion_s, last_insertion_age_s (below 0: none yet); a warning while clouds are dropped, and
//           where none was mapped for 5 s of the wall clock since the first
//   map:    nodes, bytes and projections (counted seldom where counting takes long), resolution,
//           left_out_m2: what the 2-D map does not hold of the tree, for projection_max_cells, with a
//           warning, as there is while projected_map cannot be made or sent, tree_messages: how often the 3-D topics were built
//
// autosave: age_s of the file that a node begins with when it starts again, below 0: none yet;
// behind_s: since when there is something that is not in it; newest_cloud: the stamp of the newest cloud in it; a warning
// where it cannot be written, and where it is behind by more than autosave_period, as on a machine that has too much to do.
//
// All received clouds are in the map when waiting is 0 and received is inserted + dropped.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <chrono>
#include <mutex>

#include "grid_path_planner/mapping/map_model.h"
#include "ros/input/input.h"
#include "ros/mapping/map_autosave.h"
#include "ros/mapping/mapping_publications.h"
#include "ros/mapping/mapping_thread.h"

namespace grid_path_planner::nodes {

class MappingDiagnostics {
 public:
  // All that is given by reference or pointer outlives this; `autosave` is null where there is none.
  MappingDiagnostics(ros::NodeHandle nh, ros::NodeHandle private_nh, const InputBase& clouds,
                     MappingThread& thread, MappingPublications& publications,
                     const MapAutosave* autosave, double autosave_period);

  // Records an insertion. Thread-safe.
  void recordInsertion(const mapping::MapModel::Inserted& inserted);

 private:
  using Clock = std::chrono::steady_clock;
  struct Figures {
    std::size_t nodes = 0;
    std::size_t bytes = 0;
    double resolution = 0.0;  // m
    std::uint64_t projections = 0;
    double area_left_out = 0.0;  // m^2
  };

  void onTimer();
  void measure(const mapping::MapModel& map);
  void reportClouds(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportMap(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportAutosave(diagnostic_updater::DiagnosticStatusWrapper& status);

  const InputBase& clouds_;
  MappingThread& thread_;
  MappingPublications& publications_;
  const MapAutosave* autosave_;
  const double autosave_period_;  // s
  std::mutex mutex_;
  Figures figures_;
  bool full_ = false;            // at the last insertion
  double last_insertion_ = 0.0;  // s
  double all_insertions_ = 0.0;  // s
  std::uint64_t insertions_ = 0;
  Clock::time_point inserted_;
  std::uint64_t reported_drops_ = 0;
  Clock::time_point measure_not_before_;  // used in the mapping thread
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;  // destroyed before what it calls
};

}  // namespace grid_path_planner::nodes
