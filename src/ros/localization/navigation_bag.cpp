#include "ros/localization/navigation_bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "localization/measurement_check.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/input/frame_lookup.h"
#include "ros/localization/sensor_messages.h"
#include "ros/messages/bag_reader.h"

namespace grid_path_planner::nodes {

using base::InputError, base::ReadLimits;
using geometry_msgs::PoseWithCovarianceStamped;
using localization::HeardInput, localization::Measurement, localization::NavigationRecording,
    localization::PoseFix, localization::Source, localization::Stamp;

namespace {

constexpr std::size_t kBytesOfStamp = 64;  // of a set, to find the second of its stamp
constexpr Stamp kMostDisorder =
    1'000'000'000;  // ns; what is received at once may be written out of order

std::string withoutSlash(const std::string& topic) {
  return !topic.empty() && topic.front() == '/' ? topic.substr(1) : topic;
}

std::string secondsText(Stamp stamp) {
  return std::to_string(1e-9 * static_cast<double>(stamp));
}

class NavigationBag {
 public:
  NavigationBag(const std::string& file, const NavigationQuestion& question, ReadLimits& limits)
      : file_(file),
        question_(question),
        limits_(limits),
        bag_(file, limits),
        messages_([this](const auto& to, const auto& from) { return placed(to, from); },
                  question.options) {}

  NavigationRecording read() {
    placeFrames();
    readStaticTransforms();
    listenToSensors();
    listenToTruth();
    std::set<std::uint32_t> ids;
    for (const auto& reader : readers_) ids.insert(reader.first);
    bag_.visit(ids, [this](const BagMessage& message) {
      refuseOtherTime(message);
      readers_.at(message.connection)(message);
      return true;
    });
    std::stable_sort(recording_.measurements.begin(), recording_.measurements.end(),
                     [](const auto& a, const auto& b) { return a.arrives < b.arrives; });
    return std::move(recording_);
  }

 private:
  using Reader = std::function<void(const BagMessage&)>;

  Eigen::Isometry3d placed(const std::string& target, const std::string& source) const {
    return isometryOf(transforms_.lookupTransform(target, source, ros::Time(0)).transform);
  }

  void placeFrames() {
    for (const auto& [name, place] : question_.frames) {
      geometry_msgs::TransformStamped transform;
      transform.header.frame_id = question_.options.base_frame;
      transform.child_frame_id = frameName(name);
      geometry_msgs::Transform& to = transform.transform;
      to.translation.x = place.position.x();
      to.translation.y = place.position.y();
      to.translation.z = place.position.z();
      to.rotation.w = place.rotation.w();
      to.rotation.x = place.rotation.x();
      to.rotation.y = place.rotation.y();
      to.rotation.z = place.rotation.z();
      transforms_.setTransform(transform, "the trial", true);
    }
  }

  // Of frames whose place the question does not tell.
  void insert(const tf2_msgs::TFMessage& message, Stamp received, bool is_static) {
    for (const geometry_msgs::TransformStamped& transform : message.transforms)
      if (question_.frames.count(frameName(transform.child_frame_id)) == 0)
        insertTransform(transforms_, transform_stamps_, transform, "the bag", is_static,
                        timeOf(received));
  }

  // They count from the begin: who publishes them may have been heard late.
  void readStaticTransforms() {
    const auto ids = connectionsOf<tf2_msgs::TFMessage>("tf_static");
    bag_.visit(ids, [this](const BagMessage& message) {
      insert(messageFromBytes<tf2_msgs::TFMessage>(message.bytes), message.received, true);
      return true;
    });
    for (const std::uint32_t id : connectionsOf<tf2_msgs::TFMessage>("tf"))
      readers_[id] = [this](const BagMessage& message) {
        insert(messageFromBytes<tf2_msgs::TFMessage>(message.bytes), message.received, false);
        takeTruthOfTransforms();
      };
  }

