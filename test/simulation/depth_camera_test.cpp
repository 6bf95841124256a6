#include "grid_path_planner/simulation/depth_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "support/error_text.h"
#include "support/option_laws.h"

namespace grid_path_planner::simulation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

DepthCameraOptions exact() {
  DepthCameraOptions options;
  options.noise_base = options.noise_per_m2 = options.dropout = 0.0;
  return options;
}

// The camera's picture from the vehicle pose.
class Picture {
 public:
  Picture(const World& world, const DepthCameraOptions& options,
          const Isometry3d& vehicle = Isometry3d::Identity(), std::uint64_t frame = 0)
      : options_(options) {
    const DepthCamera camera(world, options);
    camera.render(vehicle * camera.baseFromOptical(), frame, points_);
  }

  std::size_t size() const { return points_.size() / 3; }
  Vector3f at(int column, int row) const { return point(row * options_.width + column); }
  Vector3f middle() const { return at(options_.width / 2, options_.height / 2); }
  Vector3f point(std::size_t pixel) const { return Vector3f(&points_[3 * pixel]); }
  bool measured(std::size_t pixel) const { return !std::isnan(points_[3 * pixel]); }
  std::size_t measuredCount() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < size(); ++i) count += measured(i);
    return count;
  }
  bool operator==(const Picture& other) const {
    return points_.size() == other.points_.size() &&
           std::memcmp(points_.data(), other.points_.data(), 4 * points_.size()) == 0;
  }

 private:
  DepthCameraOptions options_;
  std::vector<float> points_;
};

// A wall across x at `distance` ahead of the origin.
World wallAt(double distance) {
  return World({planeMesh("wall", Vector3d::UnitX(), {1000.0, 1000.0})
                    .moved(Isometry3d(Eigen::Translation3d(distance, 0.0, 0.0)))});
}

TEST(DepthCameraOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<DepthCameraOptions>();
}

TEST(DepthCameraOptions, TheNearestRangeIsBelowTheFarthest) {
  DepthCameraOptions options;
  options.range_min = options.range_max;
  EXPECT_EQ(test::errorText([&] { DepthCamera(World({}), options); }),
            "range_min must be below range_max, got 10 m and 10 m");
}

// One of 8192x8192, by reconfiguring, took gigabytes and held the simulator's end for a minute.
TEST(DepthCameraOptions, APictureHasAtMostFourMillionPixels) {
  DepthCameraOptions options;
  options.width = options.height = 2048;
  EXPECT_NO_THROW(checkDepthCameraOptions(options));
  options.width = 2049;
  EXPECT_EQ(test::errorText([&] { checkDepthCameraOptions(options); }),
            "width times height must be at most 4194304 pixels, got 2049 and 2048");
  options.width = options.height = 8192;
  EXPECT_NE(test::errorText([&] { checkDepthCameraOptions(options); }), "");
}

TEST(DepthCamera, APictureThatNobodyWaitsForIsNotFinished) {
  const DepthCamera camera(wallAt(3.0), exact());
  std::vector<float> points;
  base::StopSource stop;
  EXPECT_NO_THROW(camera.render(camera.baseFromOptical(), 0, points, {}, stop.token()));
  stop.cancel();
  EXPECT_THROW(camera.render(camera.baseFromOptical(), 0, points, {}, stop.token()), base::Stopped);
}

TEST(DepthCamera, AWallAcrossTheViewHasOneDepthAndItsPixelsLieOnThePinholesRays) {
  const DepthCameraOptions options = exact();
  const Picture picture(wallAt(3.0), options);
  const DepthCamera camera(World({}), options);
  const CameraIntrinsics pinhole = camera.intrinsics();
  for (int row = 0; row < options.height; ++row)
    for (int column = 0; column < options.width; ++column) {
      const Vector3f point = picture.at(column, row);
      ASSERT_NEAR(point.z(), 3.0f, 1e-4f);
      ASSERT_NEAR(pinhole.cx + pinhole.fx * point.x() / point.z(), column, 0.01);
      ASSERT_NEAR(pinhole.cy + pinhole.fy * point.y() / point.z(), row, 0.01);
    }
}

TEST(DepthCamera, TheFieldOfViewReachesFromRimToRim) {
  DepthCameraOptions options = exact();
  options.horizontal_fov = 2.0;
  options.range_max = 100.0;
  const Picture picture(wallAt(3.0), options);
  const float pixel = picture.at(1, 0).x() - picture.at(0, 0).x();
  EXPECT_NEAR(picture.at(0, 0).x() - 0.5f * pixel, -3.0 * std::tan(1.0), 0.01);
  EXPECT_NEAR(picture.at(options.width - 1, 0).x() + 0.5f * pixel, 3.0 * std::tan(1.0), 0.01);
}

