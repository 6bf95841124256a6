#include "localization/so3.h"

#include <gtest/gtest.h>

#include <random>

namespace grid_path_planner::localization {
namespace {

Eigen::Vector3d direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Vector3d(x, y, z).normalized();
}

TEST(So3, AQuarterTurnAboutZTakesXToY) {
  const Eigen::Vector3d quarter(0.0, 0.0, 0.5 * M_PI);
  EXPECT_LT((expSO3<double>(quarter) * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(),
            1e-15);
}

TEST(So3, LogarithmUndoesExponentialUpToHalfATurn) {
  std::mt19937_64 random(19);
  for (const double angle : {0.0, 1e-12, 1e-6, 0.0009, 0.0011, 0.1, 1.0, 3.0, M_PI - 1e-9, M_PI})
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d v = angle * direction(random);
      const Eigen::Vector3d back = logSO3<double>(expSO3<double>(v));
      // At half a turn both directions are right.
      const double error = std::min((back - v).norm(), angle == M_PI ? (back + v).norm() : 1e9);
      EXPECT_LT(error, 1e-14 + 1e-15 * angle) << angle;
    }
}

TEST(So3, TheLogarithmIsTheShorterTurnWhateverTheSignOfTheQuaternion) {
  std::mt19937_64 random(20);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond q = expSO3<double>(0.06 * i * direction(random));
    const Eigen::Quaterniond minus(-q.w(), -q.x(), -q.y(), -q.z());
    EXPECT_LE(logSO3<double>(q).norm(), M_PI + 1e-15);
    EXPECT_LT((logSO3<double>(q) - logSO3<double>(minus)).norm(), 1e-15);
  }
}

TEST(So3, ExponentialIsThatOfEigen) {
  std::mt19937_64 random(21);
  for (int i = 1; i < 100; ++i) {
    const Eigen::Vector3d axis = direction(random);
    const Eigen::Quaterniond expected(Eigen::AngleAxisd(0.05 * i, axis));
    EXPECT_LT((expSO3<double>(0.05 * i * axis).coeffs() - expected.coeffs()).norm(), 1e-14);
  }
}

TEST(So3, RightJacobianIsTheDerivative) {
  std::mt19937_64 random(22);
  for (const double angle : {0.0, 1e-4, 0.0009, 0.0011, 0.3, 2.0, 3.1}) {
    const Eigen::Vector3d v = angle * direction(random);
    Eigen::Matrix3d difference;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = 1e-5 * Eigen::Vector3d::Unit(k);
      const auto at = [&](const Eigen::Vector3d& w) {
        return logSO3<double>(expSO3<double>(v).conjugate() * expSO3<double>(w));
      };
      difference.col(k) = (at(v + step) - at(v - step)) / 2e-5;
    }
    EXPECT_LT((rightJacobian(v) - difference).norm(), 1e-9) << angle;
    EXPECT_LT((rightJacobian(v) * rightJacobianInverse(v) - Eigen::Matrix3d::Identity()).norm(),
              1e-12)
        << angle;
    EXPECT_LT((leftJacobianInverse(v) - rightJacobianInverse(v).transpose()).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace grid_path_planner::localization
