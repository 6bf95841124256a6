#include "ros/localization/inputs/input_health.h"

#include <cmath>
#include <limits>

#include "grid_path_planner/base/decimal_text.h"
#include "localization/vehicle_localizer.h"

namespace grid_path_planner::nodes {

using localization::InputStatistics;
using localization::Source;

namespace {

InputHealth silent(const std::optional<std::string>& problem, const std::string& since,
                   bool is_missed) {
  return {!is_missed, problem.value_or("silent" + since)};
}

}  // namespace

InputExpectation expectationOf(Source source, const VehicleLocalizerOptions& options) {
  const double limit = localization::longestSilence(source, options.localizer);
  if (source == Source::SET_POSE) return {std::numeric_limits<double>::infinity(), true, false};
  if (source == Source::COMMAND) return {limit, false, true};
  return {limit, source != Source::HEADING || options.use_heading, false};
}

InputHealth healthOf(const InputStatistics& statistics, const InputCounts& counts,
                     const std::optional<std::string>& problem,
                     const InputExpectation& expectation) {
  if (counts.received == 0) return {true, "not heard"};
  if (!statistics.age) return silent(problem, "", expectation.is_missed);
  if (*statistics.age > expectation.silent_after)
    return silent(problem, " for " + base::decimalText(std::round(*statistics.age)) + " s",
                  expectation.is_missed);
  if (statistics.counts.taken == 0 && statistics.counts.gated == 0)
    return expectation.is_spare ? InputHealth{true, "heard, and not needed yet"}
                                : InputHealth{false, "heard, and not used yet"};
  if (statistics.gated > statistics.nis_count)
    return {false, "most are gated: they contradict the pose"};
  if (statistics.nis_count > 0 && statistics.nis_mean > statistics.nis_bounds.high)
    return {false, "its errors are larger than its covariance says"};
  return {true, "used"};
}

}  // namespace grid_path_planner::nodes
