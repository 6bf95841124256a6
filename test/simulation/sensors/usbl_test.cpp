#include "simulation/sensors/usbl.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "support/option_laws.h"

namespace grid_path_planner::simulation {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr std::int64_t kSecond = 1000000000;

UsblOptions exactUsbl() {
  UsblOptions options;
  options.range_noise = options.bearing_noise = options.outlier_share = 0.0;
  options.keel_x = options.keel_y = options.keel_z = 0.0;
  return options;
}

VehicleState standingAt(const Vector3d& position) {
  VehicleState state;
  state.position = position;
  return state;
}

// The fixes of a vehicle that stands at `position`.
std::vector<UsblFix> fixesAt(const Vector3d& position, const UsblOptions& options, int count) {
  Usbl usbl(options);
  std::vector<UsblFix> fixes;
  for (std::int64_t i = 0; static_cast<int>(fixes.size()) < count; ++i)
    for (const UsblFix& fix : usbl.measure(standingAt(position), i * kSecond)) fixes.push_back(fix);
  return fixes;
}

TEST(UsblOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<UsblOptions>();
}

// 750 m of water are half a second of sound: the fix of 1 s arrives at 2.1 s, and says where the vehicle
// was, not where it is.
TEST(Usbl, AFixArrivesAfterItsDelayAndTheSoundsTravelWithTheTimeOfThen) {
  Usbl usbl(exactUsbl());
  const VehicleState then = standingAt({0.0, 0.0, -750.0}), now = standingAt({30.0, 0.0, -750.0});
  const auto nothing = [&](std::int64_t time_ns, const VehicleState& state) {
    return usbl.measure(state, time_ns).empty();
  };
  EXPECT_TRUE(nothing(0, then));
  EXPECT_TRUE(nothing(kSecond, then));
  const auto first = usbl.measure(now, 1100000000);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].time_ns, 0);
  EXPECT_EQ(first[0].arrives_ns, 1100000000);
  EXPECT_NEAR((first[0].position - then.position).norm(), 0.0, 1e-9);
  EXPECT_TRUE(nothing(2090000000, now));
  const auto second = usbl.measure(now, 2100000000);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].time_ns, kSecond);
  EXPECT_NEAR((second[0].position - then.position).norm(), 0.0, 1e-9);
}

// 100 m below the keel a degree is 1.7 m: far across the line of sight, exact along it.
TEST(Usbl, ErrsByTheCovarianceThatItTells) {
  UsblOptions options = exactUsbl();
  options.range_noise = 0.1;
  options.bearing_noise = M_PI / 180.0;
  const Vector3d place(60.0, 0.0, -80.0);
  Matrix3d sum = Matrix3d::Zero();
  const auto fixes = fixesAt(place, options, 5000);
  for (const UsblFix& fix : fixes)
    sum += (fix.position - place) * (fix.position - place).transpose() / 5000.0;
  const Matrix3d told = fixes.back().covariance;
  EXPECT_NEAR((sum - told).norm() / told.norm(), 0.0, 0.08);
  const Vector3d along = place.normalized(), across(0.8, 0.0, 0.6);
  EXPECT_NEAR(along.dot(told * along), 0.01, 1e-12);
  EXPECT_NEAR(across.dot(told * across), std::pow(100.0 * M_PI / 180.0, 2), 1e-9);
  // A direction that errs leaves the plane across: 2 r^2 sigma^4 more along the line, to first order.
  EXPECT_NEAR(along.dot(sum * along) / 0.01, 1.185, 0.1);
}

TEST(Usbl, OutliersAreAsManyAndAsFarAsItIsTold) {
  UsblOptions options = exactUsbl();
  options.outlier_share = 0.3;
  const Vector3d place(5.0, 5.0, -20.0);
  int outliers = 0;
  for (const UsblFix& fix : fixesAt(place, options, 3000)) {
    const double off = (fix.position - place).norm();
    if (off < 1e-9) continue;
    ++outliers;
    EXPECT_GE(off, 2.0 - 1e-9);
    EXPECT_LE(off, 20.0 + 1e-9);
    EXPECT_EQ(fix.covariance.norm(), 0.0) << "which tells nothing of it";
  }
  EXPECT_NEAR(outliers / 3000.0, 0.3, 0.035);
}

TEST(Usbl, AtTheKeelItselfAFixIsFinite) {
  UsblOptions options;
  const auto fixes = fixesAt(Vector3d(options.keel_x, options.keel_y, options.keel_z), options, 20);
  for (const UsblFix& fix : fixes) EXPECT_TRUE(fix.position.allFinite());
}

TEST(Usbl, ItsTransponderIsWhereItIsMounted) {
  UsblOptions options = exactUsbl();
  options.mounting.x = 0.5;
  Usbl usbl(options);
  VehicleState state = standingAt({0.0, 0.0, -15.0});
  state.yaw = M_PI / 2;
  usbl.measure(state, 0);
  const auto fixes = usbl.measure(state, kSecond);
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_NEAR((fixes[0].position - Vector3d(0.0, 0.5, -15.0)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace grid_path_planner::simulation
