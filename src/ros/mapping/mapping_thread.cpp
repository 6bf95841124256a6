#include "ros/mapping/mapping_thread.h"

#include <exception>
#include <utility>

namespace grid_path_planner::nodes {

using base::StopSource;
using base::TaskQueue;

void MappingThread::run(const Work& work) {
  std::exception_ptr thrown;
  const auto task = worker_.post(
      [&](const StopSource&) {
        try {
          work(map_);
        } catch (...) {
          thrown = std::current_exception();
        }
      },
      "", TaskQueue::Turn::NEXT);
  task->wait();
  if (thrown) std::rethrow_exception(thrown);
}

void MappingThread::post(const std::string& slot, Work work) {
  worker_.post(
      [this, work = std::move(work)](const StopSource& stop) {
        if (!stop.cancelled()) work(map_);
      },
      slot);
}

}  // namespace grid_path_planner::nodes
