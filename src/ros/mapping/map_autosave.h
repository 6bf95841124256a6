// The file that a projected_map begins with when it was ended and started again: a node that is
// killed must not erase the world.
//
//   MapAutosave autosave(folder, private_nh.getNamespace(), options);
//   MapModel map(options, autosave.begin());   // the file of this run, if there is one
//   autosave.save(map, newest_cloud, MapAutosave::When::IF_DUE);  // in the mapping thread, as often as wanted
//
// The file is an octree (.ot) below the folder, whose first lines name the run (the roscore's
// /run_id; of a roscore that was restarted the new one), the frame, and the octree file that the node began
// with or, where there was none, the resolution that was asked for; one of other ones is
// not begun with. Its name (kept_file.h) holds the node's, the master's address and the run, so that no two nodes write the
// same one, and begins with a dot, so that no service can be asked to write it. A file that is gone is written again. The tree becomes text in the mapping thread, which takes
// at most a fifth of its processor time; it is written by a thread of its own, beside, synced and renamed. What
// cannot be written is warned of and tried again.
#pragma once

#include <ros/time.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/mapping/map_model.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/master/master_watch.h"
#include "ros/guard/scheduling/cpu_share.h"
#include "ros/mapping/kept_map.h"

namespace grid_path_planner::nodes {

class MapAutosave {
 public:
  // Asks the master for the run. `folder` need not exist; `node` is the node's full name. The options are
  // as the node's parameters say.
  MapAutosave(const std::string& folder, const std::string& node,
              const mapping::ProjectedMapOptions& options);

  // As the options there, from now on. Not while save() runs.
  void setOptions(const mapping::ProjectedMapOptions& options) { options_ = options; }

  // The file of this run, "" where there is none, and the newest cloud in it. Says what was found.
  std::string begin() const;
  ros::Time newestCloud() const;

  enum class When { IF_DUE, AT_ONCE };  // whatever share of the thread's time it takes
  // Has the map written, unless it is in the file already.
  void save(const mapping::MapModel& map, const ros::Time& newest_cloud, When when);
  // The file is gone when this returns, and what was still to be written is not written.
  void remove();

  // Thread-safe.
  struct State {
    double age = -1.0;       // s since the file was written; below 0: not yet
    double behind = 0.0;     // s since save() first saw what is not in the file
    ros::Time newest_cloud;  // in it, or in what could not be written
    std::string problem;     // why the last writing failed; empty: it did not
  };
  State state() const;

 private:
  using Clock = std::chrono::steady_clock;

  void followMaster();
  std::string marker() const;
  void noteUnsaved();
  std::optional<KeptMap> kept() const;
  std::string fileOf(const std::string& run) const;
  bool isInFile(const mapping::MapModel& map) const;
  void noteProblem(const std::string& problem);
  void write(const std::string& file, const std::string& text, const ros::Time& newest_cloud);

  const std::string folder_, node_;
  std::string run_;  // "": unknown, then nothing is written
  std::string no_run_ = "the master has no /run_id, as roscore sets it";  // why
  std::string file_;                                                      // its path, of the run
  std::string replaced_;  // of the run before, gone once file_ is written
  mapping::ProjectedMapOptions options_;
  const std::shared_ptr<MasterWatch> master_ = MasterWatch::shared();
  unsigned restarts_ = 0;  // of the master, before run_

  std::uint64_t saved_revision_ = 0;  // of the mapping thread, as the next
  CpuShare share_{0.2};

  mutable std::mutex mutex_;
  State state_;
  Clock::time_point written_;
  std::optional<Clock::time_point> unsaved_since_;
  base::TaskQueue writer_{[](const std::string& error) { tellGivenUp("Keeping the map", error); }};
};

}  // namespace grid_path_planner::nodes
