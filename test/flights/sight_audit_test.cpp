#include "flights/sight_audit.h"

#include <gtest/gtest.h>

#include "grid_path_planner/simulation/triangle_mesh.h"

namespace grid_path_planner::flights {
namespace {

using Eigen::Isometry3d, Eigen::Vector3d;
using simulation::boxMesh, simulation::DepthCamera, simulation::DepthCameraOptions,
    simulation::World;

// From above, the camera at the origin looks along x:  a wall of 2 x 4 m stands 5 m ahead.
class SightAuditTest : public testing::Test {
 protected:
  SightAuditTest() {
    audit_.see(Isometry3d::Identity() * DepthCamera(world_, options_).baseFromOptical());
  }
  bool seen(double x, double y, double z) { return audit_.seen({x, y, z}); }

  const World world_{
      {boxMesh("wall", {0.2, 2.0, 4.0}).moved(Isometry3d(Eigen::Translation3d(5.0, 0.0, 0.0)))}};
  const DepthCameraOptions options_ = {};
  SightAudit audit_{world_, options_, 0.3, Vector3d(-20.0, 0.0, 0.0), 1.5};
};

TEST_F(SightAuditTest, BeforeTheWallIsSeenAndBehindItIsNot) {
  EXPECT_TRUE(seen(2.0, 0.0, 0.0));
  EXPECT_TRUE(seen(4.5, 0.0, 0.0));
  EXPECT_FALSE(seen(4.9, 0.0, 0.0)) << "a part of the ball is in the wall";
  EXPECT_FALSE(seen(6.0, 0.0, 0.0));
  EXPECT_TRUE(seen(6.0, 2.5, 0.0)) << "beside it";
}

TEST_F(SightAuditTest, WhatIsNotInThePictureOrTooFarIsNotSeen) {
  EXPECT_FALSE(seen(-2.0, 0.0, 0.0)) << "behind the camera";
  EXPECT_FALSE(seen(1.0, 2.0, 0.0)) << "beside the picture";
  EXPECT_FALSE(seen(0.2, 0.0, 0.0)) << "it cannot see about itself";
  EXPECT_TRUE(seen(8.5, 3.5, 0.0));
  EXPECT_FALSE(seen(11.0, 4.0, 0.0));
}

TEST_F(SightAuditTest, TheStartIsGivenAndWhatWasSeenStaysSeen) {
  EXPECT_TRUE(seen(-21.0, 0.0, 0.0));
  EXPECT_FALSE(seen(-22.0, 0.0, 0.0));
  audit_.see(Isometry3d(Eigen::Translation3d(-20.0, 0.0, 0.0)) *
             DepthCamera(world_, options_).baseFromOptical());
  EXPECT_TRUE(seen(2.0, 0.0, 0.0));
  EXPECT_TRUE(seen(-12.0, 1.0, 0.0));
}

}  // namespace
}  // namespace grid_path_planner::flights
