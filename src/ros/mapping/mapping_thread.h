// The map of projected_map and the one thread in which it is read and changed: clouds, services,
// publications and changed parameters are tasks of this thread, so that each sees a consistent map.
//
//   MappingThread thread(options, "", stop);
//   thread.post("publish", [](MapModel& map) { use(map); });  // later, not twice in the queue
//   thread.run([](MapModel& map) { map.reset(); });           // next, and waits for it
//
// run() waits for the task that is running (one insertion, one publication) and for earlier calls of
// run(), never for the clouds in the queue.
#pragma once

#include <functional>
#include <string>

#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/mapping/map_model.h"
#include "ros/guard/guarded_queue.h"

namespace grid_path_planner::nodes {

class MappingThread {
 public:
  using Work = std::function<void(mapping::MapModel&)>;

  // Throws as MapModel does.
  MappingThread(const mapping::ProjectedMapOptions& options, const std::string& begin_with,
                const base::StopToken& stop)
      : map_(options, begin_with, stop) {}

  // Does `work` next and waits for its end. Rethrows its exceptions; throws InputError after stop().
  void run(const Work& work);

  // Does `work` after the tasks that wait already; work posted to the same slot before then replaces
  // it. Not done after stop(). An exception of `work` goes into the log.
  void post(const std::string& slot, Work work);

  // Ends the thread.
  void stop() { worker_.stop(); }

 private:
  mapping::MapModel map_;
  base::TaskQueue worker_{
      [](const std::string& error) { tellGivenUp("A task of the mapping", error); }};
};

}  // namespace grid_path_planner::nodes
