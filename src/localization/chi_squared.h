// Quantiles of the chi-squared distribution.
#pragma once

namespace grid_path_planner::localization {

// Below it lies `probability` of the distribution with so many degrees of freedom; 0.999: 10.83 (1),
// 16.27 (3), 22.46 (6).
double chiSquaredQuantile(int degrees_of_freedom, double probability);

struct Interval {
  double low, high;
};

// Holds `probability` of the means of `count` values, each chi-squared with so many degrees of freedom.
Interval meanBounds(int degrees_of_freedom, int count, double probability);

}  // namespace grid_path_planner::localization
