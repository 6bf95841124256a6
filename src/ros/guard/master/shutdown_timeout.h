// Ends a process that was asked to end while its master answers nobody.
//
//   const ShutdownTimeout limit("path_planner", [] { return isAskedToEnd(); });
//
// roscpp gives every topic and service back to the master, one by one, and waits for each answer for
// as long as there is a connection: where the master is stopped, or so busy that it takes half a
// second for each, a node with thirty of them ends late or never. 1.5 s after it was asked, the
// process ends as it is (exit code 0) if the master has no answer within 0.2 s; the master forgets
// its names when another node takes them. A master that does answer is waited for: whatever else
// keeps the node from ending is not hidden. But a single answer may be lost, and roscpp waits for it in
// poll() without a limit of time: now and then the main thread is interrupted there, so that it asks
// again.
//
// A destructor does first what others rely on (a last command, a file), and then what asks the
// master: subscribers, services and publishers.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace grid_path_planner::nodes {

class ShutdownTimeout {
 public:
  // Made by the main thread. `asked`: whether the process is to end. Called from a thread, ten times a second.
  ShutdownTimeout(std::string name, std::function<bool()> asked);
  ~ShutdownTimeout();
  ShutdownTimeout(const ShutdownTimeout&) = delete;
  ShutdownTimeout& operator=(const ShutdownTimeout&) = delete;

 private:
  void run();
  bool isOverWithin(double seconds);

  const std::string name_;
  const std::function<bool()> asked_;
  const std::thread::native_handle_type main_thread_;
  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::thread thread_;
};

// While one lives, the process does not end so: a file is being written.
class ShutdownBlocker {
 public:
  ShutdownBlocker();
  ~ShutdownBlocker();
  ShutdownBlocker(const ShutdownBlocker&) = delete;
  ShutdownBlocker& operator=(const ShutdownBlocker&) = delete;
};

}  // namespace grid_path_planner::nodes
