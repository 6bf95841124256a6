// What a nodelet does before a signal ends its manager.
//
//   const ManagerEnd end([] { stopVehicle(); });
//
// The manager is another package's program: at SIGINT roscpp closes all connections before any nodelet hears of
// it, and SIGTERM ends the process at once, so that the last velocity stays in force. While one of these lives
// both signals are taken over: a thread calls every `stop`, then whoever handled the signal before gets it: roscpp,
// or the system. Guaranteed: the second signal of a process is not held up; one that is ignored, as below nohup, stays
// so. For processes whose main program is not run_node.h, which looks after signals itself.
#pragma once

#include <functional>
#include <memory>

namespace grid_path_planner::nodes {

class SignalWatch;

class ManagerEnd {
 public:
  // `stop` is called in another thread, at most once.
  explicit ManagerEnd(std::function<void()> stop);
  // Waits for a `stop` that runs.
  ~ManagerEnd();
  ManagerEnd(const ManagerEnd&) = delete;
  ManagerEnd& operator=(const ManagerEnd&) = delete;

 private:
  const std::function<void()> stop_;
  const std::shared_ptr<SignalWatch> watch_;
};

}  // namespace grid_path_planner::nodes