TEST(DepthCamera, ABallIsSeenWhereItIs) {
  const Vector3d centre(4.0, 0.5, 0.3);
  const World world({sphereMesh("ball", 1.0).moved(Isometry3d(Eigen::Translation3d(centre)))});
  const Picture picture(world, exact());
  const DepthCamera camera(world, exact());
  std::size_t seen = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (!picture.measured(i)) continue;
    ++seen;
    const Vector3d point = camera.baseFromOptical() * picture.point(i).cast<double>();
    ASSERT_NEAR((point - centre).norm(), 1.0, 0.004);
    ASSERT_LT(point.x(), 4.0) << "the far side of the ball";
  }
  // The ball's angular radius has a sine of 1 / 4.04; its ellipse in the picture about this
  // area.
  const double radius = camera.intrinsics().fx * std::tan(std::asin(1.0 / centre.norm()));
  EXPECT_NEAR(static_cast<double>(seen), M_PI * radius * radius, 0.06 * seen);
}

// Left of the vehicle is left in the picture, above is above.
TEST(DepthCamera, PicturesAreNeitherMirroredNorUpsideDown) {
  const World world(
      {boxMesh("box", {0.2, 0.2, 0.2}).moved(Isometry3d(Eigen::Translation3d(3.0, 1.0, 0.7)))});
  const DepthCameraOptions options = exact();
  const Picture picture(world, options);
  ASSERT_GT(picture.measuredCount(), 0u);
  for (int row = 0; row < options.height; ++row)
    for (int column = 0; column < options.width; ++column)
      if (!std::isnan(picture.at(column, row).x())) {
        ASSERT_LT(column, options.width / 2);
        ASSERT_LT(row, options.height / 2);
        ASSERT_LT(picture.at(column, row).x(), 0.0f);
        ASSERT_LT(picture.at(column, row).y(), 0.0f);
      }
}

TEST(DepthCamera, IsMountedOnTheVehicleAndTurnsWithIt) {
  DepthCameraOptions options = exact();
  options.x = 0.5;
  options.z = -0.25;
  options.pitch = M_PI / 2;  // straight down
  Isometry3d vehicle(Eigen::Translation3d(7.0, -2.0, 4.0));
  vehicle.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()));
  const World floor({planeMesh("floor", Vector3d::UnitZ(), {100.0, 100.0})});
  const Picture picture(floor, options, vehicle);
  EXPECT_NEAR(picture.middle().z(), 3.75f, 1e-4f);
  const DepthCamera camera(floor, options);
  const Vector3d seen = vehicle * camera.baseFromOptical() * picture.middle().cast<double>();
  EXPECT_NEAR(seen.x(), 7.0, 0.02);
  EXPECT_NEAR(seen.y(), -1.5, 0.02);
  EXPECT_NEAR(seen.z(), 0.0, 1e-4);
  // The top of the picture is what lies ahead of the vehicle: the map's y.
  const Vector3d top = vehicle * camera.baseFromOptical() * picture.at(160, 0).cast<double>();
  EXPECT_GT(top.y(), 0.0);
}

TEST(DepthCamera, MeasuresOnlyWithinItsRange) {
  EXPECT_GT(Picture(wallAt(0.21), exact()).measuredCount(), 0u);
  EXPECT_EQ(Picture(wallAt(10.01), exact()).measuredCount(), 0u);
  DepthCameraOptions options = exact();
  options.range_min = 1.0;
  const World two({planeMesh("near", Vector3d::UnitX(), {100.0, 100.0})
                       .moved(Isometry3d(Eigen::Translation3d(0.3, 0.0, 0.0))),
                   planeMesh("far", Vector3d::UnitX(), {100.0, 100.0})
                       .moved(Isometry3d(Eigen::Translation3d(5.0, 0.0, 0.0)))});
  EXPECT_EQ(Picture(two, options).measuredCount(), 0u) << "what is too near still hides";
  options.noise_base = 0.5;
  EXPECT_EQ(Picture(two, options).measuredCount(), 0u) << "and noise does not bring it back";
}

TEST(DepthCamera, NoiseGrowsWithTheSquareOfTheRangeAndIsNearlyNormal) {
  DepthCameraOptions options = exact();
  options.horizontal_fov = 0.05;  // all ranges alike
  options.noise_base = 0.01;
  options.noise_per_m2 = 0.002;
  for (const double distance : {0.5, 2.0, 8.0}) {
    const Picture clean(wallAt(distance), [&] {
      DepthCameraOptions without = options;
      without.noise_base = without.noise_per_m2 = 0.0;
      return without;
    }());
    const Picture picture(wallAt(distance), options);
    const double sigma = 0.01 + 0.002 * distance * distance;
    double sum = 0.0, squares = 0.0;
    int within = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const double error = picture.point(i).norm() - clean.point(i).norm();
      ASSERT_LE(std::abs(error), 3.47 * sigma);
      sum += error;
      squares += error * error;
      within += std::abs(error) < sigma;
      ASSERT_LT(picture.point(i).normalized().cross(clean.point(i).normalized()).norm(), 1e-5f)
          << "noise is along the ray";
    }
    const auto count = static_cast<double>(picture.size());
    EXPECT_NEAR(sum / count, 0.0, 4.0 * sigma / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares / count), sigma, 0.015 * sigma);
    EXPECT_NEAR(within / count, 0.683, 0.02);
  }
}

