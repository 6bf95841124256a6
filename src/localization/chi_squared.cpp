#include "localization/chi_squared.h"

#include <boost/math/distributions/chi_squared.hpp>

namespace grid_path_planner::localization {

double chiSquaredQuantile(int degrees_of_freedom, double probability) {
  return boost::math::quantile(boost::math::chi_squared(degrees_of_freedom), probability);
}

Interval meanBounds(int degrees_of_freedom, int count, double probability) {
  const int all = degrees_of_freedom * count;
  const double outside = 0.5 * (1.0 - probability);
  return {chiSquaredQuantile(all, outside) / count, chiSquaredQuantile(all, 1.0 - outside) / count};
}

}  // namespace grid_path_planner::localization
