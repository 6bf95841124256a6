// Whether the master is there, and this process registered with it again where it was restarted.
//
//   const auto master = MasterWatch::shared();
//   if (master->silence() > 30.0) halt();
//
// roscpp registers names once: a master that was restarted knows none of them, so that nobody finds
// the services and topics of a node that runs on. The watch asks every second and registers all
// topics and services of the process again, within 2 s of the master's return. Connections that
// exist are not touched, but where the new master sends another list of publishers. Parameters are
// lost with their master. Not guaranteed: names of nodes outside this package; services offered later
// than a second after the last shared(), for up to 16 s: only the master lists them, with those of all
// nodes, so that it is asked ever more seldom.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace grid_path_planner::nodes {

class MasterWatch {
 public:
  // The one of the process; it ends with the last who holds it.
  static std::shared_ptr<MasterWatch> shared();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  // Seconds since the master answered last, to within one; takes no lock.
  double silence() const;

  // No name is registered after the one of the present question: the process is about to give its names back. Waits for
  // nothing.
  void registerNoMore() { names_are_given_back_ = true; }

  // How often another master answered than the one before.
  unsigned restarts() const { return restarts_.load(); }

 private:
  using Clock = std::chrono::steady_clock;

  MasterWatch();
  bool isOver() const { return done_ || names_are_given_back_; }
  void run();
  void tryToAsk() noexcept;
  void ask();
  void rememberServices();
  bool rememberingIsDue();
  bool registersAgain() const;
  bool registersTopics(const char* list, const char* method) const;

  const std::string services_uri_;  // asked for once: roscpp has none when it is shut down
  std::atomic<Clock::rep> answered_;
  std::atomic<unsigned> restarts_{0};
  // The thread's:
  int pid_ = 0;              // of the master
  bool known_ = false;       // to the master, once
  bool owes_names_ = false;  // to a master that did not know them and has not answered yet for all
  std::vector<std::string> services_;
  Clock::time_point remembers_at_{};
  Clock::duration between_{};

  std::atomic<bool> services_grow_{true};
  std::mutex mutex_;
  std::condition_variable ends_;
  std::atomic<bool> names_are_given_back_{false};
  std::atomic<bool> done_{false};  // looked at between two questions: who ends waits for one
  std::thread thread_;
};

}  // namespace grid_path_planner::nodes
