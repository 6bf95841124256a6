// The closed forms of the Jacobians against automatic differentiation and against central differences.
#include <gtest/gtest.h>

#include <random>
#include <unsupported/Eigen/AutoDiff>

#include "localization/imu_propagation.h"
#include "localization/kalman_update.h"
#include "localization/measurement_models.h"

namespace grid_path_planner::localization {
namespace {

using Dual = Eigen::AutoDiffScalar<ErrorVector>;
using DualError = Eigen::Matrix<Dual, kErrors, 1>;

struct RandomCase {
  State state;
  Inertial imu;
  Mounting mounting;
};

Eigen::Vector3d vectorOf(std::mt19937_64& random, double size) {
  std::normal_distribution<double> normal(0.0, size);
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

RandomCase randomCase(std::mt19937_64& random) {
  RandomCase c;
  c.state = {vectorOf(random, 10.0), vectorOf(random, 1.0), expSO3<double>(vectorOf(random, 1.0)),
             vectorOf(random, 0.01), vectorOf(random, 0.2)};
  c.imu = {vectorOf(random, 0.5), vectorOf(random, 5.0)};
  c.mounting = {vectorOf(random, 0.5), expSO3<double>(vectorOf(random, 1.0))};
  return c;
}

BasicState<Dual> withErrors(const State& state) {
  BasicState<Dual> cast{state.position.cast<Dual>(), state.velocity.cast<Dual>(),
                        state.attitude.cast<Dual>(), state.gyro_bias.cast<Dual>(),
                        state.accelerometer_bias.cast<Dual>()};
  DualError error;
  for (int i = 0; i < kErrors; ++i) error[i] = Dual(0.0, kErrors, i);
  return retract<Dual>(cast, error);
}

template <int N>
Jacobian<N> derivativesOf(const Eigen::Matrix<Dual, N, 1>& value) {
  Jacobian<N> jacobian = Jacobian<N>::Zero();
  for (int i = 0; i < N; ++i)
    if (value[i].derivatives().size() == kErrors) jacobian.row(i) = value[i].derivatives();
  return jacobian;
}

// d f(retract(state, e)) / d e
template <int N, class Function>
Jacobian<N> centralDifferences(const State& state, const Function& f) {
  Jacobian<N> jacobian;
  for (int i = 0; i < kErrors; ++i) {
    const ErrorVector step = 1e-5 * ErrorVector::Unit(i);
    jacobian.col(i) =
        (f(retract<double>(state, step)) - f(retract<double>(state, ErrorVector(-step)))) / 2e-5;
  }
  return jacobian;
}

template <int N>
void expectSame(const Jacobian<N>& closed, const Jacobian<N>& automatic,
                const Jacobian<N>& differences) {
  EXPECT_LT((closed - automatic).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((closed - differences).cwiseAbs().maxCoeff(), 1e-7);
}

class Jacobians : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937_64 random{GetParam()};
  RandomCase c = randomCase(random);
};

TEST_P(Jacobians, OfThePropagation) {
  const double seconds = 0.05;
  const State after = propagated<double>(c.state, c.imu, seconds, 9.8);
  const BasicState<Dual> moved = propagated<Dual>(withErrors(c.state), c.imu, seconds, 9.8);
  const BasicState<Dual> reference{after.position.cast<Dual>(), after.velocity.cast<Dual>(),
                                   after.attitude.cast<Dual>(), after.gyro_bias.cast<Dual>(),
                                   after.accelerometer_bias.cast<Dual>()};
  const DualError error = errorBetween<Dual>(reference, moved);
  const auto f = [&](const State& state) {
    return errorBetween<double>(after, propagated<double>(state, c.imu, seconds, 9.8));
  };
  expectSame<kErrors>(dense(propagationJacobian(c.state, c.imu, seconds)),
                      derivativesOf<kErrors>(error), centralDifferences<kErrors>(c.state, f));
}

TEST_P(Jacobians, OfTheVelocityOfASensor) {
  const auto f = [&](const State& state) {
    return predictedVelocity<double>(state, c.imu.rate, c.mounting);
  };
  const Vector3<Dual> dual = predictedVelocity<Dual>(withErrors(c.state), c.imu.rate, c.mounting);
  expectSame<3>(velocityJacobian(c.state, c.mounting), derivativesOf<3>(dual),
                centralDifferences<3>(c.state, f));
}

TEST_P(Jacobians, OfThePositionOfASensor) {
  const auto f = [&](const State& state) {
    return predictedPosition<double>(state, c.mounting.position);
  };
  const Vector3<Dual> dual = predictedPosition<Dual>(withErrors(c.state), c.mounting.position);
  expectSame<3>(positionJacobian(c.state, c.mounting.position), derivativesOf<3>(dual),
                centralDifferences<3>(c.state, f));
}

TEST_P(Jacobians, OfTheYaw) {
  c.state.attitude =
      expSO3<double>(Eigen::Vector3d(0.0, 0.0, 2.0)) * expSO3<double>(vectorOf(random, 0.3));
  using Scalar = Eigen::Matrix<double, 1, 1>;
  const auto f = [&](const State& state) { return Scalar(predictedYaw<double>(state)); };
  const Eigen::Matrix<Dual, 1, 1> dual(predictedYaw<Dual>(withErrors(c.state)));
  expectSame<1>(yawJacobian(c.state), derivativesOf<1>(dual), centralDifferences<1>(c.state, f));
}

TEST_P(Jacobians, OfAPoseHoweverFarOff) {
  const PoseFix fix{vectorOf(random, 10.0),
                    c.state.attitude * c.mounting.rotation * expSO3<double>(vectorOf(random, 0.8)),
                    Eigen::Matrix<double, 6, 6>::Identity(), c.mounting};
  const auto f = [&](const State& state) { return poseResidual<double>(state, fix); };
  const Eigen::Matrix<Dual, 6, 1> dual = poseResidual<Dual>(withErrors(c.state), fix);
  expectSame<6>(poseJacobian(c.state, fix), -derivativesOf<6>(dual),
                -centralDifferences<6>(c.state, f));
}

TEST_P(Jacobians, RetractionAndErrorUndoEachOther) {
  ErrorVector error;
  for (int k = 0; k < kErrors; k += 3) error.segment<3>(k) = vectorOf(random, 0.5);
  EXPECT_LT((errorBetween<double>(c.state, retract<double>(c.state, error)) - error).norm(), 1e-13);
}

// The blocks that the filter multiplies are those of the dense matrix.
TEST_P(Jacobians, TheCovarianceIsMultipliedByThePropagation) {
  Covariance root;
  std::normal_distribution<double> normal;
  for (int i = 0; i < kErrors; ++i)
    for (int k = 0; k < kErrors; ++k) root(i, k) = normal(random);
  Estimate estimate{c.state, root * root.transpose()};
  const Covariance jacobian = dense(propagationJacobian(c.state, c.imu, 0.05));
  const Covariance expected = jacobian * estimate.covariance * jacobian.transpose();
  propagate(estimate, c.imu, 0.05, ImuNoise{});
  EXPECT_LT((estimate.covariance - expected).norm(), 1e-11 * expected.norm());
}

// Joseph's form, written out.
TEST_P(Jacobians, TheUpdateIsThatOfTheTextbook) {
  Estimate estimate{c.state, Covariance::Identity()};
  propagate(estimate, c.imu, 0.5, {0.1, 0.1, 0.1, 0.1, 9.8});
  const Jacobian<3> h = positionJacobian(estimate.state, c.mounting.position);
  const Eigen::Matrix3d noise = Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal();
  const Eigen::Vector3d residual(0.1, -0.2, 0.3);
  const Covariance& p = estimate.covariance;
  const Eigen::Matrix3d s = h * p * h.transpose() + noise;
  const Eigen::Matrix<double, kErrors, 3> gain = p * h.transpose() * s.inverse();
  const Covariance rest = Covariance::Identity() - gain * h;
  Estimate expected{c.state, rest * p * rest.transpose() + gain * noise * gain.transpose()};
  expected.state = estimate.state;
  correct(expected, gain * residual);
  const Innovation<3> innovation(estimate, residual, h, noise);
  EXPECT_NEAR(innovation.nis(), residual.dot(s.inverse() * residual), 1e-12);
  innovation.apply(estimate);
  EXPECT_LT((estimate.covariance - expected.covariance).norm(), 1e-12);
  EXPECT_LT(errorBetween<double>(estimate.state, expected.state).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Jacobians, testing::Range(1u, 21u));

}  // namespace
}  // namespace grid_path_planner::localization
