// A bag of navigation sensors, some of whose messages are spoilt: for rostests.
//
//   SensorScript script(file);
//   script.run(200);                              // ticks of 10 ms
//   script.run(50, {Source::DVL}, {pain});        // no DVL, and one message that is spoilt
#pragma once

#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "localization/measurement.h"
#include "ros/support/trajectory_messages.h"

namespace grid_path_planner::test {

using localization::Source;

inline const ros::Time kStart(100);
inline const ros::Duration kAside(0.005);  // between two ticks

inline ros::Time timeOf(int tick) {
  return kStart + ros::Duration(0.01 * tick);
}

template <class Message>
struct Sensor {
  using Say = Message (TrajectoryMessages::*)(const ros::Time&, double) const;
  Source source;
  const char* topic;
  int period;  // ticks
  Say say;

  Message at(const ros::Time& stamp) const {
    return (TrajectoryMessages().*say)(stamp, (stamp - kStart).toSec());
  }
};

inline const Sensor<sensor_msgs::Imu> kImu{Source::IMU, "imu/data", 1, &TrajectoryMessages::imu};
inline const Sensor<geometry_msgs::TwistWithCovarianceStamped> kDvl{Source::DVL, "dvl/twist", 14,
                                                                    &TrajectoryMessages::dvl};
inline const Sensor<TrajectoryMessages::Fix> kDepth{Source::DEPTH, "depth", 10,
                                                    &TrajectoryMessages::depth};
inline const Sensor<TrajectoryMessages::Fix> kUsbl{Source::USBL, "usbl/pose", 20,
                                                   &TrajectoryMessages::usbl};
inline const Sensor<TrajectoryMessages::Fix> kMarker{Source::MARKER, "marker_pose", 20,
                                                     &TrajectoryMessages::marker};

// One message of a sensor, half a tick after a good one.
struct Pain {
  Source source;
  int period;
  std::string what, sentence;  // no sentence: it is used
  std::function<void(rosbag::Bag&, const ros::Time&)> write;
};

template <class Message>
class Pains {
 public:
  Pains(std::vector<Pain>& all, const Sensor<Message>& sensor) : all_(all), sensor_(sensor) {}

  void add(const std::string& what, const std::string& sentence,
           const std::function<void(Message&)>& spoil) {
    all_.push_back({sensor_.source, sensor_.period, what, sentence,
                    [sensor = sensor_, spoil](rosbag::Bag& bag, const ros::Time& time) {
                      Message message = sensor.at(time);
                      spoil(message);
                      bag.write(sensor.topic, time, message);
                    }});
  }
  void addStampsAndFrame(const std::string& frame_sentence) {
    add("stamp twice", "one of the same stamp was used already",
        [](Message& m) { m.header.stamp -= kAside; });
    add("in the future", "s ahead of ROS time, more than 0.1 s", [](Message& m) {
      m.header.stamp += {60, 0};
    });
    add("older than the history", "s old, more than 5 s", [](Message& m) {
      m.header.stamp -= {6, 0};
    });
    add("unknown frame", frame_sentence, [](Message& m) { m.header.frame_id = "nowhere"; });
  }
  // `variances` gives those of a message; `zero` is what is said of one that has none.
  template <class Variances>
  void addVariances(const Variances& variances, std::size_t index, const std::string& zero,
                    const std::string& minus_one) {
    const auto set = [&](const std::string& what, double value, const std::string& sentence) {
      add("a variance is " + what, sentence, [=](Message& m) { variances(m)[index] = value; });
    };
    set("NaN", std::numeric_limits<double>::quiet_NaN(), "a variance is not finite: nan");
    set("infinite", std::numeric_limits<double>::infinity(), "a variance is not finite: inf");
    set("1e308", 1e308, "a variance must be within 1e-12..1e12");
    set("negative", -0.01, "a variance is -0.01: negative means no measurement");
    add("all variances are 0", zero, [=](Message& m) { variances(m).fill(0.0); });
    add("-1 first", minus_one, [=](Message& m) { variances(m)[0] = -1.0; });
  }

 private:
  std::vector<Pain>& all_;
  const Sensor<Message>& sensor_;
};

// Writes a bag tick by tick, and knows how much of each sensor is in it.
class SensorScript {
 public:
  explicit SensorScript(const std::string& file) : bag_(file, rosbag::bagmode::Write) {}
  ~SensorScript() { bag_.close(); }

  int tick() const { return tick_; }
  const std::map<Source, int>& written() const { return written_; }

  void run(int ticks, const std::set<Source>& silent = {}, std::vector<Pain> pains = {}) {
    for (const int end = tick_ + ticks; tick_ < end; ++tick_) {
      const ros::Time now = timeOf(tick_);
      if (tick_ % 5 == 0) bag_.write("/tf", now, frames(now));
      send(kImu, silent);
      send(kDvl, silent);
      send(kDepth, silent);
      send(kUsbl, silent);
      send(kMarker, silent);
      pains.erase(std::remove_if(pains.begin(), pains.end(),
                                 [&](const Pain& pain) { return isWritten(pain); }),
                  pains.end());
    }
  }
  // What a bag has that was recorded while a localiser ran.
  void writeRival() {
    tf2_msgs::TFMessage message = frames(timeOf(tick_));
    message.transforms.resize(1);
    message.transforms[0].header.frame_id = "odom";
    message.transforms[0].child_frame_id = "base_link";
    bag_.write("/tf", timeOf(tick_), message);
  }

 private:
  static tf2_msgs::TFMessage frames(const ros::Time& stamp) {
    tf2_msgs::TFMessage message;
    message.transforms = TrajectoryMessages().frames(stamp);
    return message;
  }
  template <class Message>
  void send(const Sensor<Message>& sensor, const std::set<Source>& silent) {
    if (tick_ % sensor.period != 0 || silent.count(sensor.source) > 0) return;
    bag_.write(sensor.topic, timeOf(tick_), sensor.at(timeOf(tick_)));
    ++written_[sensor.source];
  }
  bool isWritten(const Pain& pain) {
    if (tick_ % pain.period != 0) return false;
    pain.write(bag_, timeOf(tick_) + kAside);
    ++written_[pain.source];
    return true;
  }

  rosbag::Bag bag_;
  int tick_ = 0;
  std::map<Source, int> written_;
};

}  // namespace grid_path_planner::test
