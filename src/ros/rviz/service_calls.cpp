#include "ros/rviz/service_calls.h"

#include <vector>

#include "base/current_error.h"
#include "panel/shown_text.h"

namespace grid_path_planner::nodes {

using base::currentErrorText;
using panel::shownDuration;

ServiceCalls::~ServiceCalls() {
  for (auto& task : tasks_) close(*task);
  for (auto& task : tasks_) task->thread.join();
}

void ServiceCalls::begin(const std::string& name, double seconds, Connect connect, Ask ask,
                         std::function<void()> answered, Failed failed) {
  tasks_.push_back(std::make_unique<Task>());
  Task& task = *tasks_.back();
  task.name = name;
  task.seconds = seconds;
  task.deadline = std::chrono::steady_clock::now() +
                  std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                      std::chrono::duration<double>(seconds));
  task.answered = std::move(answered);
  task.failed = std::move(failed);
  task.thread = std::thread(
      [&task, connect = std::move(connect), ask = std::move(ask)] { run(task, connect, ask); });
}

// In the task's thread.
void ServiceCalls::run(Task& task, const Connect& connect, const Ask& ask) {
  std::string failure;
  try {
    ros::ServiceClient client = connect();
    {
      const std::lock_guard<std::mutex> lock(task.mutex);
      if (task.closed) client.shutdown();
      task.client = client;
    }
    if (!client.isValid())
      failure = "There is no service " + task.name;
    else if (!ask(client))
      failure = task.name + " gave no answer: its node has ended, or the log says why";
  } catch (...) {
    failure = task.name + ": " + currentErrorText();
  }
  const std::lock_guard<std::mutex> lock(task.mutex);
  task.failure = failure;
  task.finished = true;
}

void ServiceCalls::close(Task& task) {
  const std::lock_guard<std::mutex> lock(task.mutex);
  task.closed = true;
  task.client.shutdown();
}

bool ServiceCalls::finished(Task& task) {
  const std::lock_guard<std::mutex> lock(task.mutex);
  return task.finished;
}

void ServiceCalls::poll() {
  std::vector<std::function<void()>> results;  // which may start other calls
  const auto now = std::chrono::steady_clock::now();
  for (auto i = tasks_.begin(); i != tasks_.end();) {
    Task& task = **i;
    if (finished(task)) {
      task.thread.join();
      if (!task.told && task.failure.empty())
        results.push_back(std::move(task.answered));
      else if (!task.told)
        results.push_back([failed = task.failed, why = task.failure] { failed(why); });
      i = tasks_.erase(i);
      continue;
    }
    if (!task.told && now > task.deadline) {
      task.told = true;
      close(task);
      results.push_back([failed = task.failed, why = task.name + " has not answered for " +
                                                     shownDuration(task.seconds)] { failed(why); });
    }
    ++i;
  }
  for (const auto& tell : results) tell();
}

}  // namespace grid_path_planner::nodes
