// Tasks done by child processes, so that a child that crashes or is killed loses only its present
// task.
//
//   ProcessPool pool(2, [&](std::size_t number) { return done(units[number]); });
//   if (pool.idle() > 0) pool.start(task);
//   for (const TaskEnd& end : pool.wait(100)) use(end.task, end.text);
//
// The children are forks with a copy of the memory at the construction of the pool. A lost child is
// replaced by a new fork. Not thread-safe; construct it before other threads are started.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/study/worker_group.h"

namespace grid_path_planner::study {

class ProcessPool : public WorkerGroup {
 public:
  using Work = std::function<std::string(std::size_t task)>;

  // Throws InputError where no process can be created. An exception that `work` throws is a failed
  // task, not a lost child.
  ProcessPool(std::size_t processes, Work work);
  ~ProcessPool() override;  // kills the children, also while they work
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  std::size_t idle() const override;
  std::size_t busy() const override { return children_.size() - idle(); }
  void start(std::size_t task) override;
  std::vector<TaskEnd> wait(int milliseconds) override;

 private:
  struct Child {
    pid_t process = 0;
    int to = -1;
    int from = -1;
    bool busy = false;
    std::size_t task = 0;
    std::string received;
  };

  Child makeChild() const;
  void replace(Child& child, TaskEnd& end);
  bool receive(Child& child, TaskEnd& end);

  Work work_;
  std::vector<Child> children_;
};

}  // namespace grid_path_planner::study
