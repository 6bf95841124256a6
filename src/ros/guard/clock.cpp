#include "ros/guard/clock.h"

#include <ros/console.h>

#include <sstream>
#include <thread>
#include <utility>

namespace grid_path_planner::nodes {

using base::Stopped;
using base::StopReason;
using base::StopToken;

bool ClockWatch::hasTime() {
  if (ros::Time::isValid()) return true;
  const auto now = std::chrono::steady_clock::now();
  std::lock_guard<std::mutex> lock(mutex_);
  if (now >= next_warning_) {
    ROS_WARN("use_sim_time is set and no /clock has come yet: waiting for it");
    next_warning_ = now + std::chrono::seconds(5);
  }
  return false;
}

std::optional<double> ClockWatch::jumpedBack() {
  std::lock_guard<std::mutex> lock(mutex_);
  const ros::Time now =
      ros::Time::now();  // under the lock: else another call's is later, and before
  const ros::Time before = std::exchange(latest_, now);
  return now < before ? std::make_optional(secondsBetween(now, before)) : std::nullopt;
}

ros::Time LateClock::timeFor(const ros::Time& stamp, double ahead) {
  using std::chrono::milliseconds, std::chrono::steady_clock;
  const auto begin = steady_clock::now();
  const auto isLate = [&] { return secondsBetween(ros::Time::now(), stamp) > ahead; };
  if (!ros::Time::isSimTime() || begin < next_wait_) return ros::Time::now();
  while (isLate() && steady_clock::now() < begin + milliseconds(50))
    std::this_thread::sleep_for(milliseconds(1));
  if (isLate()) next_wait_ = steady_clock::now() + std::chrono::seconds(1);
  return ros::Time::now();
}

double secondsBetween(const ros::Time& from, const ros::Time& to) {
  const auto seconds = [](std::uint32_t count) { return static_cast<double>(count); };
  return seconds(to.sec) - seconds(from.sec) + 1e-9 * (seconds(to.nsec) - seconds(from.nsec));
}

ros::Time normalized(const ros::Time& time) {
  constexpr std::uint32_t kSecond = 1'000'000'000;
  const std::uint64_t seconds = std::uint64_t{time.sec} + time.nsec / kSecond;
  if (seconds > ros::TIME_MAX.sec) return ros::TIME_MAX;
  return {static_cast<std::uint32_t>(seconds), time.nsec % kSecond};
}

std::string whyOfAnotherTime(const ros::Time& stamp, const ros::Time& started,
                             const std::string& owner) {
  const double ahead = secondsBetween(ros::Time::now(), stamp);
  std::ostringstream why;
  if (started.isZero() || stamp < started)
    why << owner << " started at " << started;
  else if (ahead > kMostAhead)
    why << "that is " << ahead << " s ahead of the time here";
  return why.str();
}

void waitForClock(const StopToken& stop) {
  for (ClockWatch clock; !clock.hasTime();) {
    if (stop.reason() != StopReason::NONE) throw Stopped(stop.reason());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace grid_path_planner::nodes
