// Where the vehicle turns and flies to see what it has not seen about its path.
//
// Seen before: a vehicle that stood for good in the open. One voxel 0.6 m beside the path had aged, and it looked
// along the path; or that voxel was 0.6 m from the middle of the place's voxel and 0.65 m from the place, so
// that nothing about the place seemed unseen.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "avoidance/seen_space.h"
#include "avoidance/steering/unseen_places.h"
#include "avoidance/steering/vantage.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

constexpr double kSafe = 0.6;  // m

Steering waitingFor(const Vector3d& place) {
  Steering steering;
  steering.clear_path = 0.2;
  steering.closed = place;
  steering.unseen = true;
  return steering;
}

// Updates UnseenPlaces while the vehicle waits, until that changes what is flown.
void wait(UnseenPlaces& places, const Motion& motion, const Vector3d& place, const OpenSpace& space,
          double& time) {
  const KeptRoom room(space, kSafe, motion.position);
  const double end = time + 3.0;
  while (time < end && !places.update(time, motion, waitingFor(place), space, room, kSafe))
    time += 0.1;
}

TEST(UnseenPlaces, APlaceIsUnseenJustWhereSomethingAboutItIs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> coordinate(-0.5, 0.5);
  std::uniform_int_distribution<> offset(-3, 3);
  int unseen = 0;
  for (int i = 0; i < 60; ++i) {
    const Vector3d place(coordinate(random), coordinate(random), coordinate(random));
    const Voxel at = voxelAt(place);
    const Voxel missing{at.x + offset(random), at.y + offset(random), at.z + offset(random)};
    const OpenSpace space = seenSpace(kSafe, missing);
    const Vector3d vehicle = place + Vector3d(-2.5, 0.0, 0.0);
    const auto aside = unseenAside(space, vehicle, M_PI, place, kSafe);
    ASSERT_EQ(aside.empty(), space.seen(place)) << i;
    if (aside.empty()) continue;
    ++unseen;
    EXPECT_EQ(aside.size(), 1u);
    EXPECT_TRUE(voxelAt(aside.front()) == missing) << i;
  }
  EXPECT_GT(unseen, 10);
}

TEST(UnseenPlaces, WhatThePictureShowsIsNotAside) {
  const Voxel missing{2, 1, 0};
  const Vector3d place(0.3, 0.1, 0.1), vehicle(-1.5, 0.1, 0.1);
  const OpenSpace space = seenSpace(kSafe, missing);
  ASSERT_FALSE(space.seen(place));
  EXPECT_TRUE(unseenAside(space, vehicle, 0.0, place, kSafe).empty());
  EXPECT_EQ(unseenAside(space, vehicle, 1.0, place, kSafe).size(), 1u);
}

TEST(UnseenPlaces, TurnsOnceToWhatIsUnseenBesideThePath) {
  const Voxel missing{1, 3, 0};
  Motion motion;
  motion.position = {0.1, 0.1, 0.1};
  const Vector3d place(0.35, 0.1, 0.1);
  const OpenSpace space = seenSpace(kSafe, missing);
  ASSERT_FALSE(space.seen(place));
  UnseenPlaces places;
  double time = 0.0;
  wait(places, motion, place, space, time);
  ASSERT_TRUE(places.lookAt());
  EXPECT_TRUE(voxelAt(*places.lookAt()) == missing);
  EXPECT_LT((places.path().back() - motion.position).norm(), 1e-9) << "from where it is";
  wait(places, motion, place, space, time);  // in vain
  EXPECT_FALSE(places.looks());
  wait(places, motion, place, space, time);
  EXPECT_FALSE(places.lookAt() && voxelAt(*places.lookAt()) == missing);
}

// A camera sees neither its own skirts nor what is above it: that shows from farther away.
TEST(UnseenPlaces, FliesBackFromWhatIsAboveThePath) {
  const Voxel missing{1, 0, 3};
  const Vector3d vehicle(0.1, 0.1, 0.1), place(0.35, 0.1, 0.1);
  const OpenSpace space = seenSpace(kSafe, missing);
  ASSERT_FALSE(space.seen(place));
  EXPECT_TRUE(unseenAside(space, vehicle, M_PI, place, kSafe).empty());
  const KeptRoom room(space, kSafe, vehicle);
  const auto path = pathToVantage(space, room, vehicle, place, kSafe, {});
  ASSERT_EQ(path.size(), 2u);
  EXPECT_GT((path.back() - place).head<2>().norm(), 1.0);
}

}  // namespace
}  // namespace grid_path_planner::avoidance
