// A bag of navigation sensors as `grid_path localization` reads it. What bags of any topics do to the reader of bags is
// asked of bag_file.
#include "ros/localization/navigation_bag.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>
#include <map>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"

namespace grid_path_planner::fuzz {
namespace {

// A bag with one chunk and no text of definitions, which the reader passes over: short, so that its messages are what
// is changed.
class SmallBag {
 public:
  template <class Message>
  void add(const std::string& topic, const ros::Time& received, const Message& message) {
    const auto [connection, is_new] = ids_.emplace(topic, static_cast<std::uint32_t>(ids_.size()));
    if (is_new) {
      const std::string head =
          field("op", "\x07") + field("conn", bytes(connection->second)) + field("topic", topic);
      const std::string data =
          field("topic", topic) + field("type", ros::message_traits::datatype<Message>()) +
          field("md5sum", ros::message_traits::md5sum<Message>()) + field("message_definition", "");
      connections_ += record(head, data);
    }
    messages_ += record(field("op", "\x02") + field("conn", bytes(connection->second)) +
                            field("time", bytes(received.sec) + bytes(received.nsec)),
                        bytesOf(message));
  }

  std::string file() const {
    std::string end;
    for (const auto& connection : ids_)
      end += record(field("op", "\x04") + field("ver", bytes(1)) +
                        field("conn", bytes(connection.second)) + field("count", bytes(0)),
                    "");
    return "#ROSBAG V2.0\n" +
           record(field("op", "\x03") + field("index_pos", bytes(1) + bytes(0)) +
                      field("conn_count", bytes(static_cast<std::uint32_t>(ids_.size()))) +
                      field("chunk_count", bytes(1)),
                  "") +
           record(field("op", "\x05") + field("compression", "none") +
                      field("size", bytes(static_cast<std::uint32_t>(messages_.size()))),
                  messages_) +
           end + connections_ + record(field("op", "\x06") + field("ver", bytes(1)), "");
  }

 private:
  static std::string bytes(std::uint32_t number) {
    std::string text(sizeof number, '\0');
    std::memcpy(text.data(), &number, sizeof number);
    return text;
  }
  static std::string block(const std::string& text) {
    return bytes(static_cast<std::uint32_t>(text.size())) + text;
  }
  static std::string field(const std::string& name, const std::string& value) {
    return block(name + "=" + value);
  }
  static std::string record(const std::string& head, const std::string& data) {
    return block(head) + block(data);
  }

  std::map<std::string, std::uint32_t> ids_;
  std::string connections_, messages_;
};

template <class Message>
Message stampedAt(const ros::Time& time, const std::string& frame) {
  Message message;
  message.header.stamp = time;
  message.header.frame_id = frame;
  return message;
}

nodes::NavigationQuestion questionOfBag() {
  nodes::NavigationQuestion question;
  question.topics = {"imu", "dvl", "depth", "pressure", "usbl", "marker", "truth"};
  question.frames = {{"imu", {}}, {"dvl", {}}, {"usbl_link", {}}, {"pressure_link", {}}};
  return question;
}

void addRound(SmallBag& bag, const ros::Time& time) {
  auto imu = stampedAt<sensor_msgs::Imu>(time, "imu");
  imu.orientation.w = 1.0;
  imu.linear_acceleration.z = 9.81;
  bag.add("imu", time, imu);
  auto fix = stampedAt<geometry_msgs::PoseWithCovarianceStamped>(time, "map");
  fix.pose.pose.orientation.w = 1.0;
  for (std::size_t i = 0; i < 36; i += 7) fix.pose.covariance[i] = 0.01;
  bag.add("marker", time, fix);
}

std::string bagOfFixes() {
  SmallBag bag;
  addRound(bag, ros::Time(1000, 0));
  addRound(bag, ros::Time(1000, 10'000'000));
  return bag.file();
}

std::string bagOfSpeeds() {
  SmallBag bag;
  const ros::Time time(1000, 0);
  tf2_msgs::TFMessage tf;
  tf.transforms.resize(1);
  tf.transforms[0] = stampedAt<geometry_msgs::TransformStamped>(time, "map");
  tf.transforms[0].child_frame_id = "base_link";
  tf.transforms[0].transform.rotation.w = 1.0;
  bag.add("tf_static", time, tf);
  auto imu = stampedAt<sensor_msgs::Imu>(time, "imu");
  imu.orientation.w = 1.0;
  bag.add("imu", time, imu);
  auto dvl = stampedAt<geometry_msgs::TwistWithCovarianceStamped>(time, "dvl");
  for (std::size_t i = 0; i < 36; i += 7) dvl.twist.covariance[i] = 0.01;
  bag.add("dvl", time, dvl);
  auto odometry = stampedAt<nav_msgs::Odometry>(time, "map");
  odometry.pose.pose.orientation.w = 1.0;
  bag.add("truth", time, odometry);
  return bag.file();
}

std::vector<std::string> seedsOfNavigationBags() {
  return {bagOfFixes(), bagOfSpeeds()};
}

FUZZ_TARGET(navigation_bag, seedsOfNavigationBags) {
  static const nodes::NavigationQuestion question = questionOfBag();
  const std::string file = fileOf("fuzz_navigation.bag", input);
  mayRefuse([&] {
    const auto recording = nodes::readNavigationBag(file, question, smallLimits());
    for (std::size_t i = 1; i < recording.measurements.size(); ++i)
      mustHold(recording.measurements[i - 1].arrives <= recording.measurements[i].arrives,
               "measurements come one after the other");
    for (std::size_t i = 1; i < recording.truth.size(); ++i)
      mustHold(recording.truth[i - 1].stamp < recording.truth[i].stamp, "so does the truth");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
