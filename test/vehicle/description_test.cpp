// What a description must give, what it refuses with which words, and the ready ones.
#include "vehicle/description.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::vehicle {
namespace {

Description wheels() {
  Description vehicle;
  vehicle.drive = Drive::DIFFERENTIAL;
  vehicle.radius = 0.2;
  vehicle.max_speed = 0.5;
  vehicle.max_yaw_rate = 1.0;
  vehicle.max_acceleration = 1.0;
  vehicle.max_yaw_acceleration = 2.0;
  return vehicle;
}

template <class Change>
std::string refusedFor(Change change) {
  Description vehicle = wheels();
  change(vehicle);
  return test::errorText([&] { checkDescription("robot", vehicle); });
}

TEST(Description, takesWhatIsWhole) {
  EXPECT_EQ("", refusedFor([](Description&) {}));
  EXPECT_EQ("", refusedFor([](Description& v) {
              v.radius = 0.0;
              v.outline = "[[0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2], [0.3, -0.2]]";
            }));
}

TEST(Description, refusesWhatIsMissingByName) {
  const auto missing = [](const char* what) {
    return "robot: " + std::string(what) + " is missing or 0; it has no default";
  };
  EXPECT_EQ("robot: drive is missing: omnidirectional, differential or car",
            refusedFor([](Description& v) { v = Description(); }));
  EXPECT_EQ("robot: an outline is missing: give radius, or outline with its corners",
            refusedFor([](Description& v) { v.radius = 0.0; }));
  EXPECT_EQ(missing("max_speed"), refusedFor([](Description& v) { v.max_speed = 0.0; }));
  EXPECT_EQ(missing("max_yaw_rate"), refusedFor([](Description& v) { v.max_yaw_rate = 0.0; }));
  EXPECT_EQ(missing("max_acceleration"),
            refusedFor([](Description& v) { v.max_acceleration = 0.0; }));
  EXPECT_EQ(missing("max_yaw_acceleration"),
            refusedFor([](Description& v) { v.max_yaw_acceleration = 0.0; }));
  EXPECT_EQ(missing("least_turning_radius"),
            refusedFor([](Description& v) { v.drive = Drive::CAR; }));
}

TEST(Description, refusesWhatContradictsItself) {
  EXPECT_EQ("robot: outline must be convex with its corners anticlockwise, seen from above",
            refusedFor([](Description& v) {
              v.outline = "[[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]";
            }));
  EXPECT_EQ("robot: outline must be convex with its corners anticlockwise, seen from above",
            refusedFor([](Description& v) {
              v.outline = "[[0.3, 0.2], [0.0, 0.1], [-0.3, 0.2], [-0.3, -0.2], [0.3, -0.2]]";
            }));
  EXPECT_EQ("robot: radius 0.2 m and outline disagree, whose corners reach 0.5 m: give one of them",
            refusedFor([](Description& v) {
              v.outline = "[[0.4, 0.3], [-0.4, 0.3], [-0.4, -0.3], [0.4, -0.3]]";
            }));
  EXPECT_EQ(
      "robot: an omnidirectional drive needs max_backward_speed and max_sideways_speed above 0",
      refusedFor([](Description& v) { v.drive = Drive::OMNIDIRECTIONAL; }));
  EXPECT_EQ("robot: least_turning_radius is of a car; this drive turns on the spot",
            refusedFor([](Description& v) { v.least_turning_radius = 1.0; }));
  EXPECT_EQ("robot: max_sideways_speed is of an omnidirectional drive; this one cannot",
            refusedFor([](Description& v) { v.max_sideways_speed = 0.1; }));
}

TEST(Description, refusesNumbersOutsideTheirLimits) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE("", refusedFor([&](Description& v) { v.radius = nan; }));
  EXPECT_NE("", refusedFor([&](Description& v) { v.max_speed = nan; }));
  EXPECT_NE("", refusedFor([&](Description& v) { v.max_speed = -1.0; }));
  EXPECT_NE("", refusedFor([&](Description& v) { v.dead_time = -0.1; }));
  EXPECT_NE("", refusedFor([&](Description& v) { v.drift = 1e9; }));
}

class DescriptionFile : public ::testing::Test {
 protected:
  std::string errorOf(const std::string& text) {
    file_ = folder_.write("robot.yaml", text);
    return test::errorText([&] { readDescription(file_); });
  }

  test::TemporaryFolder folder_;
  std::string file_;
};

TEST_F(DescriptionFile, isReadWithCornersAsAList) {
  EXPECT_EQ("", errorOf("vehicle:\n  drive: car\n  outline: [[1, 0.5], [-1, 0.5], [-1, -0.5], [1, "
                        "-0.5]]\n  max_speed: 2\n  max_yaw_rate: 1\n  max_acceleration: 1\n"
                        "  max_yaw_acceleration: 2\n  least_turning_radius: 1.5\n"));
  const Description vehicle = readDescription(file_);
  EXPECT_EQ(Drive::CAR, vehicle.drive);
  EXPECT_DOUBLE_EQ(0.5, outlineOf(vehicle).inscribedRadius());
  EXPECT_DOUBLE_EQ(std::hypot(1.0, 0.5), outlineOf(vehicle).circumscribedRadius());
}

TEST_F(DescriptionFile, namesFileAndLineOfWhatIsWrong) {
  EXPECT_EQ(file_ + ":3: drive must be one of omnidirectional, differential, car, got 'tracks'",
            errorOf("vehicle:\n  radius: 0.2\n  drive: tracks\n"));
  EXPECT_NE(std::string::npos, errorOf("vehicle:\n  radios: 0.2\n").find("radios"));
  EXPECT_NE(std::string::npos, errorOf("robot: {radius: 0.2}\n").find("vehicle"));
}

TEST(ReadyDescriptions, areWhole) {
  int number = 0;
  for (const auto& entry : std::filesystem::directory_iterator("config/vehicles")) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_NO_THROW(readDescription(entry.path().string()));
    ++number;
  }
  EXPECT_EQ(5, number);
}

}  // namespace
}  // namespace grid_path_planner::vehicle
