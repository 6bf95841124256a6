#include "ros/guard/node_time.h"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "ros/guard/guarded_queue.h"

namespace grid_path_planner::nodes {
namespace {

constexpr double kMicrosecond = 1e-6;  // s

std::uint64_t microseconds(const ros::Time& time) {
  return normalized(time).toNSec() / 1000;
}

ros::Time timeOf(std::uint64_t microseconds) {
  return ros::Time().fromNSec(microseconds * 1000);
}

// A time and how many jumps there were until then, in one word: no thread sees the one without the other. All that a
// ros::Time holds are 4.3e15 microseconds.
struct Moment {
  unsigned jumps;
  std::uint64_t time;  // us

  static Moment of(std::uint64_t word) {
    return {static_cast<unsigned>(word >> 52), word & ((std::uint64_t{1} << 52) - 1)};
  }
  std::uint64_t word() const { return std::uint64_t{jumps % 4096} << 52 | time; }
};

// Of the process, as ROS time is. Without a lock, since threads that command ask: whoever finds a jump writes from where and
// to where time went, each with its number and only after the one before, and the latest time last. A thread that comes
// meanwhile finishes that.
class Jumps {
 public:
  // Those so far, and to where the last went.
  Moment notice() {
    while (ros::Time::isValid()) {
      // Before the clock is read: else another thread's is later, and before.
      const std::uint64_t latest = latest_;
      const std::uint64_t now = microseconds(ros::Time::now());
      const Moment before = Moment::of(latest);
      if (now < before.time) note(before, now);
      const Moment last = Moment::of(to_);
      if (now == before.time && last.jumps == before.jumps) break;
      std::uint64_t expected = latest;
      if (latest_.compare_exchange_strong(expected, Moment{last.jumps, now}.word())) break;
    }
    return Moment::of(to_);
  }
  // s, of the last.
  double back() const {
    return (static_cast<double>(Moment::of(from_).time) -
            static_cast<double>(Moment::of(to_).time)) *
           kMicrosecond;
  }

 private:
  void note(const Moment& before, std::uint64_t now) {
    const unsigned next = (before.jumps + 1) % 4096;
    for (const auto& [word, time] : {std::pair(&from_, before.time), std::pair(&to_, now)}) {
      std::uint64_t held = *word;
      if (Moment::of(held).jumps == before.jumps)
        word->compare_exchange_strong(held, Moment{next, time}.word());
    }
  }

  std::atomic<std::uint64_t> latest_{0}, from_{0}, to_{0};
};

Jumps jumps_of_process;

}  // namespace

NodeTime::NodeTime() : jumps_(jumps_of_process.notice().jumps), told_(jumps_.load()) {
  tellJumps();
}

NodeTime& NodeTime::of(const ros::NodeHandle& nh) {
  const auto queue = dynamic_cast<GuardedQueue*>(nh.getCallbackQueue());
  if (queue == nullptr) throw std::logic_error("a node's callbacks come by a GuardedQueue");
  return queue->time();
}

ros::Time NodeTime::since() const {
  return timeOf(since_);
}

std::optional<std::string> NodeTime::problemWith(const ros::Time& stamp) const {
  if (!ros::Time::isValid() || since_ == 0) return "there is no ROS time yet";
  if (stamp.isZero()) return "it has no stamp";
  const double ahead = secondsBetween(now(), stamp);
  std::ostringstream problem;
  if (microseconds(stamp) < since_)
    problem << (went_back_ ? "ROS time went back, to " : "the node started at ") << since();
  else if (ahead > kMostAhead)
    problem << "that is " << ahead << " s ahead of the time here";
  else
    return std::nullopt;
  return problem.str();
}

std::shared_ptr<void> NodeTime::onJumpBack(Listener listener) {
  const auto added = std::make_shared<const Listener>(std::move(listener));
  const std::lock_guard<std::recursive_mutex> lock(listeners_->mutex);
  const std::uint64_t number = listeners_->next++;
  std::shared_ptr<void> listening(nullptr, [listeners = listeners_, number](void*) {
    const std::lock_guard<std::recursive_mutex> lock(listeners->mutex);
    listeners->by_number.erase(number);
  });
  listeners_->by_number[number] = added;
  return listening;
}

void NodeTime::tellJumps() {
  if (std::uint64_t none = 0; since_ == none && ros::Time::isValid())
    since_.compare_exchange_strong(none, microseconds(ros::Time::now()));
  if (jumps_of_process.notice().jumps == told_) return;
  const std::lock_guard<std::recursive_mutex> lock(listeners_->mutex);
  const Moment last = jumps_of_process.notice();
  if (last.jumps == jumps_) return;
  since_ = last.time;
  went_back_ = true;
  jumps_ = last.jumps;
  tell(jumps_of_process.back());
  told_ = jumps_.load();
}

// By number: a listener may add others, and end its own listening.
void NodeTime::tell(double seconds) const {
  const auto& listeners = listeners_->by_number;
  for (auto next = listeners.begin(); next != listeners.end();) {
    const auto [number, listener] = *next;
    guarded("What is done where ROS time went back", [&] { (*listener)(seconds); });
    next = listeners.upper_bound(number);
  }
}

}  // namespace grid_path_planner::nodes
