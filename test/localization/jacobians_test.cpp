// The closed forms of the Jacobians against automatic differentiation and against central differences.
#include <gtest/gtest.h>

#include <random>
#include <type_traits>

#include "localization/imu_propagation.h"
#include "localization/kalman_update.h"
#include "localization/measurement_models.h"
#include "localization/support/dual.h"

namespace grid_path_planner::localization {
namespace {

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

BasicState<Dual> dual(const State& state) {
  return {state.position.cast<Dual>(), state.velocity.cast<Dual>(), state.attitude.cast<Dual>(),
          state.gyro_bias.cast<Dual>(), state.accelerometer_bias.cast<Dual>()};
}

// d f(retract(state, e)) / d e
template <int N, class Function>
Jacobian<N> automatic(const State& state, const Function& f) {
  Jacobian<N> jacobian;
  for (int i = 0; i < kErrors; ++i) {
    Eigen::Matrix<Dual, kErrors, 1> error = ErrorVector::Zero().cast<Dual>();
    error[i].derivative = 1.0;
    const Eigen::Matrix<Dual, N, 1> value = f(retract<Dual>(dual(state), error));
    for (int row = 0; row < N; ++row) jacobian(row, i) = value[row].derivative;
  }
  return jacobian;
}

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

// `f`: of a state of any number.
template <int N, class Function>
void expectDerivativeOf(const Jacobian<N>& closed, const State& state, const Function& f) {
  EXPECT_LT((closed - automatic<N>(state, f)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((closed - centralDifferences<N>(state, f)).cwiseAbs().maxCoeff(), 1e-7);
}

template <class T>
BasicState<T> as(const State& state) {
  if constexpr (std::is_same_v<T, Dual>)
    return dual(state);
  else
    return state;
}

template <class State>
using NumberOf = typename decltype(State::position)::Scalar;

class Jacobians : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937_64 random{GetParam()};
  RandomCase c = randomCase(random);
};

TEST_P(Jacobians, OfThePropagation) {
  const double seconds = 0.05;
  const State after = propagated<double>(c.state, c.imu, seconds, 9.8);
  const auto f = [&](const auto& state) {
    using T = NumberOf<std::decay_t<decltype(state)>>;
    return errorBetween<T>(as<T>(after), propagated<T>(state, c.imu, seconds, 9.8));
  };
  expectDerivativeOf<kErrors>(dense(propagationJacobian(c.state, c.imu, seconds)), c.state, f);
}

TEST_P(Jacobians, OfTheVelocityOfASensor) {
  const auto f = [&](const auto& state) {
    return predictedVelocity<NumberOf<std::decay_t<decltype(state)>>>(state, c.imu.rate,
                                                                      c.mounting);
  };
  expectDerivativeOf<3>(velocityJacobian(c.state, c.mounting), c.state, f);
}

TEST_P(Jacobians, OfThePositionOfASensor) {
  const auto f = [&](const auto& state) {
    return predictedPosition<NumberOf<std::decay_t<decltype(state)>>>(state, c.mounting.position);
  };
  expectDerivativeOf<3>(positionJacobian(c.state, c.mounting.position), c.state, f);
}

TEST_P(Jacobians, OfTheYaw) {
  c.state.attitude =
      expSO3<double>(Eigen::Vector3d(0.0, 0.0, 2.0)) * expSO3<double>(vectorOf(random, 0.3));
  const auto f = [&](const auto& state) {
    using T = NumberOf<std::decay_t<decltype(state)>>;
    return Eigen::Matrix<T, 1, 1>(predictedYaw<T>(state));
  };
  expectDerivativeOf<1>(yawJacobian(c.state), c.state, f);
}

TEST_P(Jacobians, OfAPoseHoweverFarOff) {
  const PoseFix fix{vectorOf(random, 10.0),
                    c.state.attitude * c.mounting.rotation * expSO3<double>(vectorOf(random, 0.8)),
                    Eigen::Matrix<double, 6, 6>::Identity(), c.mounting};
  const auto f = [&](const auto& state) {
    return poseResidual<NumberOf<std::decay_t<decltype(state)>>>(state, fix);
  };
  expectDerivativeOf<6>(-poseJacobian(c.state, fix), c.state, f);
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
  Estimate expected{estimate.state, rest * p * rest.transpose() + gain * noise * gain.transpose()};
  correct(expected, gain * residual);
  const Innovation innovation(estimate, residual, h, noise);
  EXPECT_NEAR(innovation.nis(), residual.dot(s.inverse() * residual), 1e-12);
  innovation.apply(estimate);
  EXPECT_LT((estimate.covariance - expected.covariance).norm(), 1e-12);
  EXPECT_LT(errorBetween<double>(estimate.state, expected.state).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Jacobians, testing::Range(1u, 21u));

}  // namespace
}  // namespace grid_path_planner::localization
