// ROS time as a node knows it: whether it is there, since when it is this time, and what is done where it goes back.
//
//   NodeTime& time = NodeTime::of(nh);
//   const auto listening = time.onJumpBack([&](double seconds) { forgetWhatWasSeen(); });   // as long as it is held
//   if (!time.isThere()) return;
//   if (const auto problem = time.problemWith(message.header.stamp)) throw InputError(*problem);
//
// Each GuardedQueue has one, and asks it before each callback: no callback asks by itself, and none can forget. So does the
// queue of a ControlThread, before each tick too, and that of tf's thread: what is done of a jump is done in the thread that
// owns what it is done to.
//
// Guaranteed, whoever serves the queue with however many threads: a jump is told once to each listener, one after the other in
// the order of adding; no callback begins at the new time before all have returned; one that throws keeps no other from being
// told. A jump is found by whichever thread of the process reads the time first, and told to each queue that there was one,
// though time has passed the old one again when its next callback comes; jumps between which no callback of a queue began are
// one to it. What takes no lock but where there is a jump to tell: all but onJumpBack().
// Not guaranteed: that a callback that runs while time goes back does not read the new time; jumps of less than a microsecond.
// A listener does not wait for another callback of its queue.
#pragma once

#include <ros/node_handle.h>
#include <ros/time.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {

class NodeTime {
 public:
  NodeTime();

  // That of the queue of `nh`, which it does not outlive. Throws std::logic_error where that is no GuardedQueue.
  static NodeTime& of(const ros::NodeHandle& nh);

  // As hasTime().
  static bool isThere() { return hasTime(); }
  // 0 where there is none.
  static ros::Time now() { return normalized(ros::Time::now()); }
  // Of the last jump back that was told here, or when there first was time; 0 where there is none yet.
  ros::Time since() const;

  // Why a message stamped `stamp` is of another time, to be told after "A path stamped 7.0 is not driven: ": it is from before
  // since(), or ahead by more than clocks of nodes may differ, as what a publisher that latches sends again after time went
  // back. One without a stamp is of no time. None: it is of this time.
  std::optional<std::string> problemWith(const ros::Time& stamp) const;

  // `listener` is told of each jump, by how many seconds, until what is returned is destroyed: this waits for a call that runs
  // in another thread.
  using Listener = std::function<void(double seconds)>;
  [[nodiscard]] std::shared_ptr<void> onJumpBack(Listener listener);

  // Tells the listeners where time went back. For whoever serves the queue; and for a thread that works for a node whose
  // listeners may be called in any.
  void tellJumps();

 private:
  void tell(double seconds) const;

  std::atomic<unsigned> jumps_;          // until then, modulo 4096
  std::atomic<unsigned> told_;           // jumps_, once all listeners have returned
  std::atomic<std::uint64_t> since_{0};  // us; 0: there is no time yet
  std::atomic<bool> went_back_{false};

  struct Listeners {
    std::recursive_mutex mutex;  // held while they are told
    std::map<std::uint64_t, std::shared_ptr<const Listener>> by_number;
    std::uint64_t next = 0;
  };
  const std::shared_ptr<Listeners> listeners_ = std::make_shared<Listeners>();
};

}  // namespace grid_path_planner::nodes
