// Estimates that are no numbers: of the covariance, of the state, and by a measurement.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "localization/lagged_filter.h"
#include "localization/support/simulated_sensors.h"

namespace grid_path_planner::localization {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

TEST(FiniteEstimate, TheDeviationIsThatAlongTheWorstAxis) {
  Covariance covariance = Covariance::Zero();
  covariance.diagonal().segment<3>(kAttitude) << 0.01, 0.04, 0.09;
  EXPECT_NEAR(worstDeviation(covariance, kAttitude), 0.3, 1e-12);
  EXPECT_EQ(worstDeviation(covariance, kPosition), 0.0);
}

// It was 0: known perfectly.
TEST(FiniteEstimate, ACovarianceThatIsNoNumberKnowsNothing) {
  for (const double wrong : {kNoNumber, std::numeric_limits<double>::infinity()}) {
    Covariance covariance = Covariance::Identity();
    covariance(kPosition + 1, kPosition + 1) = wrong;
    EXPECT_TRUE(std::isinf(worstDeviation(covariance, kPosition)));
    EXPECT_DOUBLE_EQ(worstDeviation(covariance, kAttitude), 1.0);
  }
}

TEST(FiniteEstimate, EachNumberIsLookedAt) {
  Estimate estimate;
  EXPECT_TRUE(isFinite(estimate));
  estimate.state.gyro_bias.y() = kNoNumber;
  EXPECT_FALSE(isFinite(estimate));
  estimate = {};
  estimate.state.attitude.w() = kNoNumber;
  EXPECT_FALSE(isFinite(estimate));
  estimate = {};
  estimate.covariance(3, 9) = kNoNumber;
  EXPECT_FALSE(isFinite(estimate));
}

// Without a gate it was applied.
TEST(FiniteEstimate, AnInnovationThatIsNoNumberIsGatedByAnyGate) {
  for (const Gate gate : {Gate::CHI_SQUARED, Gate::NONE}) {
    FilterOptions options;
    options.gate = gate;
    LaggedFilter filter(options, Start::AT_FIX);
    filter.add({kStart, Source::SET_POSE,
                PoseFix{Eigen::Vector3d::Zero(),
                        Eigen::Quaterniond::Identity(),
                        PoseCovariance::Identity(),
                        {}}});
    const DepthFix wrong{kNoNumber, 0.01, {0.0, 0.0, 0.0}};
    for (int i = 1; i <= 10; ++i)
      EXPECT_EQ(filter.add({kStart + i, Source::DEPTH, wrong}), Verdict::GATED);
    EXPECT_TRUE(isFinite(filter.snapshot().estimate));
  }
}

}  // namespace
}  // namespace grid_path_planner::localization
