#include "simulation/sensors/dvl.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/option_laws.h"
#include "support/rocking_drive.h"

namespace grid_path_planner::simulation {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Translation3d, Eigen::Vector2d,
    Eigen::Vector3d;
using test::drive, test::rocking;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kBeamAngle = M_PI / 6;

DvlOptions exactDvl() {
  DvlOptions options;
  options.beam_angle = kBeamAngle;
  options.beam_noise = 0.0;
  options.mounting = {};
  return options;
}

// A floor at z = -10 that is turned by `slope` about y: positive falls away ahead.
World floorOf(double slope, const Vector2d& size = {1000.0, 1000.0},
              const Vector3d& middle = {0.0, 0.0, -10.0}) {
  return World(
      {planeMesh("floor", Vector3d::UnitZ(), size)
           .moved(Isometry3d(Translation3d(middle) * AngleAxisd(slope, Vector3d::UnitY())))});
}

VehicleState moving(double surge, double sway, double heave, double yaw_rate) {
  VehicleState state;
  state.velocity = {surge, sway, heave, yaw_rate};
  return state;
}

DvlReading measureOnce(const World& world, const DvlOptions& options, const VehicleState& state) {
  return Dvl(world, options).measure(state, 0).value();
}

TEST(DvlOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<DvlOptions>();
}

TEST(Dvl, OverALevelFloorItMeasuresVelocityAndAltitude) {
  const auto reading = measureOnce(floorOf(0.0), exactDvl(), moving(0.7, -0.2, 0.1, 0.0));
  ASSERT_TRUE(reading.velocity);
  EXPECT_NEAR((reading.velocity->velocity - Vector3d(0.7, -0.2, 0.1)).norm(), 0.0, 1e-7);
  EXPECT_NEAR(reading.altitude, 10.0, 1e-5);
}

// Over a slope beams ahead and astern are of different lengths, and each still measures its part of the
// velocity. Along a beam the floor n . p = n . q is met at n . q / n . beam.
TEST(Dvl, OverASlopeTheVelocityIsRightAndTheAltitudeIsTheMeanOfItsBeams) {
  const double slope = 0.35;
  const auto reading = measureOnce(floorOf(slope), exactDvl(), moving(0.7, -0.2, 0.1, 0.0));
  ASSERT_TRUE(reading.velocity);
  EXPECT_NEAR((reading.velocity->velocity - Vector3d(0.7, -0.2, 0.1)).norm(), 0.0, 1e-7);
  const Vector3d normal(std::sin(slope), 0.0, std::cos(slope));
  double expected = 0.0;
  for (const double side : {-1.0, 1.0}) {
    const Vector3d beam(side * std::sin(kBeamAngle) * std::sqrt(0.5),
                        std::sin(kBeamAngle) * std::sqrt(0.5), -std::cos(kBeamAngle));
    expected += 0.5 * std::cos(kBeamAngle) * normal.z() * -10.0 / normal.dot(beam);
  }
  EXPECT_NEAR(reading.altitude, expected, 1e-4);
  EXPECT_GT(std::abs(expected - 10.0), 0.1) << "which is another one than over level ground";
}

// What uuv_simulator's leaves out: its DVL repeats the vehicle's true velocity without any bottom.
TEST(Dvl, OverTheEdgeOfTheFloorItLosesBeamsAndThenTheVelocity) {
  // At 10 m the beams meet the floor 4.08 m ahead and astern, and as far to both sides.
  const VehicleState state = moving(0.5, 0.1, 0.0, 0.0);
  const auto over = [&](double ahead, double left) {
    return measureOnce(floorOf(0.0, {200.0, 200.0}, {ahead - 100.0, left - 100.0, -10.0}),
                       exactDvl(), state);
  };
  EXPECT_TRUE(over(5.0, 5.0).velocity) << "four beams";
  const World corner({planeMesh("west", Vector3d::UnitZ(), {100.0, 200.0})
                          .moved(Isometry3d(Translation3d(-50.0, 0.0, -10.0))),
                      planeMesh("north", Vector3d::UnitZ(), {100.0, 100.0})
                          .moved(Isometry3d(Translation3d(50.0, 50.0, -10.0)))});
  const auto three = measureOnce(corner, exactDvl(), state);
  ASSERT_TRUE(three.velocity) << "three beams";
  EXPECT_NEAR((three.velocity->velocity - Vector3d(0.5, 0.1, 0.0)).norm(), 0.0, 1e-7);
  EXPECT_NEAR(three.altitude, 10.0, 1e-5);
  const auto two = over(0.0, 50.0);
  EXPECT_FALSE(two.velocity) << "two beams";
  EXPECT_EQ(two.altitude, kInfinity);
  EXPECT_EQ(over(-50.0, 0.0).altitude, kInfinity) << "no beam";
}

TEST(Dvl, TooNearAndTooFarAreToldApartByTheInfinityOfTheAltitude) {  // REP 117
  DvlOptions options = exactDvl();
  options.range_min = 12.0;
  const auto near = measureOnce(floorOf(0.0), options, {});
  EXPECT_FALSE(near.velocity);
  EXPECT_EQ(near.altitude, -kInfinity);
  options.range_min = 0.7;
  options.range_max = 11.0;
  const auto far = measureOnce(floorOf(0.0), options, {});
  EXPECT_FALSE(far.velocity);
  EXPECT_EQ(far.altitude, kInfinity);
}

// The sensor sweeps sideways as the vehicle turns, and its own axes are those of its mounting.
TEST(Dvl, ALeverArmAndAMountingChangeWhatItMeasuresAsTheyShould) {
  DvlOptions options = exactDvl();
  options.mounting.x = 0.5;
  const auto swept = measureOnce(floorOf(0.0), options, moving(0.0, 0.0, 0.0, 0.4));
  EXPECT_NEAR((swept.velocity->velocity - Vector3d(0.0, 0.2, 0.0)).norm(), 0.0, 1e-7);
  options.mounting = {0.0, 0.0, -0.3, 0.0, 0.0, M_PI / 2};
  const auto turned = measureOnce(floorOf(0.0), options, moving(0.6, 0.0, 0.0, 0.0));
  EXPECT_NEAR((turned.velocity->velocity - Vector3d(0.0, -0.6, 0.0)).norm(), 0.0, 1e-7);
  EXPECT_NEAR(turned.altitude, 9.7, 1e-5);
}

TEST(Dvl, ScaleAndMisalignmentAreErrorsThatNothingTells) {
  DvlOptions options = exactDvl();
  options.scale_error = 0.01;
  options.misalignment = 0.035;
  const auto reading = measureOnce(floorOf(0.0), options, moving(1.0, 0.0, 0.0, 0.0));
  const Vector3d expected = 1.01 * Vector3d(std::cos(0.035), -std::sin(0.035), 0.0);
  EXPECT_NEAR((reading.velocity->velocity - expected).norm(), 0.0, 1e-7);
}

// On any drive, rolled and pitched, it is the velocity of the sensor's own place in its own axes.
TEST(Dvl, OnARockingDriveItMeasuresTheMotionOfItsPlace) {
  DvlOptions options = exactDvl();
  options.rate = 100.0;
  options.mounting = {0.3, 0.2, -0.25, 0.05, 0.1, 0.8};
  Dvl dvl(floorOf(0.1), options);
  VehicleOptions fine = rocking();
  fine.time_step = 0.01;
  Vehicle vehicle(fine);
  Isometry3d before = mapFromBase(vehicle.state()) * options.mounting.pose();
  Vector3d velocity_before = Vector3d::Zero();
  int compared = 0;
  drive(vehicle, 10.0, 5, [&](const Vehicle& v) {
    const Isometry3d pose = mapFromBase(v.state()) * options.mounting.pose();
    const auto reading = dvl.measure(v.state(), v.timeNs());
    if (!reading) return;  // another time than a multiple of 10 ms would be
    const Vector3d velocity = pose.linear() * reading->velocity.value().velocity;
    const Vector3d driven = (pose.translation() - before.translation()) / 0.01;
    if (compared++ > 0) {
      EXPECT_NEAR((0.5 * (velocity + velocity_before) - driven).norm(), 0.0, 1e-3);
    }
    before = pose;
    velocity_before = velocity;
  });
  EXPECT_EQ(compared, 1000);
}

// Four beams of deviation s at 30 degrees: 2 s^2 along x and y, s^2 / 3 along z.
TEST(Dvl, ErrsByTheCovarianceThatItTells) {
  DvlOptions options = exactDvl();
  options.beam_noise = 0.005;
  options.rate = 100.0;
  Dvl dvl(floorOf(0.0), options);
  const Vector3d truth(0.5, 0.0, 0.0);
  Matrix3d sum = Matrix3d::Zero(), told;
  constexpr int kCount = 5000;
  for (std::int64_t i = 0; i < kCount; ++i) {
    const auto reading = dvl.measure(moving(0.5, 0.0, 0.0, 0.0), i * 10000000).value();
    const Vector3d error = reading.velocity->velocity - truth;
    sum += error * error.transpose();
    told = reading.velocity->covariance;
  }
  const Matrix3d expected = 2.5e-5 * Matrix3d(Vector3d(2.0, 2.0, 1.0 / 3.0).asDiagonal());
  EXPECT_NEAR((told - expected).norm() / expected.norm(), 0.0, 1e-5);
  EXPECT_NEAR((sum / kCount - expected).norm() / expected.norm(), 0.0, 0.08);
}

TEST(Dvl, MeasuresAtItsRateAndTheSameBitsForTheSameSeed) {
  DvlOptions options;
  const World world = floorOf(0.2);
  Dvl first(world, options), again(world, options);
  options.seed = 2;
  Dvl other(world, options);
  Vehicle vehicle(rocking());
  int count = 0;
  drive(vehicle, 10.0, 6, [&](const Vehicle& v) {
    const auto reading = first.measure(v.state(), v.timeNs());
    const auto same = again.measure(v.state(), v.timeNs());
    const auto different = other.measure(v.state(), v.timeNs());
    ASSERT_EQ(reading.has_value(), same.has_value());
    if (!reading) return;
    ++count;
    EXPECT_EQ(reading->velocity->velocity, same->velocity->velocity);
    EXPECT_EQ(reading->altitude, same->altitude);
    EXPECT_NE(reading->velocity->velocity, different->velocity->velocity);
  });
  EXPECT_NEAR(count, 70, 1);
}

}  // namespace
}  // namespace grid_path_planner::simulation
