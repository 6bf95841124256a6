#include "ros/mapping/mapping_thread.h"

#include <chrono>
#include <future>
#include <utility>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::StopSource;
using base::TaskQueue;

void MappingThread::run(const Work& work) {
  std::packaged_task<void()> task([&] { work(map_); });
  std::future<void> result = task.get_future();
  worker_.post([&](const StopSource&) { task(); }, "", TaskQueue::Turn::NEXT)->wait();
  if (result.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    throw InputError("the mapping ends and does nothing more");
  result.get();
}

void MappingThread::post(const std::string& slot, Work work) {
  worker_.post(
      [this, work = std::move(work)](const StopSource& stop) {
        if (!stop.cancelled()) work(map_);
      },
      slot);
}

}  // namespace grid_path_planner::nodes
