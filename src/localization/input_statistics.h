// What came of a source lately, and whether its residuals are as large as its covariances say.
//
//   const InputStatistics dvl = inputStatistics(filter, Source::DVL, now);
//   if (dvl.nis_mean > dvl.nis_bounds.high) warn("the DVL is worse than it says");
#pragma once

#include <cstdint>
#include <optional>

#include "localization/chi_squared.h"
#include "localization/lagged_filter.h"

namespace grid_path_planner::localization {

struct InputStatistics {
  double rate = 0.0;          // Hz, over the history
  std::optional<double> age;  // s, of the newest; none: there is none in the history
  SourceCounts counts;        // since the start
  int gated = 0;              // of the history
  int nis_count = 0;          // of the history, those taken: one outlier says nothing of the others
  double nis_mean = 0.0;      // the degrees of freedom where the model holds
  Interval nis_bounds{0.0, 0.0};  // of 95 % of such means
};

InputStatistics inputStatistics(const LaggedFilter& filter, Source source, Stamp now);

}  // namespace grid_path_planner::localization
