#include "ros/input/transform_receiver.h"

#include <ros/console.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/clock.h"
#include "ros/guard/incoming/bounded_subscription.h"
#include "ros/guard/network_text.h"
#include "ros/guard/scheduling/log_throttle.h"

namespace grid_path_planner::nodes {
namespace {

using Event = ros::MessageEvent<tf2_msgs::TFMessage const>;

constexpr double kWarningPeriod = 5.0;  // s
constexpr std::size_t kMessages = 100;

// Seconds. Below the 5 s in which right transforms must count again; above what the clocks of one
// vehicle's computers, or /clock and /tf, differ by.
double mostAhead() {
  return ros::Time::isSimTime() ? 10.0 : 4.0;
}

// A thousandth of a millionth more than 1 is half a centimetre in coordinates of utm. tf2 refuses what is farther off.
void makeUnit(geometry_msgs::Quaternion& q) {
  const double squared = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(std::abs(squared - 1.0) < 10e-3)) return;
  const double length = std::sqrt(squared);
  for (double* part : {&q.x, &q.y, &q.z, &q.w}) *part /= length;
}

}  // namespace

TransformStamps::TransformStamps(double length)
    : length_(static_cast<std::uint64_t>(length * 1e9)) {}

bool TransformStamps::take(const std::string& child, const ros::Time& stamp) {
  std::set<std::uint64_t>& held = of_[child];
  const std::uint64_t time = stamp.toNSec();
  if (!held.empty() && *held.rbegin() > time + length_) return false;
  if (!held.insert(time).second) return false;
  while (*held.begin() + length_ < *held.rbegin()) held.erase(held.begin());
  return true;
}

void TransformStamps::giveBack(const std::string& child, const ros::Time& stamp) {
  of_[child].erase(stamp.toNSec());
}

TransformReceiver::TransformReceiver(ros::NodeHandle nh, tf2_ros::Buffer& buffer, Listener listener)
    : buffer_(buffer),
      listener_(std::move(listener)),
      stamps_(buffer.getCacheLength().toSec()),
      on_jump_back_(guarded_.time().onJumpBack([this](double) {
        buffer_.clear();
        stamps_.clear();
      })) {
  nh.setCallbackQueue(&guarded_);
  const auto subscribe = [&](const char* topic, bool is_static) {
    return subscribeBounded<tf2_msgs::TFMessage, const Event&>(
        nh, topic, {kMessages, kMostWaitingBytes}, [this, is_static](const Event& event) {
          receive(*event.getMessage(), printable(event.getPublisherName()), is_static);
        });
  };
  moving_ = subscribe("/tf", false);
  static_ = subscribe("/tf_static", true);
  spinner_.start();
}

TransformReceiver::~TransformReceiver() {
  moving_.shutdown();
  static_.shutdown();
  spinner_.stop();
}

void TransformReceiver::receive(const tf2_msgs::TFMessage& message, const std::string& node,
                                bool is_static) {
  if (listener_) listener_(message, node, is_static);
  const ros::Time now = ros::Time::now();
  static LogThrottle seldom(kWarningPeriod);
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    const std::string why = insertTransform(buffer_, stamps_, transform, node, is_static, now);
    ROS_WARN_STREAM_COND(!why.empty() && seldom.isDue(), why);
  }
}

std::string insertTransform(tf2::BufferCore& buffer, TransformStamps& stamps,
                            geometry_msgs::TransformStamped transform, const std::string& node,
                            bool is_static, const ros::Time& now) {
  std::ostringstream why;
  for (const std::string* name : {&transform.child_frame_id, &transform.header.frame_id})
    if (!name->empty() && printable(*name).empty())
      return "A transform of " + node +
             " is dropped: a name of its frames is no text that may be told";
  if (is_static) transform.header.stamp = ros::Time();
  const double ahead = secondsBetween(now, transform.header.stamp);
  if (!is_static && (transform.header.stamp.isZero() || ahead > mostAhead())) {
    why << "A transform from " << transform.child_frame_id << " to " << transform.header.frame_id
        << " of " << node << " is dropped: it is stamped " << transform.header.stamp << ", now is "
        << now;
    return why.str();
  }
  const geometry_msgs::Vector3& by = transform.transform.translation;
  if (!std::isfinite(by.x) || !std::isfinite(by.y) || !std::isfinite(by.z)) {
    why << "A transform from " << transform.child_frame_id << " to " << transform.header.frame_id
        << " of " << node << " is dropped: it is not finite";
    return why.str();
  }
  makeUnit(transform.transform.rotation);
  const std::string child = frameName(transform.child_frame_id);
  if (!is_static && !stamps.take(child, transform.header.stamp)) return "";
  try {
    if (!buffer.setTransform(transform, node, is_static) && !is_static)
      stamps.giveBack(child, transform.header.stamp);
  } catch (const tf2::TransformException& error) {
    why << "A transform of " << node << " is dropped: " << error.what();
  }
  return why.str();
}

}  // namespace grid_path_planner::nodes
