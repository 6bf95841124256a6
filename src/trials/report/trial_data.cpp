#include "trials/report/trial_data.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "localization/chi_squared.h"

namespace grid_path_planner::trials {
namespace {

struct SecondsMean {
  double mean = NAN;
  double inside = NAN;
};

// `nees`: of each run, each second.
SecondsMean meanOverSeconds(const std::vector<const std::vector<double>*>& nees, int dimension) {
  std::size_t seconds = nees.empty() ? 0 : nees.front()->size();
  for (const auto* run : nees) seconds = std::min(seconds, run->size());
  if (seconds == 0) return {};
  const auto bounds = localization::meanBounds(dimension, static_cast<int>(nees.size()), 0.95);
  SecondsMean result{0.0, 0.0};
  for (std::size_t second = 0; second < seconds; ++second) {
    double sum = 0.0;
    for (const auto* run : nees) sum += (*run)[second];
    const double mean = sum / static_cast<double>(nees.size());
    result.mean += mean / static_cast<double>(seconds);
    if (bounds.low <= mean && mean <= bounds.high)
      result.inside += 1.0 / static_cast<double>(seconds);
  }
  return result;
}

}  // namespace

MeanAndSpread meanOf(const std::vector<double>& values) {
  if (values.empty()) return {};
  MeanAndSpread result{0.0, 0.0, 0.0};
  const auto count = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / count;
  for (const double value : values)
    result.deviation += (value - result.mean) * (value - result.mean) / count;
  result.deviation = std::sqrt(result.deviation);
  if (count > 1.0) result.standard_error = result.deviation / std::sqrt(count - 1.0);
  return result;
}

bool TrialData::canBeReported() const {
  std::vector<int> seeds(study.sets.size(), 0);
  std::vector<bool> shown(study.sets.size(), false);
  for (const RunRecord& run : runs) {
    seeds[run.set] += run.seed != kShownSeed;
    if (run.seed == kShownSeed) shown[run.set] = true;
  }
  return std::all_of(seeds.begin(), seeds.end(), [](int count) { return count >= 2; }) &&
         std::find(shown.begin(), shown.end(), false) == shown.end();
}

std::vector<double> TrialData::figures(
    std::size_t set, std::size_t row, const std::function<double(const RowResult&)>& figure) const {
  std::vector<double> values;
  for (const RunRecord& run : runs) {
    if (run.set != set || run.seed == kShownSeed) continue;
    if (const double value = figure(run.rows[row]); !std::isnan(value)) values.push_back(value);
  }
  return values;
}

MeanAndSpread TrialData::mean(std::size_t set, std::size_t row,
                              const std::function<double(const RowResult&)>& figure) const {
  return meanOf(figures(set, row, figure));
}

const RowResult& TrialData::shown(std::size_t set, std::size_t row) const {
  for (const RunRecord& run : runs)
    if (run.set == set && run.seed == kShownSeed) return run.rows[row];
  throw std::out_of_range("no run with the poses of the images");
}

std::size_t TrialData::setNamed(const std::string& name) const {
  for (std::size_t i = 0; i < study.sets.size(); ++i)
    if (study.sets[i].name == name) return i;
  return 0;
}

bool TrialData::hasSet(const std::string& name) const {
  return study.sets[setNamed(name)].name == name;
}

Consistency consistencyOf(const TrialData& data, std::size_t set, std::size_t row) {
  std::vector<const std::vector<double>*> all, pose;
  for (const RunRecord& run : data.runs)
    if (run.set == set && run.seed != kShownSeed && !run.rows[row].nees.empty()) {
      all.push_back(&run.rows[row].nees);
      pose.push_back(&run.rows[row].pose_nees);
    }
  const SecondsMean of_all = meanOverSeconds(all, 15), of_pose = meanOverSeconds(pose, 6);
  return {of_all.mean, of_pose.mean, of_all.inside, of_pose.inside};
}

}  // namespace grid_path_planner::trials
