// What a nodelet does before its manager ends.
//
//   const ManagerShutdown end([] { stopVehicle(); });
//
// The manager is another package's program: at SIGINT, and where its XML-RPC method `shutdown` is called (`rosnode kill`,
// another node of its name), roscpp closes all connections before any nodelet hears of it, and SIGTERM ends the process
// at once, so that the last velocity stays in force. While one of these lives all three are taken over: a thread
// calls every `stop`, then whoever handled it before gets the signal or the request: roscpp, or the system. Guaranteed:
// the second signal or request of a process is not held up; a signal that is ignored, as below nohup, stays so; with
// the last of these all is given back. For processes whose main program is not run_node.h, which looks after
// these itself.
#pragma once

#include <functional>
#include <memory>

namespace grid_path_planner::nodes {

class EndWatch;

class ManagerShutdown {
 public:
  // `stop` is called in another thread, at most once.
  explicit ManagerShutdown(std::function<void()> stop);
  // Waits for a `stop` that runs.
  ~ManagerShutdown();
  ManagerShutdown(const ManagerShutdown&) = delete;
  ManagerShutdown& operator=(const ManagerShutdown&) = delete;

 private:
  const std::function<void()> stop_;
  std::shared_ptr<EndWatch> watch_;
};

}  // namespace grid_path_planner::nodes
