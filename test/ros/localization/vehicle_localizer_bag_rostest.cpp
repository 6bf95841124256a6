// A bag of what navigation sensors have done to other localisers, one pain after another, played to vehicle_localizer:
// each is refused with its sentence, and nothing else is.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "localization/measurement_check.h"
#include "ros/support/bag_player.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "ros/support/sensor_script.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using diagnostic_msgs::DiagnosticArray, diagnostic_msgs::DiagnosticStatus;
using geometry_msgs::TwistWithCovarianceStamped;
using localization::Source;
using nav_msgs::Odometry;
using sensor_msgs::Imu;
using test::contains;
using test::Latest;
using test::Pain;
using test::Pains;
using test::timeOf;
using test::TrajectoryMessages;
using test::waitFor;
using Fix = TrajectoryMessages::Fix;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLead = 200, kRound = 50, kRecovery = 100;  // ticks of 10 ms
// A node that is waited for: less than what a stamp may be ahead of its clock.
const ros::Duration kLate(0.8 * localization::kMostAhead);

// kobuki#383, apriltag_ros#122: covariances of nought, which robot_localization mends in silence.
const std::string kZero = "a variance is 0: no sensor is exact";

std::vector<Pain> allPains() {
  std::vector<Pain> all;
  const auto twist = [](TwistWithCovarianceStamped & m) -> auto& {
    return m.twist.covariance;
  };
  const auto pose = [](Fix & m) -> auto& {
    return m.pose.covariance;
  };
  Pains<Imu> imu(all, test::kImu);
  imu.addStampsAndFrame("its frame is nowhere, that of the IMU before imu_link");
  imu.add("-1 first", "it has no angular velocity or no acceleration",
          [](Imu& m) { m.angular_velocity_covariance[0] = -1.0; });
  imu.add("orientation of length 2", "the length of the orientation must be 1, got 2", [](Imu& m) {
    m.orientation.x = 2.0, m.orientation.y = m.orientation.z = m.orientation.w = 0.0;
  });
  imu.add("NaN", "the angular velocity (rad/s) must be within",
          [](Imu& m) { m.angular_velocity.x = kNan; });
  imu.add("infinite", "the acceleration (m/s^2) must be within",
          [](Imu& m) { m.linear_acceleration.z = kInfinity; });
  imu.add("1e308", "the acceleration (m/s^2) must be within",
          [](Imu& m) { m.linear_acceleration.x = 1e308; });
  Pains<TwistWithCovarianceStamped> dvl(all, test::kDvl);
  dvl.addVariances(twist, 0, kZero, "a variance is -1: negative means no measurement");
  dvl.addStampsAndFrame("nothing on /tf names the frame 'nowhere'");
  Pains<Fix> depth(all, test::kDepth);
  depth.addVariances(pose, 14, kZero, "");  // the variance of z counts: -1 elsewhere is not its
  depth.addStampsAndFrame("its frame must be map, got nowhere");
  Pains<Fix> usbl(all, test::kUsbl);
  usbl.addVariances(pose, 7, "", "");
  usbl.addStampsAndFrame("its frame must be map, got nowhere");
  Pains<Fix> marker(all, test::kMarker);
  marker.addVariances(pose, 0, kZero, "a variance is -1: negative means no measurement");
  marker.addStampsAndFrame("its frame must be map, got nowhere");
  return all;
}

// Each has one pain of a sensor at most: the newest reason of an input is that of its pain.
std::vector<std::vector<Pain>> rounds() {
  std::vector<std::vector<Pain>> rounds;
  std::map<Source, std::size_t> count;
  for (const Pain& pain : allPains()) {
    const std::size_t round = count[pain.source]++;
    if (round == rounds.size()) rounds.emplace_back();
    rounds[round].push_back(pain);
  }
  return rounds;
}

// Sensors that are missed, and what is said then.
struct Gap {
  std::string what, sentence;
  std::set<Source> silent;
  int ticks;
};

const std::vector<Gap> kGaps = {
    {"a gap in the IMU", "IMU lost", {Source::IMU}, 80},
    {"no DVL", "DVL lost", {Source::DVL}, 100},
    // rl#871: the state went to 1e200 and back.
    {"nothing at all",
     "IMU lost",
     {Source::IMU, Source::DVL, Source::DEPTH, Source::USBL, Source::MARKER},
     150},
};

