// Measurements that cannot be used are refused with a sentence, before they reach a filter.
//
//   checkMeasurement(measurement, options);      // throws base::InputError
//   checkStamp(measurement.stamp, now, history);
#pragma once

#include "localization/filter_options.h"
#include "localization/measurement.h"

namespace grid_path_planner::localization {

constexpr double kMostAhead = 0.1;  // s

// Throws InputError naming the value: for numbers that are not finite or beyond what a vehicle can do
// (1e6 m, 100 m/s, imu_max_rate, imu_max_acceleration), a quaternion whose length is off 1 by more than 0.01,
// covariances that checkCovariance refuses, and sensors where checkMounting refuses them.
void checkMeasurement(const Measurement& measurement, const FilterOptions& options);

// Throws InputError for a place more than 1000 m from the body frame, and a quaternion as above: tf says
// where sensors are, and anybody may publish it.
void checkMounting(const Mounting& in_body);

// Throws InputError for a variance that is not finite, negative (-1: there is no measurement), 0, or
// outside 1e-12..1e12, and a matrix that is not symmetric and positive definite.
void checkCovariance(const Eigen::MatrixXd& covariance);

// Throws InputError for one more than kMostAhead after `now`, or more than `history` (s) before it.
void checkStamp(Stamp stamp, Stamp now, double history);

}  // namespace grid_path_planner::localization
