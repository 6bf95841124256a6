#include "localization/lagged_filter.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace grid_path_planner::localization {

namespace {

std::tuple<Stamp, Source> orderOf(const Measurement& measurement) {
  return {measurement.stamp, measurement.source};
}

void count(SourceCounts& counts, Verdict verdict) {
  counts.taken += verdict == Verdict::TAKEN || verdict == Verdict::RESET;
  counts.gated += verdict == Verdict::GATED;
  counts.resets += verdict == Verdict::RESET;
}

}  // namespace

LaggedFilter::LaggedFilter(const FilterOptions& options, Start start)
    : options_(options), start_(start), step_(options, start) {}

void LaggedFilter::use(const FilterOptions& options) {
  options_ = options;
  step_ = FilterStep(options, start_);
}

void LaggedFilter::reset() {
  base_ = {};
  trimmed_ = false;
  events_.clear();
  counted_ = {};
}

bool LaggedFilter::started() const {
  return (empty() ? base_ : events_.back().after).started;
}

Verdict LaggedFilter::add(const Measurement& measurement) {
  if (trimmed_ && measurement.stamp <= base_.stamp) return Verdict::TOO_OLD;
  const auto place = std::lower_bound(events_.begin(), events_.end(), measurement,
                                      [](const Event& event, const Measurement& other) {
                                        return orderOf(event.measurement) < orderOf(other);
                                      });
  if (place != events_.end() && orderOf(place->measurement) == orderOf(measurement))
    return Verdict::DUPLICATE;
  const auto index = static_cast<std::size_t>(place - events_.begin());
  events_.insert(place, Event{measurement});
  applyFrom(measurement.source == Source::IMU ? firstAffected(index) : index);
  const Verdict verdict = events_[index].outcome.verdict;
  trim();
  return verdict;
}

// A measurement of the IMU changes the motion since the one before it.
std::size_t LaggedFilter::firstAffected(std::size_t index) const {
  while (index > 0 && events_[index - 1].measurement.source != Source::IMU) --index;
  return index;
}

// The first of the IMU at or after the event, as far as it matters: one after a gap does not.
const TimedImu* LaggedFilter::nextImu(std::size_t index, TimedImu& storage) const {
  const Stamp from = events_[index].measurement.stamp;
  for (; index < events_.size(); ++index) {
    const Measurement& measurement = events_[index].measurement;
    if (secondsBetween(from, measurement.stamp) > options_.imu_timeout) return nullptr;
    if (measurement.source != Source::IMU) continue;
    storage = {measurement.stamp, std::get<ImuMeasurement>(measurement.data)};
    return &storage;
  }
  return nullptr;
}

void LaggedFilter::applyFrom(std::size_t index) {
  TimedImu next;
  for (; index < events_.size(); ++index) {
    Event& event = events_[index];
    event.after = index == 0 ? base_ : events_[index - 1].after;
    event.outcome = step_.apply(event.after, event.measurement, nextImu(index, next));
  }
}

// What is dropped cannot be changed any more by a measurement of the IMU inside the history.
void LaggedFilter::trim() {
  const Stamp oldest =
      newest() - static_cast<Stamp>(1e9 * (options_.history + options_.imu_timeout));
  while (events_.front().measurement.stamp < oldest || events_.size() > kMostEvents) {
    const Event& event = events_.front();
    count(counted_[static_cast<std::size_t>(event.measurement.source)], event.outcome.verdict);
    base_ = event.after;
    trimmed_ = true;
    events_.pop_front();
  }
}

FilterSnapshot LaggedFilter::snapshotAt(Stamp stamp) const {
  const auto next =
      std::upper_bound(events_.begin(), events_.end(), stamp,
                       [](Stamp at, const Event& event) { return at < event.measurement.stamp; });
  FilterSnapshot snapshot = next == events_.begin() ? base_ : std::prev(next)->after;
  TimedImu imu;
  const TimedImu* next_imu = next == events_.end()
                                 ? nullptr
                                 : nextImu(static_cast<std::size_t>(next - events_.begin()), imu);
  if (stamp > snapshot.stamp) step_.advance(snapshot, stamp, next_imu);
  return snapshot;
}

Eigen::Vector3d LaggedFilter::rateOf(const FilterSnapshot& snapshot) const {
  return step_.rateAt(snapshot, nullptr).rate - snapshot.estimate.state.gyro_bias;
}

SourceCounts LaggedFilter::counts(Source source) const {
  SourceCounts counts = counted_[static_cast<std::size_t>(source)];
  for (const Event& event : events_)
    if (event.measurement.source == source) count(counts, event.outcome.verdict);
  return counts;
}

}  // namespace grid_path_planner::localization
