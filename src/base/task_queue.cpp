#include "grid_path_planner/base/task_queue.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/current_error.h"

namespace grid_path_planner::base {
namespace {

constexpr int kMostOvertaken = 3;

}  // namespace

void TaskQueue::Task::wait() const {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return ended_; });
}

bool TaskQueue::Task::waitFor(std::chrono::duration<double> limit) const {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, limit, [this] { return ended_; });
}

TaskQueue::TaskQueue(OnError on_error)
    : on_error_(std::move(on_error)), thread_([this] { loop(); }) {}

TaskQueue::~TaskQueue() {
  stop();
}

std::shared_ptr<TaskQueue::Task> TaskQueue::post(Work work, const std::string& slot, Turn turn) {
  auto task = std::make_shared<Task>();
  task->work_ = std::move(work);
  task->slot_ = slot;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stopping_) {
    task->cancel();
    end(*task);
    return task;
  }
  insert(task, turn);
  if (running_ && idles_) running_->cancel();
  posted_.notify_one();
  return task;
}

void TaskQueue::postIdle(Work work) {
  auto task = std::make_shared<Task>();
  task->work_ = std::move(work);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stopping_) return;
  idle_ = std::move(task);
  posted_.notify_one();
}

void TaskQueue::insert(const std::shared_ptr<Task>& task, Turn turn) {
  const auto same = std::find_if(waiting_.begin(), waiting_.end(), [&](const auto& other) {
    return !task->slot_.empty() && other->slot_ == task->slot_;
  });
  if (same != waiting_.end()) {
    end(**same);
    if (turn == Turn::LAST) {
      task->overtaken_ = (*same)->overtaken_;
      *same = task;
      return;
    }
    waiting_.erase(same);
  }
  waiting_.insert(turn == Turn::NEXT ? overtake() : waiting_.end(), task);
}

// The place behind what may not be overtaken any more.
TaskQueue::Waiting::iterator TaskQueue::overtake() {
  auto place = waiting_.end();
  while (place != waiting_.begin() && (*std::prev(place))->overtaken_ < kMostOvertaken)
    ++(*--place)->overtaken_;
  return place;
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
    idle_.reset();
    posted_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

void TaskQueue::loop() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    posted_.wait(lock, [this] { return stopping_ || !waiting_.empty() || idle_; });
    running_ = next();
    if (!running_) return;
    lock.unlock();
    run(*running_);
    lock.lock();
    running_.reset();
  }
}

// Null where none is left. Precondition: mutex_ is held.
std::shared_ptr<TaskQueue::Task> TaskQueue::next() {
  idles_ = waiting_.empty();
  if (idles_) return std::exchange(idle_, nullptr);
  std::shared_ptr<Task> task = std::move(waiting_.front());
  waiting_.pop_front();
  return task;
}

void TaskQueue::run(Task& task) {
  try {
    task.work_(task.stop_);
  } catch (...) {
    tellError();
  }
  end(task);
}

// Of the exception that is being handled. Telling may want memory that is not there: who is told hears of it without
// its text, and the thread lives on.
void TaskQueue::tellError() const noexcept {
  std::string text;
  try {
    text = currentErrorText();
  } catch (...) {
  }
  try {
    if (on_error_) on_error_(text);
  } catch (...) {
  }
}

void TaskQueue::end(Task& task) {
  task.work_ = nullptr;
  std::lock_guard<std::mutex> lock(task.mutex_);
  task.ended_ = true;
  task.changed_.notify_all();
}

}  // namespace grid_path_planner::base