struct Stop {
  int tick;
  std::map<Source, int> written;  // until then
};

class VehicleLocalizerBagTest : public testing::Test {
 protected:
  VehicleLocalizerBagTest() {
    test::SensorScript script(file_);
    const auto stop = [&] { stops_.push_back({script.tick(), script.written()}); };
    script.run(kLead);
    stop();
    for (const std::vector<Pain>& pains : rounds_) {
      script.run(kRound, {}, pains);
      stop();
    }
    for (const Gap& gap : kGaps) {
      script.run(gap.ticks, gap.silent);
      gap_ends_.push_back(script.tick());
      script.run(kRecovery);
      stop();
    }
    script.writeRival();
    script.run(kRound);
    end_ = script.tick();
  }

  void SetUp() override {
    player_ = std::make_unique<test::BagPlayer>(nh_, file_);
    begin();
  }

  // What the node says of an input, once it has heard so much of each.
  bool heard(const std::map<Source, int>& written) {
    return waitFor([&] {
      return std::all_of(written.begin(), written.end(), [&](const auto& input) {
        return said(input.first, "received") == std::to_string(input.second);
      });
    });
  }
  // The newest of what is diagnosed under this name.
  DiagnosticStatus diagnosed(const std::string& name) const {
    const std::vector<DiagnosticArray> all = diagnostics_.all();
    for (auto array = all.rbegin(); array != all.rend(); ++array)
      for (const DiagnosticStatus& status : array->status)
        if (status.name == "vehicle_localizer: " + name) return status;
    return {};
  }
  std::string said(Source source, const std::string& key) const {
    for (const auto& value : diagnosed(nameOf(source)).values)
      if (value.key == key) return value.value;
    return "";
  }
  int number(Source source, const std::string& key) const {
    const std::string value = said(source, key);
    return value.empty() ? -1 : std::stoi(value);
  }
  std::string status() const {
    const auto all = statuses_.all();
    return all.empty() ? "" : all.back().data;
  }
  bool hasStatus(const std::string& text) {
    return waitFor([&] { return contains(status(), text); });
  }

  // The node publishes with the clock, once it has begun.
  bool isThere(const ros::Time& now) const {
    const auto all = local_.all();
    if (all.empty() || all.back().header.stamp > now + kLate) return now < timeOf(kLead / 2);
    return now - all.back().header.stamp < kLate;
  }
  bool playTo(int tick) {
    return player_->play(timeOf(tick), [this](const ros::Time& now) { return isThere(now); });
  }

  // Of all estimates since the last call: numbers, and so near the truth.
  void expectNear(double metres) {
    const std::vector<Odometry> all = filtered_.all();
    EXPECT_GT(all.size(), checked_);
    for (; checked_ < all.size(); ++checked_) {
      const Odometry& odometry = all[checked_];
      const auto& p = odometry.pose.pose.position;
      const double t = (odometry.header.stamp - test::kStart).toSec();
      ASSERT_LT((TrajectoryMessages().positionAt(t) - Eigen::Vector3d(p.x, p.y, p.z)).norm(),
                metres)
          << "at " << t << " s";
      for (const double value : odometry.pose.covariance) ASSERT_TRUE(std::isfinite(value));
    }
  }

  // All that was not refused was used, and no more was refused than is known.
  void expectUsed(const Stop& stop, const std::map<Source, int>& refused) {
    const Stop& lead = stops_.front();
    for (const auto& [source, count] : stop.written) {
      const auto found = refused.find(source);
      const int not_used = found == refused.end() ? 0 : found->second;
      EXPECT_EQ(number(source, "refused") - refused_at_first_[source], not_used)
          << nameOf(source) << ": " << said(source, "refused last because");
      EXPECT_EQ(number(source, "taken") - taken_at_first_[source],
                count - lead.written.at(source) - not_used)
          << nameOf(source) << ", of which gated " << said(source, "gated");
    }
  }