  // Throws where the topic has messages of another type.
  template <class Message>
  std::set<std::uint32_t> connectionsOf(const std::string& topic) const {
    const std::string type = ros::message_traits::datatype<Message>();
    std::set<std::uint32_t> ids;
    for (const BagConnection& connection : bag_.connections()) {
      if (withoutSlash(connection.topic) != withoutSlash(topic)) continue;
      if (connection.type != type)
        throw InputError(file_, connection.topic + " is " + connection.type + ", not " + type);
      if (connection.md5_sum != ros::message_traits::md5sum<Message>())
        throw InputError(file_, connection.topic + " is another version of " + type);
      ids.insert(connection.id);
    }
    return ids;
  }

  bool isAskedFor(const std::string& topic) const {
    const localization::NavigationTopics& topics = question_.topics;
    for (const std::string& name : {topics.imu, topics.dvl, topics.depth, topics.pressure,
                                    topics.usbl, topics.marker, topics.truth})
      if (withoutSlash(topic) == withoutSlash(name)) return true;
    return false;
  }

  // Why there is nothing of a type on a topic, with the other topics on which there is.
  template <class Message>
  std::string absence() const {
    const std::string type = ros::message_traits::datatype<Message>();
    std::set<std::string> others;
    for (const BagConnection& connection : bag_.connections())
      if (connection.type == type && !isAskedFor(connection.topic)) others.insert(connection.topic);
    std::string list;
    for (const std::string& topic : others) list += (list.empty() ? "" : ", ") + topic;
    return "the bag has no such topic" + (list.empty() ? "" : "; " + type + " is on " + list);
  }

  // `take` makes measurements of a message; what it throws is a refusal.
  template <class Message, class Take>
  void listen(HeardInput& input, const std::string& topic, const Take& take) {
    input.topic = topic;
    const auto ids = connectionsOf<Message>(topic);
    if (ids.empty()) input.reason = absence<Message>();
    for (const std::uint32_t id : ids)
      readers_[id] = [this, &input, take](const BagMessage& message) {
        limits_.take(file_, sizeof(localization::HeardMeasurement) + kBytesOfStamp);
        ++input.heard;
        try {
          take(messageFromBytes<Message>(message.bytes), message.received);
        } catch (const std::runtime_error& error) {
          ++input.refused;
          input.reason = error.what();
        }
      };
  }

  template <class Message>
  void listenTo(Source source, const std::string& topic,
                Measurement (SensorMessages::*convert)(const Message&) const) {
    listen<Message>(recording_.inputs[source], topic,
                    [this, convert](const Message& message, Stamp received) {
                      add((messages_.*convert)(message), received);
                    });
  }

  void listenToSensors() {
    const localization::NavigationTopics& topics = question_.topics;
    listen<sensor_msgs::Imu>(recording_.inputs[Source::IMU], topics.imu,
                             [this](const sensor_msgs::Imu& message, Stamp received) {
                               add(messages_.imu(message), received);
                               messages_.keep(message);
                               recording_.base = messages_.base();
                               addHeading(message, received);
                             });
    listenTo(Source::DVL, topics.dvl, &SensorMessages::dvl);
    if (question_.options.use_pressure)
      listenTo(Source::DEPTH, topics.pressure, &SensorMessages::pressure);
    else
      listenTo(Source::DEPTH, topics.depth, &SensorMessages::depth);
    listenTo(Source::USBL, topics.usbl, &SensorMessages::usbl);
    listenTo(Source::MARKER, topics.marker, &SensorMessages::marker);
  }

  void add(const Measurement& measurement, Stamp received) {
    localization::checkMeasurement(measurement, question_.options.localizer.filter);
    localization::checkStamp(measurement.stamp, received,
                             question_.options.localizer.filter.history);
    if (!stamps_[static_cast<std::size_t>(measurement.source)].insert(measurement.stamp).second)
      throw InputError("there is one of this stamp already");
    const Stamp arrives = measurement.source == Source::USBL ? std::max(received, measurement.stamp)
                                                             : measurement.stamp;
    recording_.measurements.push_back({arrives, measurement});
  }

  // Of an IMU that has an orientation; what it is for is told by each row.
  void addHeading(const sensor_msgs::Imu& message, Stamp received) {
    HeardInput& input = recording_.inputs[Source::HEADING];
    input.topic = question_.topics.imu + ": orientation";
    const auto heading = messages_.heading(message);
    if (!heading) {
      input.reason = "the IMU's messages have no orientation";
      return;
    }
    ++input.heard;
    add(*heading, received);
  }

