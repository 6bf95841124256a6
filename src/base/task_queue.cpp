#include "grid_path_planner/base/task_queue.h"

#include <algorithm>
#include <utility>

namespace grid_path_planner::base {

void TaskQueue::Task::wait() const {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return ended_; });
}

bool TaskQueue::Task::waitFor(std::chrono::duration<double> limit) const {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, limit, [this] { return ended_; });
}

TaskQueue::TaskQueue() : thread_([this] { loop(); }) {}

TaskQueue::~TaskQueue() {
  stop();
}

std::shared_ptr<TaskQueue::Task> TaskQueue::post(Work work, const std::string& slot, Turn turn) {
  auto task = std::make_shared<Task>();
  task->work_ = std::move(work);
  task->slot_ = slot;
  std::unique_lock<std::mutex> lock(mutex_);
  if (stopping_) {
    lock.unlock();
    task->cancel();
    run(*task);
    return task;
  }
  if (!slot.empty())
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                  [&](const auto& other) { return other->slot_ == slot; }),
                   waiting_.end());
  waiting_.insert(turn == Turn::NEXT ? waiting_.begin() : waiting_.end(), task);
  posted_.notify_one();
  return task;
}

void TaskQueue::cancel(const std::string& slot) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (running_ && running_->slot_ == slot) running_->cancel();
  for (const auto& task : waiting_)
    if (task->slot_ == slot) task->cancel();
}

void TaskQueue::stop() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    if (running_) running_->cancel();
    for (const auto& task : waiting_) task->cancel();
    posted_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

void TaskQueue::loop() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    posted_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    running_ = waiting_.front();
    waiting_.pop_front();
    lock.unlock();
    run(*running_);
    lock.lock();
    running_.reset();
  }
}

void TaskQueue::run(Task& task) {
  task.work_(task.stop_);
  task.work_ = nullptr;
  std::lock_guard<std::mutex> lock(task.mutex_);
  task.ended_ = true;
  task.changed_.notify_all();
}

}  // namespace grid_path_planner::base
