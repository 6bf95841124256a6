#include "ros/input/input.h"

#include <ros/console.h>

#include <algorithm>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/scheduling/guarded_timer.h"

namespace grid_path_planner::nodes {

namespace {

constexpr double kPeriod = 0.01;            // s of the wall clock between two questions to tf
constexpr std::size_t kMostInRoscpp = 100;  // messages, until the queue's thread has looked at them

InputJudge::Moment momentAt(const ros::Time& time) {
  return {time, std::chrono::steady_clock::now(), ros::Time::isSimTime()};
}

}  // namespace

void addTo(diagnostic_updater::DiagnosticStatusWrapper& status, const std::string& name,
           const InputCounts& counts) {
  status.add(name, counts.received);
  status.add(name + " used", counts.used);
  status.add(name + " waiting", counts.waiting);
  status.add(name + " refused", counts.refusedInAll());
  for (const auto& [reason, count] : counts.refused)
    status.add(name + " refused: " + reason, count);
  status.add(name + " refused last because", counts.last_refusal);
}

InputBase::InputBase(const ros::NodeHandle& nh, const std::string& topic, const InputRules& rules,
                     const FrameLookup& transforms, std::function<void()> on_ready)
    : nh_(nh),
      topic_(nh.resolveName(topic)),
      transforms_(transforms),
      time_(NodeTime::of(nh)),
      on_ready_(std::move(on_ready)),
      judge_(topic_, rules, now(), [](const std::string& sentence) { ROS_WARN_STREAM(sentence); }),
      timer_(guardedTimer(nh, kPeriod, [this] { poll(); })),
      jumps_(time_.onJumpBack([this](double seconds) { timeWentBack(seconds); })) {
  timer_.stop();
}

void InputBase::shutdown() {
  subscriber_.shutdown();
  timer_.stop();
  jumps_.reset();
}

void InputBase::timeWentBack(double seconds) {
  if (judge_.counts().waiting > 0)
    ROS_WARN_STREAM("ROS time went back by " << seconds << " s: what waits on " << topic_
                                             << " is forgotten");
  beginAnew("ROS time went back");
}

void InputBase::setRules(const InputRules& rules) {
  judge_.setRules(rules);
}

// One that is not kept for long may be lost here, too: it is not unpacked.
WaitingBound InputBase::inboxOf(const InputRules& rules) const {
  const std::size_t most =
      rules.most_waiting == 1 ? 1 : std::max(rules.most_waiting, kMostInRoscpp);
  return {most, std::min(rules.most_bytes, kMostWaitingBytes)};
}

InputJudge::Moment InputBase::now() const {
  return momentAt(NodeTime::now());
}

Eigen::Isometry3d InputBase::poseOf(const std::string& into, const std::string& frame,
                                    const ros::Time& stamp) const {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = stamp;
  Placing by;
  by.into = into;
  return transforms_.place(header, by).pose;
}

std::optional<std::string> InputBase::add(const ros::Time& given, const std::string& frame,
                                          std::size_t bytes,
                                          boost::shared_ptr<const void> message) {
  const ros::Time stamp = normalized(given);
  if (judge_.waits()) poll();  // those that came before it are used before it
  const auto moment = now();
  try {
    if (auto why = judge_.add({stamp, frameName(frame), bytes}, std::move(message), moment))
      return why;
  } catch (const base::InputError& error) {
    judge_.refuse("no frame", error.what(), moment);
    return error.what();
  }
  poll();
  return std::nullopt;
}

void InputBase::poll() {
  const bool is_ready =
      judge_.place([this](const std::string& into, const std::string& frame,
                          const ros::Time& stamp) { return poseOf(into, frame, stamp); },
                   now());
  if (judge_.waits())
    timer_.start();
  else
    timer_.stop();
  if (is_ready) on_ready_();
}

std::optional<std::string> InputBase::use(const InputJudge::Item& item,
                                          const std::function<void()>& work) {
  try {
    work();
    judge_.countUsed(item, now());
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    judge_.giveUp();
    throw;
  } catch (const base::Stopped&) {  // which is no std::exception
    judge_.giveUp();
    throw;
  } catch (const std::exception& error) {
    judge_.countRefused(error.what(), now());
    return error.what();
  }
}

}  // namespace grid_path_planner::nodes
