#include "localization/input_statistics.h"

namespace grid_path_planner::localization {

InputStatistics inputStatistics(const LaggedFilter& filter, Source source, Stamp now) {
  InputStatistics statistics;
  statistics.counts = filter.counts(source);
  std::optional<Stamp> first, last;
  int number = 0, dimension = 0;
  for (const LaggedFilter::Event& event : filter.events()) {
    if (event.measurement.source != source) continue;
    if (!first) first = event.measurement.stamp;
    last = event.measurement.stamp;
    ++number;
    statistics.gated += event.outcome.verdict == Verdict::GATED;
    if (event.outcome.verdict != Verdict::TAKEN || event.outcome.degrees_of_freedom == 0) continue;
    dimension = event.outcome.degrees_of_freedom;
    statistics.nis_mean += event.outcome.nis;
    ++statistics.nis_count;
  }
  if (last) statistics.age = secondsBetween(*last, now);
  if (number > 1) statistics.rate = (number - 1) / secondsBetween(*first, *last);
  if (statistics.nis_count > 0) {
    statistics.nis_mean /= statistics.nis_count;
    statistics.nis_bounds = meanBounds(dimension, statistics.nis_count, 0.95);
  }
  return statistics;
}

}  // namespace grid_path_planner::localization
