#include "ros/guard/scheduling/control_thread.h"

#include <sys/prctl.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <memory>
#include <new>
#include <utility>

#include "ros/guard/process/memory_failures.h"
#include "ros/guard/scheduling/cpu_share.h"
#include "ros/guard/scheduling/realtime_priority.h"

namespace grid_path_planner::nodes {
namespace {

constexpr double kMostShare = 0.5;  // of a processor
constexpr int kLastAttempts = 20;
constexpr std::chrono::milliseconds kBetweenAttempts(50);

// Work that another thread waits for. No promise: one that is dropped takes memory.
class AskedWork {
 public:
  explicit AskedWork(const std::function<void()>& work) : work_(work) {}

  void call() {
    called_ = true;
    try {
      work_();
    } catch (...) {
      thrown_ = std::current_exception();
    }
  }
  // Done, or dropped. Nothing of who waits is touched after this.
  void end() noexcept {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  void wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return ended_; });
    if (!called_) throw std::bad_alloc();
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  const std::function<void()>& work_;
  bool called_ = false;
  std::exception_ptr thrown_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
};

}  // namespace

void ControlThread::start(double rate, int priority) {
  rate_ = rate;
  priority_ = priority;
  next_tick_ = Clock::now();
  thread_ = std::thread([this] {
    ::prctl(PR_SET_NAME, "control");  // for top, debuggers and test/ros/support/lock_watch.cpp
    run();
  });
}

void ControlThread::stop() {
  done_ = true;
  // It may wait for most of a period.
  guarded("Waking the control thread", [this] { post([] {}); });
  if (thread_.joinable()) thread_.join();
}

void ControlThread::post(std::function<void()> work) {
  guarded_.addCallback(callbackOf(std::move(work)));
}

void ControlThread::doAndWait(const std::function<void()>& work) {
  const auto asked = std::make_shared<AskedWork>(work);
  // The last copy of what is posted goes with the call, or where the queue has no memory for it.
  std::shared_ptr<void> end(nullptr, [asked](void*) { asked->end(); });
  post([this, asked, end = std::move(end)] {
    asked->call();
    tick();
    asked->end();
  });
  asked->wait();
}

bool ControlThread::askAtLast(const std::function<void()>& work) noexcept {
  for (int i = 0; i < kLastAttempts; ++i) {
    if (guarded("The last work of the control thread", [&] { doAndWait(work); })) return true;
    std::this_thread::sleep_for(kBetweenAttempts);
  }
  return false;
}

void ControlThread::tick() {
  try {
    guarded_.time().tellJumps();
    tick_();
  } catch (...) {
    noteCurrentError();
    giveUpTick();
  }
}

// In a catch block.
void ControlThread::giveUpTick() noexcept {
  try {
    on_failure_();
  } catch (...) {
    return;  // the next tick tries again
  }
}

void ControlThread::restartPeriod() {
  next_tick_ = Clock::now() + period();
}

void ControlThread::setPriority(int priority) {
  if (std::exchange(priority_, priority) != priority) takePriority();
}

std::string ControlThread::scheduling() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return scheduling_;
}

ControlThread::Clock::duration ControlThread::period() const {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / rate_));
}

void ControlThread::takePriority() {
  const std::string why = takeRealtimePriority(priority_);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!why.empty())
    scheduling_ = "ordinary: " + why;
  else
    scheduling_ = priority_ > 0 ? "real-time priority " + std::to_string(priority_) : "ordinary";
}

void ControlThread::run() {
  takePriority();
  CpuShare share(kMostShare);
  while (!done_) {
    std::this_thread::sleep_until(share.notBefore());
    share.take([this] { workOrTick(); });
  }
}

void ControlThread::workOrTick() {
  const auto left = std::chrono::duration<double>(next_tick_ - Clock::now()).count();
  if (left > 0.0) return callWaiting(queue_, ros::WallDuration(left));
  next_tick_ = std::max(next_tick_ + period(), Clock::now());
  callWaiting(queue_, ros::WallDuration(0.0));
  tick();
}

}  // namespace grid_path_planner::nodes
