#include "base/cholesky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace grid_path_planner::base {
namespace {

TEST(Cholesky, OfAMatrixByHand) {
  Eigen::Matrix2d matrix;
  matrix << 4.0, 2.0, 2.0, 10.0;  // the factor is (2 0; 1 3)
  const Cholesky<2> factor(matrix);
  EXPECT_TRUE(factor.isPositiveDefinite());
  EXPECT_EQ(factor.solved({8.0, 22.0}), Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(factor.squaredMahalanobis({2.0, 4.0}), 2.0);  // 1^2 + 1^2
}

template <int N>
void expectSolved(int size, std::mt19937_64& random) {
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  std::normal_distribution<double> normal;
  Matrix root(size, size);
  Vector right(size);
  for (int i = 0; i < size; ++i) {
    right[i] = normal(random);
    for (int k = 0; k < size; ++k) root(i, k) = normal(random);
  }
  const Matrix matrix = Matrix::Identity(size, size) + root.lazyProduct(root.transpose());
  const Cholesky<N> factor(matrix);
  const Vector solution = factor.solved(right);
  EXPECT_LT((matrix.lazyProduct(solution) - right).norm(), 1e-9 * right.norm()) << size;
  EXPECT_NEAR(factor.squaredMahalanobis(right), right.dot(solution), 1e-9 * right.norm());
  const Matrix inverse = factor.inverse();
  EXPECT_LT((matrix.lazyProduct(inverse) - Matrix::Identity(size, size)).norm(), 1e-8) << size;
  EXPECT_EQ(inverse, Matrix(inverse.transpose()));
}

TEST(Cholesky, SolvesAtEverySize) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 50; ++i) {
    expectSolved<1>(1, random);
    expectSolved<6>(6, random);
    expectSolved<15>(15, random);
    expectSolved<Eigen::Dynamic>(2 + i, random);
  }
}

TEST(Cholesky, OfAMatrixThatIsNotPositiveDefiniteEveryResultIsNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = HUGE_VAL;
  for (const double corner : {0.0, -1.0, nan, inf, -inf})
    for (int place = 0; place < 3; ++place) {
      Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
      matrix(place, place) = corner;
      const Cholesky<3> factor(matrix);
      EXPECT_FALSE(factor.isPositiveDefinite());
      EXPECT_TRUE(factor.solved({1.0, 2.0, 3.0}).array().isNaN().all());
      EXPECT_TRUE(factor.inverse().array().isNaN().all());
      EXPECT_TRUE(std::isnan(factor.squaredMahalanobis({1.0, 2.0, 3.0})));
    }
}

}  // namespace
}  // namespace grid_path_planner::base
