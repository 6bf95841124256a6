// The map of projected_map and the one thread in which it is read and changed: clouds, services,
// publications and changed parameters take turns there, so that none meets half of another's work.
//
//   MappingDesk desk(options);
//   desk.post("publish", [](MapKeeper& map) { use(map); });  // later, not twice in the queue
//   desk.ask([](MapKeeper& map) { map.reset(); });           // next, and waits for it
//
// Who asks waits for what runs at the moment (one insertion, one publication) and for who asked
// before, never for the clouds that wait.
#pragma once

#include <functional>
#include <string>

#include "grid_path_planner/ros/map_keeper.h"
#include "grid_path_planner/ros/plan_worker.h"

namespace grid_path_planner {

class MappingDesk {
 public:
  using Work = std::function<void(MapKeeper&)>;

  // Throws as MapKeeper does.
  explicit MappingDesk(const ProjectedMapOptions& options) : map_(options) {}

  // Does `work` next and waits for its end. Throws what it throws.
  void ask(const Work& work);

  // Does `work` after what waits already, unless more is posted to the same slot before: then that
  // instead. Not done after stop(). `work` throws nothing.
  void post(const std::string& slot, Work work);

  // Ends the thread; what is asked from now on is done at once, by who asks.
  void stop() { worker_.stop(); }

 private:
  MapKeeper map_;
  PlanWorker worker_;
};

}  // namespace grid_path_planner
