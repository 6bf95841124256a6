#include "ros/guard/master/shutdown_timeout.h"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <iostream>
#include <utility>

#include "ros/guard/guarded_queue.h"
#include "ros/guard/master/xmlrpc_call.h"

namespace grid_path_planner::nodes {
namespace {

constexpr double kPeriod = 0.1;            // s
constexpr double kAskedAfter = 1.5;        // s, after which the master is asked
constexpr double kPatienceOfMaster = 0.2;  // s
constexpr int kInterruptedEach = 20;       // periods: most answers come within that time

// Of no use to anybody else here, and nothing happens where nobody handles it.
constexpr int kInterruption = SIGURG;

std::atomic<int> unfinished{0};

// So that poll() returns with EINTR.
void handleInterruption() {
  struct sigaction action = {};
  action.sa_handler = [](int) {};
  ::sigaction(kInterruption, &action, nullptr);
}

// Not to blame where it cannot be asked.
bool masterAnswers() noexcept {
  bool answers = true;
  guarded("A question to the master",
          [&] { answers = answersXmlRpc(masterUri(), kPatienceOfMaster); });
  return answers;
}

}  // namespace

ShutdownTimeout::ShutdownTimeout(std::string name, std::function<bool()> asked)
    : name_(std::move(name)),
      asked_(std::move(asked)),
      main_thread_(::pthread_self()),
      thread_([this] { run(); }) {}

ShutdownTimeout::~ShutdownTimeout() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  over_.notify_all();
  thread_.join();
}

bool ShutdownTimeout::isOverWithin(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  return over_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return is_over_; });
}

void ShutdownTimeout::run() {
  while (!asked_())
    if (isOverWithin(kPeriod)) return;
  if (isOverWithin(kAskedAfter)) return;
  handleInterruption();
  for (int i = 0; unfinished > 0 || masterAnswers(); ++i) {
    if (unfinished == 0 && i % kInterruptedEach == 0) ::pthread_kill(main_thread_, kInterruption);
    if (isOverWithin(kPeriod)) return;
  }
  std::cerr << name_ << " ends without giving its names back: the master at " << masterUri()
            << " does not answer\n";
  ::_exit(0);
}

ShutdownBlocker::ShutdownBlocker() {
  ++unfinished;
}

ShutdownBlocker::~ShutdownBlocker() {
  --unfinished;
}

}  // namespace grid_path_planner::nodes
