// Every message that a node of ours subscribes to, as roscpp hands over its bytes: judged, unpacked, given on.
#include "ros/guard/incoming/claimed_lengths.h"

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Joy.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>
#include <tf2_msgs/TFMessage.h>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/NavigatePathActionFeedback.h"
#include "grid_path_planner/NavigatePathActionGoal.h"
#include "grid_path_planner/NavigatePathActionResult.h"
#include "grid_path_planner/PlanPathActionFeedback.h"
#include "grid_path_planner/PlanPathActionGoal.h"
#include "grid_path_planner/PlanPathActionResult.h"

namespace grid_path_planner::fuzz {
namespace {

// As a subscription of roscpp calls it. What is given on has the bytes that came, and no more.
template <class Message>
void handOver(std::string bytes) {
  int given = 0;
  std::string again;
  const auto take = [&](const Message& message) {
    ++given;
    again = bytesOf(message);
  };
  nodes::CheckedMessages<const Message&> helper(take);
  ros::SubscriptionCallbackHelperDeserializeParams params;
  params.buffer = reinterpret_cast<std::uint8_t*>(bytes.data());
  params.length = static_cast<std::uint32_t>(bytes.size());
  ros::VoidConstPtr message;
  try {
    message = helper.deserialize(params);
  } catch (const base::InputError&) {  // roscpp logs what this says
    return;
  } catch (const ros::serialization::StreamOverrunException&) {
    return;
  }
  const bool is_none = message == nodes::noMessage<Message>();
  mustHold(is_none == (bytes.empty() && !bytesOf(Message()).empty()), "no bytes are no message");
  if (is_none) return;
  ros::SubscriptionCallbackHelperCallParams call;
  using Event = ros::MessageEvent<const void>;
  call.event = Event(message, boost::make_shared<ros::M_string>(), ros::Time(1, 0), false,
                     Event::CreateFunction());
  helper.call(call);
  mustHold(given == 1 && bytes.compare(0, again.size(), again) == 0,
           "what is given on is what came");
}

struct HandedOver {
  std::string (*empty)();
  void (*hand_over)(std::string bytes);
};

template <class... Messages>
std::vector<HandedOver> listOf() {
  return {{[] { return bytesOf(Messages()); }, handOver<Messages>}...};
}

const std::vector<HandedOver>& allMessages() {
  static const auto all = listOf<
      std_msgs::Bool, std_msgs::Empty, actionlib_msgs::GoalID, actionlib_msgs::GoalStatusArray,
      geometry_msgs::PoseStamped, geometry_msgs::PoseWithCovarianceStamped, geometry_msgs::Twist,
      geometry_msgs::TwistWithCovarianceStamped, map_msgs::OccupancyGridUpdate,
      move_base_msgs::MoveBaseActionGoal, nav_msgs::OccupancyGrid, nav_msgs::Odometry,
      nav_msgs::Path, sensor_msgs::CameraInfo, sensor_msgs::FluidPressure, sensor_msgs::Image,
      sensor_msgs::Imu, sensor_msgs::Joy, sensor_msgs::LaserScan, sensor_msgs::PointCloud2,
      tf2_msgs::TFMessage, NavigatePathActionFeedback, NavigatePathActionGoal,
      NavigatePathActionResult, PlanPathActionFeedback, PlanPathActionGoal, PlanPathActionResult>();
  return all;
}

// Of each kind an empty one, and one whose last length claims 2^32 - 1 elements.
std::vector<std::string> seedsOfHandedOver() {
  std::vector<std::string> seeds;
  for (std::size_t i = 0; i < allMessages().size(); ++i) {
    const std::string begin(1, static_cast<char>(i)), bytes = allMessages()[i].empty();
    seeds.push_back(begin + bytes);
    seeds.push_back(begin + bytes.substr(0, std::max<std::size_t>(bytes.size(), 4) - 4) +
                    "\xff\xff\xff\xff");
  }
  return seeds;
}

FUZZ_TARGET(claimed_lengths, seedsOfHandedOver) {
  if (input.empty()) return;
  const std::size_t kind = static_cast<std::uint8_t>(input.front()) % allMessages().size();
  allMessages()[kind].hand_over(input.substr(1));
}

}  // namespace
}  // namespace grid_path_planner::fuzz