// Noise that repeats from pixel to pixel, or from frame to frame, would be mapped as a surface.
TEST(DepthCamera, NoiseOfNeighboursAndOfFramesIsIndependent) {
  DepthCameraOptions options = exact();
  options.horizontal_fov = 0.05;
  options.noise_base = 0.01;
  const World wall = wallAt(5.0);
  const Picture first(wall, options, Isometry3d::Identity(), 1);
  const Picture second(wall, options, Isometry3d::Identity(), 2);
  double beside = 0.0, below = 0.0, later = 0.0;
  const auto error = [](const Picture& picture, std::size_t i) {
    return (picture.point(i).z() - 5.0) / 0.01;
  };
  const std::size_t count = first.size() - options.width;
  for (std::size_t i = 0; i < count; ++i) {
    beside += error(first, i) * error(first, i + 1);
    below += error(first, i) * error(first, i + options.width);
    later += error(first, i) * error(second, i);
  }
  for (const double correlation : {beside, below, later})
    EXPECT_NEAR(correlation / static_cast<double>(count), 0.0, 0.02);
}

TEST(DepthCamera, DropsOutAsOftenAsAsked) {
  DepthCameraOptions options = exact();
  options.dropout = 0.1;
  const Picture picture(wallAt(3.0), options);
  EXPECT_NEAR(static_cast<double>(picture.measuredCount()) / picture.size(), 0.9, 0.005);
  options.dropout = 1.0;
  EXPECT_EQ(Picture(wallAt(3.0), options).measuredCount(), 0u);
}

TEST(DepthCamera, NoPixelDropsOutAlways) {
  DepthCameraOptions options = exact();
  options.dropout = 0.3;
  const Picture first(wallAt(3.0), options, Isometry3d::Identity(), 1);
  const Picture second(wallAt(3.0), options, Isometry3d::Identity(), 2);
  std::size_t both = 0;
  for (std::size_t i = 0; i < first.size(); ++i) both += !first.measured(i) && !second.measured(i);
  EXPECT_NEAR(static_cast<double>(both) / first.size(), 0.3 * 0.3, 0.01);
}

TEST(DepthCamera, RangesWithNoiseStayInsideTheLimits) {
  DepthCameraOptions options = exact();
  options.noise_base = 0.5;
  for (const double distance : {0.21, 9.5}) {
    const Picture picture(wallAt(distance), options);
    EXPECT_GT(picture.measuredCount(), 0u);
    for (std::size_t i = 0; i < picture.size(); ++i)
      if (picture.measured(i)) {
        ASSERT_GE(picture.point(i).norm(), 0.2f - 1e-6f);
        ASSERT_LE(picture.point(i).norm(), 10.0f + 1e-5f);
      }
  }
}

TEST(DepthCamera, TheSameFrameIsTheSameBitForBitAndOthersDiffer) {
  const World wall = wallAt(3.0);
  DepthCameraOptions options;
  const auto picture = [&](std::uint64_t frame) {
    return Picture(wall, options, Isometry3d::Identity(), frame);
  };
  const Picture first = picture(5);
  EXPECT_FALSE(picture(6) == first);
  EXPECT_TRUE(picture(5) == first);
  options.seed = 2;
  EXPECT_FALSE(picture(5) == first);
}

TEST(DepthCamera, PicturesOfAnySizeAndWorldsOfAnySize) {
  for (const int width : {1, 3, 8, 13}) {
    DepthCameraOptions options = exact();
    options.width = width;
    options.height = 5;
    EXPECT_EQ(Picture(wallAt(3.0), options).measuredCount(), 5u * width);
    EXPECT_EQ(Picture(World({}), options).measuredCount(), 0u);
  }
}

// A closed room: no ray slips out between two triangles.
TEST(DepthCamera, NoRayPassesASeam) {
  DepthCameraOptions options = exact();
  options.horizontal_fov = 1.8;
  options.range_max = 1000.0;
  const World room({sphereMesh("room", 5.0)});
  for (int i = 0; i < 20; ++i) {
    Isometry3d vehicle = Isometry3d::Identity();
    vehicle.rotate(Eigen::AngleAxisd(0.4 * i, Vector3d(1.0, 0.5, 0.1 * i).normalized()));
    const Picture picture(room, options, vehicle);
    ASSERT_EQ(picture.measuredCount(), picture.size());
  }
}

}  // namespace
}  // namespace grid_path_planner::simulation
