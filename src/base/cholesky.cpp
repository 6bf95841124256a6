#include "base/cholesky.h"

#include <cmath>
#include <limits>

namespace grid_path_planner::base {

namespace {

// Row `row` of the factor times that of `other`, left of column `end`.
double product(const double* matrix, Eigen::Index size, Eigen::Index row, Eigen::Index other,
               Eigen::Index end) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < end; ++k) sum += matrix[k * size + row] * matrix[k * size + other];
  return sum;
}

}  // namespace

bool factorizeCholesky(double* matrix, Eigen::Index size) {
  for (Eigen::Index column = 0; column < size; ++column) {
    double* entries = matrix + column * size;
    const double pivot = entries[column] - product(matrix, size, column, column, column);
    if (!(pivot > 0.0 && std::isfinite(pivot))) {
      matrix[0] =
          std::numeric_limits<double>::quiet_NaN();  // is used for every entry of a solution
      return false;
    }
    entries[column] = std::sqrt(pivot);
    for (Eigen::Index row = column + 1; row < size; ++row)
      entries[row] = (entries[row] - product(matrix, size, row, column, column)) / entries[column];
  }
  return true;
}

void solveLower(const double* factor, Eigen::Index size, double* vector) {
  Eigen::Index first = 0;
  if (!std::isnan(factor[0]))
    while (first < size && vector[first] == 0.0) ++first;  // stay 0
  for (Eigen::Index i = first; i < size; ++i) {
    vector[i] /= factor[i * size + i];
    for (Eigen::Index row = i + 1; row < size; ++row)
      vector[row] -= factor[i * size + row] * vector[i];
  }
}

void solveUpper(const double* factor, Eigen::Index size, double* vector) {
  for (Eigen::Index i = size - 1; i >= 0; --i) {
    for (Eigen::Index row = i + 1; row < size; ++row)
      vector[i] -= factor[i * size + row] * vector[row];
    vector[i] /= factor[i * size + i];
  }
}

}  // namespace grid_path_planner::base
