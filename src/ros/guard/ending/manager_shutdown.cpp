#include "ros/guard/ending/manager_shutdown.h"

#include <semaphore.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "ros/guard/ending/shutdown_method.h"
#include "ros/guard/guarded_queue.h"

namespace grid_path_planner::nodes {
namespace {

constexpr std::array<int, 2> kEndSignals = {SIGINT, SIGTERM};
constexpr int kRequest = -1;  // in the place of a signal's number

// What the handler uses.
std::array<struct sigaction, kEndSignals.size()> before_watch;  // in the order of kEndSignals
std::atomic<int> first_end{0};  // the signal that came first, or the request; 0: none yet
sem_t end_came;

bool isFirst(int end) {
  int none = 0;
  return first_end.compare_exchange_strong(none, end);
}

void passSignalOn(int number) {
  for (std::size_t i = 0; i < kEndSignals.size(); ++i)
    if (kEndSignals[i] == number) ::sigaction(number, &before_watch[i], nullptr);
  ::kill(::getpid(), number);
}

void takeSignal(int number) {
  const int error = errno;
  if (isFirst(number))
    ::sem_post(&end_came);
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

// The one of the process: none is made while another ends, or it would take that one's handler for one to give back.
class EndWatch {
 public:
  static std::shared_ptr<EndWatch> shared() {
    const std::lock_guard<std::mutex> lock(makingOrEnding());
    auto found = last().lock();
    if (!found) last() = found = std::make_shared<EndWatch>();
    return found;
  }
  // It ends with the last who holds it.
  static void release(std::shared_ptr<EndWatch>& held) {
    const std::lock_guard<std::mutex> lock(makingOrEnding());
    held.reset();
  }

  EndWatch() {
    first_end = 0;  // or one that has not ended the process would be passed on again
    ::sem_init(&end_came, 0, 0);
    thread_ = std::thread([this] { run(); });
    takeSignals();
    method_.emplace([this](const std::function<void()>& pass_on) { takeRequest(pass_on); });
  }

  ~EndWatch() {
    method_.reset();
    giveSignalsBack();
    ::sem_post(&end_came);
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
  static std::mutex& makingOrEnding() {
    static std::mutex mutex;
    return mutex;
  }
  static std::weak_ptr<EndWatch>& last() {
    static std::weak_ptr<EndWatch> watch;
    return watch;
  }

  static void takeSignals() {
    struct sigaction action = {};
    action.sa_handler = takeSignal;
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < kEndSignals.size(); ++i) {
      ::sigaction(kEndSignals[i], nullptr, &before_watch[i]);
      if (!isIgnored(before_watch[i])) ::sigaction(kEndSignals[i], &action, nullptr);
    }
  }

  static void giveSignalsBack() {
    for (std::size_t i = 0; i < kEndSignals.size(); ++i) {
      struct sigaction now = {};
      ::sigaction(kEndSignals[i], nullptr, &now);
      if (isOurs(now)) ::sigaction(kEndSignals[i], &before_watch[i], nullptr);
    }
  }

  // In roscpp's XML-RPC thread, for which the destructor waits.
  void takeRequest(const std::function<void()>& pass_on) {
    if (!isFirst(kRequest)) return pass_on();
    request_ = pass_on;
    ::sem_post(&end_came);
  }

  void run() {
    while (::sem_wait(&end_came) != 0) {  // interrupted
    }
    const int end = first_end;
    if (!end) return;
    stopAll();
    if (end == kRequest)
      request_();
    else
      passSignalOn(end);
  }

  void stopAll() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::function<void()>* stop : stops_)
      guarded("The end of a nodelet", *stop);  // the others stop all the same
  }

  std::mutex mutex_;
  std::vector<const std::function<void()>*> stops_;
  std::function<void()> request_;  // written before end_came is posted
  std::thread thread_;
  std::optional<ShutdownMethod> method_;
};

ManagerShutdown::ManagerShutdown(std::function<void()> stop)
    : stop_(std::move(stop)), watch_(EndWatch::shared()) {
  watch_->add(stop_);
}

ManagerShutdown::~ManagerShutdown() {
  watch_->remove(stop_);
  EndWatch::release(watch_);
}

}  // namespace grid_path_planner::nodes
