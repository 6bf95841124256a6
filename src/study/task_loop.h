// Tasks given to workers until all have ended or someone asks to stop.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/study/worker_group.h"

namespace grid_path_planner::study {

// Starts the tasks in their order and calls `ended` for each that has ended. When `stop` asks to end,
// waits for the started ones; true where some were not started.
bool runTasks(const std::vector<std::size_t>& tasks, WorkerGroup& workers,
              const base::StopToken& stop, const std::function<void(const TaskEnd&)>& ended);

// Calls `use` with every line of `text`, each ended by a newline.
void forEachLine(const std::string& text, const std::function<void(const std::string&)>& use);

}  // namespace grid_path_planner::study
