#include "grid_path_planner/simulation/moving_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/simulation/depth_camera.h"
#include "grid_path_planner/simulation/vehicle.h"
#include "support/error_text.h"
#include "support/vehicle_run.h"

namespace grid_path_planner::simulation {
namespace {

using Eigen::Vector3d;
using test::run;

MovingBody walker() {
  return {
      "walker", BodyShape::CYLINDER, {0.3, 0.3, 0.9}, {{1.0, {5, -4, 0.9}}, {9.0, {5, 4, 0.9}}}};
}

TEST(MovingBody, StandsBeforeItsTrackAndAfterItAndMovesEvenlyBetween) {
  const MovingBody body = walker();
  EXPECT_EQ(body.positionAt(-3.0), Vector3d(5, -4, 0.9));
  EXPECT_EQ(body.positionAt(5.0), Vector3d(5, 0, 0.9));
  EXPECT_EQ(body.positionAt(100.0), Vector3d(5, 4, 0.9));
}

TEST(MovingBody, WhatCannotBeIsRefusedByName) {
  MovingBody body = walker();
  body.half_size.x() = 0.0;
  EXPECT_EQ(test::errorText([&] { MovingBodies({body}); }),
            "walker: sizes of a moving body must be above 0 and finite");
  body = walker();
  body.track.clear();
  EXPECT_EQ(test::errorText([&] { MovingBodies({body}); }),
            "walker: a moving body without a position");
  body = walker();
  body.track[1].time = 1.0;
  EXPECT_TRUE(test::contains(test::errorText([&] { MovingBodies({body}); }), "times"));
}

// A solid by its definition alone.
bool isInside(const MovingBody& body, const Vector3d& p) {
  const Vector3d& half = body.half_size;
  switch (body.shape) {
    case BodyShape::SPHERE:
      return p.norm() <= half.x();
    case BodyShape::CYLINDER:
      return std::hypot(p.x(), p.y()) <= half.x() && std::abs(p.z()) <= half.z();
    case BodyShape::BOX:
      break;
  }
  return (p.cwiseAbs() - half).maxCoeff() <= 0.0;
}

// Rays end where walking along them in small steps enters the body; a ball around a point that is as
// large as the distance holds no point of the body, and one a little larger does.
TEST(MovingBodyLaw, RangesAndDistancesAreThoseOfTheSolid) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto vector = [&] { return Vector3d(number(random), number(random), number(random)); };
  int met = 0;
  for (int i = 0; i < 600; ++i) {
    const auto shape = static_cast<BodyShape>(i % 3);
    const Vector3d half = (vector() * 0.4).array() + 0.5, centre = vector();
    const MovingBodies bodies({{"body", shape, half, {{0.0, centre}}}});
    const MovingBody& body = bodies.bodies().front();
    const Vector3d from = centre + 3.0 * vector();
    const Vector3d direction = (centre + 0.8 * vector() - from).normalized();
    double walked = 0.0;
    while (walked < 9.0 && !isInside(body, from + walked * direction - centre)) walked += 1e-3;
    const double range = bodies.at(4.0).range(from, direction);
    if (walked < 9.0) {
      ASSERT_NEAR(range, walked, 1.001e-3) << "case " << i;
      ++met;
    } else if (std::isfinite(range)) {  // less than a step of the body is met
      ASSERT_TRUE(isInside(body, from + (range + 1e-9) * direction - centre) ||
                  isInside(body, from + (range - 1e-9) * direction - centre))
          << "case " << i;
    }
    const auto near = bodies.at(4.0).nearest(from, 100.0);
    ASSERT_TRUE(near);
    EXPECT_NEAR((near->point - from).norm(), near->distance, 1e-12);
    EXPECT_TRUE(isInside(body, centre + (near->point - centre) * (1.0 - 1e-12) - centre));
    for (int j = 0; j < 40; ++j) {
      const Vector3d place = from + vector().normalized() * near->distance * 0.999;
      ASSERT_FALSE(near->distance > 0.0 && isInside(body, place - centre)) << "case " << i;
    }
  }
  EXPECT_GT(met, 300);
}

TEST(MovingBodies, AreSeenByTheCameraWhereTheyAreAtTheTime) {
  DepthCameraOptions options;
  options.noise_base = options.noise_per_m2 = options.dropout = 0.0;
  const World empty((std::vector<TriangleMesh>()));
  const DepthCamera camera(empty, options);
  const MovingBodies bodies(
      {{"ball", BodyShape::SPHERE, {0.5, 0.5, 0.5}, {{0.0, {4, 0, 0}}, {2.0, {8, 0, 0}}}}});
  const std::size_t middle = 3 * (options.width * (options.height / 2) + options.width / 2) + 2;
  std::vector<float> points;
  camera.render(camera.baseFromOptical(), 0, points, bodies.at(1.0));
  EXPECT_NEAR(points[middle], 5.5f, 1e-3f);
  camera.render(camera.baseFromOptical(), 0, points, bodies.at(0.0));
  EXPECT_NEAR(points[middle], 3.5f, 1e-3f);
  camera.render(camera.baseFromOptical(), 0, points);
  EXPECT_TRUE(std::isnan(points[middle]));
}

TEST(MovingBodies, AreFeltOnceWhenTheyCome) {
  Vehicle vehicle({}, {Vector3d(5.0, 0.0, 0.9), 0.0});
  vehicle.setBodies(std::make_shared<const MovingBodies>(std::vector<MovingBody>{walker()}));
  run(vehicle, {}, 4.3);
  EXPECT_EQ(vehicle.contacts(), 0) << "0.1 m away";
  run(vehicle, {}, 5.0);
  EXPECT_EQ(vehicle.contacts(), 1);
  EXPECT_EQ(vehicle.touched(), "walker");
  EXPECT_FALSE(vehicle.inContact()) << "it has gone on";
}

TEST(VehicleResponse, IsFirstOrderInsideTheAccelerations) {
  VehicleOptions options;
  options.response_time = 0.2;
  options.max_acceleration = 1000.0;
  options.time_step = 0.001;
  Vehicle vehicle(options, {});
  for (int i = 0; i < 200; ++i) {
    vehicle.command({1.0, 0.0, 0.0, 0.0});
    vehicle.step();
  }
  EXPECT_NEAR(vehicle.state().velocity.surge, 1.0 - std::exp(-1.0), 1e-9);
  options.max_acceleration = 1.0;
  Vehicle heavy(options, {});
  for (int i = 0; i < 200; ++i) {
    heavy.command({1.0, 0.0, 0.0, 0.0});
    heavy.step();
  }
  EXPECT_NEAR(heavy.state().velocity.surge, 0.2, 1e-9) << "the acceleration limits it";
}

}  // namespace
}  // namespace grid_path_planner::simulation
