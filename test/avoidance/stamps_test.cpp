// Stamps of frames that lie, and flights that last.
//
// What was seen before: a first frame stamped 0 made all later ones "too late" until the node was started
// anew, and so did 23 days; one that was stamped ahead stayed new for longer than cloud_timeout, one of 2001
// for ever.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "avoidance/simulated_flight.h"

namespace grid_path_planner::avoidance {
namespace {

constexpr float kEmpty = std::numeric_limits<float>::quiet_NaN();

// The sky: no pixel measured anything.
Frame skyAt(double time) {
  Frame frame;
  frame.time = time;
  frame.width = 80;
  frame.height = 60;
  frame.points.assign(3 * frame.pixels(), kEmpty);
  frame.pinhole = Pinhole{52.6, 52.6, 40.0, 30.0};
  frame.map_from_sensor.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  frame.map_from_sensor.translation().z() = 1.5;
  return frame;
}

class Stamps : public testing::Test {
 protected:
  Stamps() { pilot_.setRoute({{20.0, 0.0, 1.5}}); }

  PilotAnswer update(double time) {
    PilotInput input;
    input.time = time;
    input.pose = VehiclePose{{0.0, 0.0, 1.5}, 0.0};
    return pilot_.update(input);
  }
  PilotAnswer update(double time, double stamp) {
    const Frame frame = skyAt(stamp);
    PilotInput input;
    input.time = time;
    input.pose = VehiclePose{{0.0, 0.0, 1.5}, 0.0};
    input.frame = &frame;
    return pilot_.update(input);
  }

  Pilot pilot_{flyingOptions()};
};

TEST_F(Stamps, AFirstFrameStampedZeroIsRefusedAndBlindsNobody) {
  EXPECT_EQ(update(1e9, 0.0).status, PilotStatus::NO_CLOUD);
  EXPECT_EQ(update(1e9 + 0.1, 1e9 + 0.1).status, PilotStatus::FLYING);
}

TEST_F(Stamps, FramesAreTakenAfterAMonth) {
  EXPECT_EQ(update(100.0, 100.0).status, PilotStatus::FLYING);
  EXPECT_EQ(update(2.6e6).status, PilotStatus::NO_CLOUD);
  EXPECT_EQ(update(2.6e6 + 0.1, 2.6e6 + 0.1).status, PilotStatus::FLYING);
}

TEST_F(Stamps, AFrameStampedAheadAgesAsOneOfNow) {
  EXPECT_EQ(update(10.0, 10.45).status, PilotStatus::FLYING);
  EXPECT_EQ(update(10.35).status, PilotStatus::FLYING);
  EXPECT_EQ(update(10.45).status, PilotStatus::NO_CLOUD);
  EXPECT_EQ(update(10.5, 10.48).status, PilotStatus::FLYING) << "and the next one is no older";
}

TEST_F(Stamps, AFrameOfTheFutureSeenBesidesIsRefused) {
  EXPECT_EQ(update(10.0, 10.0).status, PilotStatus::FLYING);
  pilot_.see(skyAt(1e9));
  EXPECT_EQ(update(10.6).status, PilotStatus::NO_CLOUD);
}

TEST_F(Stamps, AFrameOfTheFutureSeenBeforeTheFirstUpdateIsForgotten) {
  pilot_.see(skyAt(1e9));
  EXPECT_EQ(update(10.0).status, PilotStatus::NO_CLOUD);
  EXPECT_EQ(update(10.1, 10.1).status, PilotStatus::FLYING);
}

// The band of heights in which points count lies about the sensor until a pose came, not about 0.
TEST_F(Stamps, ThePointsOfAFirstFrameAtAnyHeightAreRemembered) {
  PilotOptions options = flyingOptions();
  options.z_max = 100.0;
  options.band_below = options.band_above = 2.0;
  Pilot pilot(options);
  Frame frame = skyAt(1.0);
  frame.map_from_sensor.translation().z() = 50.0;
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel) {
    float* point = &frame.points[3 * pixel];
    point[0] = static_cast<float>((static_cast<double>(pixel % 80) - 40.0) / 52.6 * 3.0);
    point[1] = static_cast<float>((static_cast<double>(pixel / 80) - 30.0) / 52.6 * 3.0);
    point[2] = 3.0F;
  }
  pilot.see(frame);
  EXPECT_FALSE(pilot.rememberedPoints().empty());
}

TEST_F(Stamps, AFrameOfTooManyPixelsIsRefused) {
  Frame frame = skyAt(1.0);
  frame.width = 1 << 12;
  frame.height = 1 + (1 << 10);
  frame.points.assign(3 * frame.pixels(), kEmpty);
  PilotInput input;
  input.time = 1.0;
  input.pose = VehiclePose{{0.0, 0.0, 1.5}, 0.0};
  input.frame = &frame;
  const PilotAnswer answer = pilot_.update(input);
  EXPECT_EQ(answer.status, PilotStatus::NO_CLOUD);
  EXPECT_NE(answer.sentence.find("more than 4194304"), std::string::npos) << answer.sentence;
}

}  // namespace
}  // namespace grid_path_planner::avoidance
