// Workers for numbered tasks: child processes, or the ranks of an MPI run.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace grid_path_planner::study {

// How a task ended.
struct TaskEnd {
  std::size_t task = 0;
  bool failed = false;
  std::string text;  // what the work returned, or why it failed
};

class WorkerGroup {
 public:
  virtual ~WorkerGroup() = default;

  // How many tasks can be started now, and how many are being done.
  virtual std::size_t idle() const = 0;
  virtual std::size_t busy() const = 0;

  // Precondition: idle() > 0.
  virtual void start(std::size_t task) = 0;

  // The tasks that have ended, waiting for the first one for at most so many milliseconds. May
  // return early and empty.
  virtual std::vector<TaskEnd> wait(int milliseconds) = 0;
};

}  // namespace grid_path_planner::study
