// The map of projected_map and the one thread in which it is read and changed: clouds, services,
// publications and changed parameters take turns there, so that none meets half of another's work.
//
//   MappingThread desk(options);
//   desk.post("publish", [](MapModel& map) { use(map); });  // later, not twice in the queue
//   desk.ask([](MapModel& map) { map.reset(); });           // next, and waits for it
//
// Who asks waits for what runs at the moment (one insertion, one publication) and for who asked
// before, never for the clouds that wait.
#pragma once

#include <functional>
#include <string>

#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/mapping/map_model.h"

namespace grid_path_planner::nodes {

class MappingThread {
 public:
  using Work = std::function<void(mapping::MapModel&)>;

  // Throws as MapModel does.
  explicit MappingThread(const mapping::ProjectedMapOptions& options) : map_(options) {}

  // Does `work` next and waits for its end. Throws what it throws.
  void ask(const Work& work);

  // Does `work` after what waits already, unless more is posted to the same slot before: then that
  // instead. Not done after stop(). `work` throws nothing.
  void post(const std::string& slot, Work work);

  // Ends the thread; what is asked from now on is done at once, by who asks.
  void stop() { worker_.stop(); }

 private:
  mapping::MapModel map_;
  base::TaskQueue worker_;
};

}  // namespace grid_path_planner::nodes
