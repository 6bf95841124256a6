#include "ros/common/ending/manager_end.h"

#include <semaphore.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace grid_path_planner::nodes {
namespace {

constexpr std::array<int, 2> kEndSignals = {SIGINT, SIGTERM};

// What the handler uses.
std::array<struct sigaction, kEndSignals.size()> before_watch;  // in the order of kEndSignals
std::atomic<int> signal_to_pass{0};
sem_t signal_came;

void passSignalOn(int number) {
  for (std::size_t i = 0; i < kEndSignals.size(); ++i)
    if (kEndSignals[i] == number) ::sigaction(number, &before_watch[i], nullptr);
  ::kill(::getpid(), number);
}

void takeSignal(int number) {
  const int error = errno;
  if (signal_to_pass.exchange(number) == 0)
    ::sem_post(&signal_came);
  else
    passSignalOn(number);
  errno = error;
}

bool isIgnored(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler == SIG_IGN;
}

bool isOurs(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler == takeSignal;
}

}  // namespace

// The one of the process; it ends with the last who holds it.
class SignalWatch {
 public:
  static std::shared_ptr<SignalWatch> shared() {
    static std::mutex mutex;
    static std::weak_ptr<SignalWatch> watch;
    const std::lock_guard<std::mutex> lock(mutex);
    auto found = watch.lock();
    if (!found) watch = found = std::make_shared<SignalWatch>();
    return found;
  }

  SignalWatch() {
    ::sem_init(&signal_came, 0, 0);
    thread_ = std::thread([this] { run(); });
    struct sigaction action = {};
    action.sa_handler = takeSignal;
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < kEndSignals.size(); ++i) {
      ::sigaction(kEndSignals[i], nullptr, &before_watch[i]);
      if (!isIgnored(before_watch[i])) ::sigaction(kEndSignals[i], &action, nullptr);
    }
  }

  ~SignalWatch() {
    for (std::size_t i = 0; i < kEndSignals.size(); ++i) {
      struct sigaction now = {};
      ::sigaction(kEndSignals[i], nullptr, &now);
      if (isOurs(now)) ::sigaction(kEndSignals[i], &before_watch[i], nullptr);
    }
    ::sem_post(&signal_came);
    thread_.join();
  }

  void add(const std::function<void()>& stop) {
    const std::lock_guard<std::mutex> lock(mutex_);
    stops_.push_back(&stop);
  }
  void remove(const std::function<void()>& stop) {
    const std::lock_guard<std::mutex> lock(mutex_);
    stops_.erase(std::remove(stops_.begin(), stops_.end(), &stop), stops_.end());
  }

 private:
  void run() {
    while (::sem_wait(&signal_came) != 0) {  // interrupted
    }
    if (const int number = signal_to_pass) {
      stopAll();
      passSignalOn(number);
    }
  }

  void stopAll() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::function<void()>* stop : stops_) {
      try {
        (*stop)();
      } catch (...) {
        continue;  // the others stop all the same
      }
    }
  }

  std::mutex mutex_;
  std::vector<const std::function<void()>*> stops_;
  std::thread thread_;
};

ManagerEnd::ManagerEnd(std::function<void()> stop)
    : stop_(std::move(stop)), watch_(SignalWatch::shared()) {
  watch_->add(stop_);
}

ManagerEnd::~ManagerEnd() {
  watch_->remove(stop_);
}

}  // namespace grid_path_planner::nodes
