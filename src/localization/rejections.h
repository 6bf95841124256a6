// Measurements of a source that were rejected one after another: do they agree with each other?
//
//   if (rejections.add(stamp, deviation, drift, limit) >= 5) reset();
//
// What is compared is by how far each was off its prediction: a filter that went astray and sound fixes
// give nearly the same deviation again and again, outliers give another one each time.
#pragma once

#include <Eigen/Core>

#include "localization/measurement.h"

namespace grid_path_planner::localization {

// By how far a measurement is off, in the world frame, with its variances; what it does not measure
// is 0 with the variance 1.
struct Deviation {
  Eigen::Matrix<double, 6, 1> offset = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 1> variance = Eigen::Matrix<double, 6, 1>::Ones();
};

class Rejections {
 public:
  // How many in a row agree, this included. Two agree where the sum of their squared differences,
  // each over its variance, is at most `limit`; `drift`: the variance of each per second between them.
  int add(Stamp stamp, const Deviation& deviation, double drift, double limit);
  void clear() { count_ = 0; }
  int count() const { return count_; }
  // Whether the last one was like the one before it, whatever was taken between them; of what is long ago as if it were
  // 3 s ago.
  bool isAlike() const { return is_alike_; }
  // By how far the last one was off.
  const Deviation& last() const { return last_; }
  Stamp newest() const { return stamp_; }

 private:
  int count_ = 0;
  bool is_any_ = false, is_alike_ = false;
  Stamp stamp_ = 0;
  Deviation last_;
};

}  // namespace grid_path_planner::localization