  void listenToTruth() {
    HeardInput& input = recording_.truth_input;
    if (!question_.truth_frame.empty()) {
      input.topic = "tf: " + question_.truth_frame;
      input.reason = "tf has no such frame in " + question_.options.map_frame;
      return;
    }
    for (const BagConnection& connection : bag_.connections())
      if (withoutSlash(connection.topic) == withoutSlash(question_.topics.truth) &&
          connection.type == ros::message_traits::datatype<geometry_msgs::PoseStamped>())
        return listen<geometry_msgs::PoseStamped>(
            input, question_.topics.truth,
            [this](const geometry_msgs::PoseStamped& message, Stamp) {
              takeTruth(message.header, message.pose);
            });
    listen<nav_msgs::Odometry>(
        input, question_.topics.truth, [this](const nav_msgs::Odometry& message, Stamp) {
          const std::string child = frameName(message.child_frame_id);
          if (!child.empty() && child != question_.options.base_frame)
            throw InputError("its child_frame_id must be " + question_.options.base_frame +
                             ", got " + child);
          takeTruth(message.header, message.pose.pose);
        });
  }

  // The checks are those of a marker pose.
  void takeTruth(const std_msgs::Header& header, const geometry_msgs::Pose& pose) {
    PoseWithCovarianceStamped message;
    message.header = header;
    message.pose.pose = pose;
    for (std::size_t i = 0; i < 36; i += 7) message.pose.covariance[i] = 1.0;
    const Measurement measurement = messages_.marker(message);
    localization::checkMeasurement(measurement, question_.options.localizer.filter);
    auto& truth = recording_.truth;
    if (!truth.empty() && measurement.stamp <= truth.back().stamp)
      throw InputError("it is not newer than the one before");
    const auto& fix = std::get<PoseFix>(measurement.data);
    const auto body = carried({fix.position, fix.attitude, fix.covariance}, inverse(fix.mounting));
    truth.push_back({measurement.stamp, body.position, body.attitude});
  }

  void takeTruthOfTransforms() {
    if (question_.truth_frame.empty()) return;
    HeardInput& input = recording_.truth_input;
    const std::string& map = question_.options.map_frame;
    try {
      const auto found = transforms_.lookupTransform(map, frameName(question_.truth_frame), {});
      const Stamp stamp = nodes::stampOf(found.header.stamp);
      if (!recording_.truth.empty() && stamp <= recording_.truth.back().stamp) return;
      limits_.take(file_, sizeof(localization::TruePose));
      ++input.heard;
      geometry_msgs::Pose pose;
      pose.position.x = found.transform.translation.x;
      pose.position.y = found.transform.translation.y;
      pose.position.z = found.transform.translation.z;
      pose.orientation = found.transform.rotation;
      takeTruth(found.header, pose);
    } catch (const std::runtime_error& error) {
      input.refused = input.heard - recording_.truth.size();
      input.reason = error.what();
    }
  }

  // Two recordings in one bag would be one dive with a jump.
  void refuseOtherTime(const BagMessage& message) {
    if (message.received < newest_ - kMostDisorder)
      throw InputError(file_, "goes back in time, from " + secondsText(newest_) + " to " +
                                  secondsText(message.received) +
                                  " s: it holds two recordings, of which `rosbag filter` takes "
                                  "one, or is not in order");
    newest_ = std::max(newest_, message.received);
  }

  const std::string& file_;
  const NavigationQuestion& question_;
  ReadLimits& limits_;
  const BagReader bag_;
  tf2::BufferCore transforms_;
  TransformStamps transform_stamps_;
  SensorMessages messages_;
  std::map<std::uint32_t, Reader> readers_;  // by connection
  std::array<std::set<Stamp>, localization::kSources> stamps_;
  Stamp newest_ = 0;
  NavigationRecording recording_;
};

}  // namespace

NavigationRecording readNavigationBag(const std::string& file, const NavigationQuestion& question,
                                      const ReadLimits& limits) {
  return base::readWithin(file, limits, [&](ReadLimits& within) {
    NavigationQuestion asked = question;
    asked.options.use_heading = true;
    return NavigationBag(file, asked, within).read();
  });
}

}  // namespace grid_path_planner::nodes
