#include "ros/mapping/mapping_thread.h"

#include <exception>
#include <utility>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::StopSource;
using base::TaskQueue;

void MappingThread::run(const Work& work) {
  std::exception_ptr thrown =
      std::make_exception_ptr(InputError("the mapping ends and does nothing more"));
  const auto task = worker_.post(
      [&](const StopSource&) {
        try {
          work(map_);
          thrown = nullptr;
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
