#include "study/task_loop.h"

namespace grid_path_planner::study {

using base::StopReason, base::StopToken;

bool runTasks(const std::vector<std::size_t>& tasks, WorkerGroup& workers, const StopToken& stop,
              const std::function<void(const TaskEnd&)>& ended) {
  constexpr int kWaitMs = 200;  // between two checks of the stop token
  std::size_t next = 0;
  bool interrupted = false;
  while ((next < tasks.size() && !interrupted) || workers.busy() > 0) {
    if (stop.reason() != StopReason::NONE && next < tasks.size()) interrupted = true;
    while (!interrupted && next < tasks.size() && workers.idle() > 0) workers.start(tasks[next++]);
    for (const TaskEnd& end : workers.wait(kWaitMs)) ended(end);
  }
  return interrupted;
}

void forEachLine(const std::string& text, const std::function<void(const std::string&)>& use) {
  for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    use(text.substr(begin, end - begin));
    if (end == std::string::npos) return;
  }
}

}  // namespace grid_path_planner::study
