// Cholesky's factorization of small symmetric positive definite matrices.
//
//   const Cholesky<6> factor(covariance);
//   const double nees = factor.squaredMahalanobis(error);      // error^T covariance^-1 error
//   const Eigen::Matrix<double, 6, 1> x = factor.solved(right);
//
// Loops of run-time length that are compiled once: Eigen's LLT and LDLT are compiled for each size and
// right side, some seconds each, and are no faster at sizes up to 15. Without pivots. Of a matrix that is
// not positive definite, or not finite, every result is NaN.
#pragma once

#include <Eigen/Core>

namespace grid_path_planner::base {

// The lower triangle of a column-major matrix becomes that of its factor; false: it is not positive definite.
bool factorizeCholesky(double* matrix, Eigen::Index size);

// factor^-1 vector, and then factor^-T of that, in place.
void solveLower(const double* factor, Eigen::Index size, double* vector);
void solveUpper(const double* factor, Eigen::Index size, double* vector);

template <int N>  // Eigen::Dynamic too
class Cholesky {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  // Reads the lower triangle.
  explicit Cholesky(const Matrix& matrix)
      : factor_(matrix), is_positive_definite_(factorizeCholesky(factor_.data(), factor_.rows())) {}

  bool isPositiveDefinite() const { return is_positive_definite_; }

  // matrix^-1 right
  Vector solved(Vector right) const {
    solveLower(factor_.data(), factor_.rows(), right.data());
    solveUpper(factor_.data(), factor_.rows(), right.data());
    return right;
  }

  // vector^T matrix^-1 vector
  double squaredMahalanobis(Vector vector) const {
    solveLower(factor_.data(), factor_.rows(), vector.data());
    return vector.squaredNorm();
  }

  // Symmetric.
  Matrix inverse() const {
    Matrix result = Matrix::Identity(factor_.rows(), factor_.cols());
    for (Eigen::Index i = 0; i < result.cols(); ++i) {
      solveLower(factor_.data(), factor_.rows(), result.col(i).data());
      solveUpper(factor_.data(), factor_.rows(), result.col(i).data());
    }
    return 0.5 * (result + result.transpose());
  }

 private:
  Matrix factor_;
  bool is_positive_definite_;
};

}  // namespace grid_path_planner::base