  void begin() {
    ASSERT_TRUE(waitFor([&] { return player_->isHeard() && diagnostics_.connected(); }));
    player_->tell(test::kStart);
    ASSERT_TRUE(waitFor([&] { return diagnostics_.count() > 0; })) << "it has the clock";
    ASSERT_TRUE(playTo(kLead));
    ASSERT_TRUE(hasStatus("OK:")) << status();
    ASSERT_TRUE(heard(stops_.front().written));
    for (const auto& [source, count] : stops_.front().written) {
      refused_at_first_[source] = number(source, "refused");
      taken_at_first_[source] = number(source, "taken");
    }
    checked_ = filtered_.count();
  }

  // rl#333, fuse#260: what was recorded with a localiser has its transforms, and is played twice.
  void expectRivalAndFreshStart() {
    ASSERT_TRUE(playTo(end_));
    EXPECT_TRUE(node_.says("No transform is published: " + ros::this_node::getName() +
                           " publishes tf odom -> base_link too"));
    expectNear(0.1);
    const std::size_t begun = statuses_.count();
    const ros::Time last = filtered_.all().back().header.stamp;
    player_->rewind();
    ASSERT_TRUE(playTo(kLead));
    EXPECT_TRUE(node_.says("ROS time went back by"));
    const auto statuses = statuses_.all();
    EXPECT_TRUE(statuses.size() > begun && contains(statuses[begun].data, "INITIALIZING:"));
    EXPECT_TRUE(hasStatus("OK:")) << status();
    EXPECT_TRUE(waitFor([&] { return number(Source::IMU, "taken") <= kLead; }));
    expectNear(0.1);
    EXPECT_LT(filtered_.all().back().header.stamp, last);
  }

  ros::NodeHandle nh_;
  Latest<DiagnosticArray> diagnostics_{nh_, "/diagnostics"};
  Latest<std_msgs::String> statuses_{nh_, "localization_status"};
  Latest<Odometry> filtered_{nh_, "odometry/filtered"}, local_{nh_, "odometry/local"};
  const test::TemporaryFolder folder_;
  const std::string file_ = folder_.path("pains.bag");
  const std::vector<std::vector<Pain>> rounds_ = rounds();
  std::vector<Stop> stops_;  // after the lead, each round, and each gap
  std::vector<int> gap_ends_;
  int end_ = 0;
  std::map<Source, int> refused_at_first_, taken_at_first_;
  std::size_t checked_ = 0;  // estimates
  test::Process node_{"vehicle_localizer",
                      {"_default_usbl_deviation:=0.05", "_input_timeout:=0.5"}};
  std::unique_ptr<test::BagPlayer> player_;
};

TEST_F(VehicleLocalizerBagTest, EachPainIsToldAndWhatFollowsIsUsed) {
  std::map<Source, int> refused;
  for (std::size_t round = 0; round < rounds_.size(); ++round) {
    const Stop& stop = stops_[1 + round];
    ASSERT_TRUE(playTo(stop.tick));
    EXPECT_TRUE(heard(stop.written)) << "round " << round;
    for (const Pain& pain : rounds_[round]) {
      const std::string reason = said(pain.source, "refused last because");
      refused[pain.source] += !pain.sentence.empty();
      EXPECT_TRUE(contains(reason, pain.sentence))
          << nameOf(pain.source) << ", " << pain.what << ": " << reason;
    }
    expectUsed(stop, refused);
    expectNear(0.1);
  }
  for (std::size_t gap = 0; gap < kGaps.size(); ++gap) {
    const auto sentence = [&] { return diagnosed("localization").message; };
    ASSERT_TRUE(playTo(gap_ends_[gap]));
    EXPECT_TRUE(waitFor([&] { return contains(sentence(), kGaps[gap].sentence); }))
        << kGaps[gap].what << ": " << sentence();
    ASSERT_TRUE(playTo(stops_[1 + rounds_.size() + gap].tick));
    EXPECT_TRUE(hasStatus("OK:")) << "after " << kGaps[gap].what << ": " << status();
    expectNear(0.5);
  }
  EXPECT_TRUE(heard(stops_.back().written));
  expectUsed(stops_.back(), refused);
  expectRivalAndFreshStart();
}

}  // namespace
}  // namespace grid_path_planner::nodes
