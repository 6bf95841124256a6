#include "trials/recorded_trial.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/errors.h"
#include "localization/mounted_pose.h"

namespace grid_path_planner::trials {

using base::InputError;
using localization::HeardInput, localization::HeardMeasurement, localization::NavigationRecording,
    localization::PoseFix, localization::secondsBetween, localization::Source, localization::Stamp,
    localization::TruePose;

namespace {

constexpr Stamp kUsualPeriod = 200'000'000;  // ns
constexpr std::size_t kMostInstants = 1'000'000;
constexpr double kLongestGap = 0.5;  // s, between two poses of the truth

bool has(const NavigationRecording& recording, Source source) {
  const auto input = recording.inputs.find(source);
  return input != recording.inputs.end() && input->second.used() > 0;
}

// "dvl/twist: the bag has no such topic"
std::string absenceOf(const NavigationRecording& recording, Source source) {
  const auto input = recording.inputs.find(source);
  if (input == recording.inputs.end()) return std::string("nothing of ") + nameOf(source);
  const HeardInput& of = input->second;
  if (of.heard == 0) return of.topic + ": " + (of.reason.empty() ? "no message" : of.reason);
  return of.topic + ": all " + std::to_string(of.heard) + " messages are refused: " + of.reason;
}

std::string missingFor(const TrialRow& row, const NavigationRecording& recording) {
  std::set<Source> needed = row.sources;
  if (row.usbl != UsblKind::NONE) needed.insert(Source::USBL);
  if (row.markers) needed.insert(Source::MARKER);
  std::string missing;
  for (const Source source : needed)
    if (!has(recording, source))
      missing += (missing.empty() ? "" : "; ") + absenceOf(recording, source);
  if (!missing.empty() || has(recording, Source::MARKER) || !recording.truth.empty())
    return missing;
  if (row.usbl == UsblKind::NONE) return "nothing says where it begins: no marker pose, no truth";
  return has(recording, Source::HEADING) ? ""
                                         : "nothing says how it is turned at the begin: " +
                                               absenceOf(recording, Source::HEADING);
}

std::vector<Stamp> markerStamps(const NavigationRecording& recording) {
  std::vector<Stamp> stamps;
  for (const HeardMeasurement& heard : recording.measurements)
    if (heard.measurement.source == Source::MARKER) stamps.push_back(heard.measurement.stamp);
  return stamps;
}

Stamp usualPeriodOf(const std::vector<Stamp>& stamps) {
  std::vector<Stamp> periods;
  for (std::size_t i = 1; i < stamps.size(); ++i) periods.push_back(stamps[i] - stamps[i - 1]);
  if (periods.empty()) return kUsualPeriod;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

class TapeMaker {
 public:
  TapeMaker(const RecordedTrial& trial, const NavigationRecording& recording)
      : trial_(trial), recording_(recording) {}

  SensorTape make() {
    tape_.base = recording_.base;
    for (const HeardMeasurement& heard : recording_.measurements) {
      TapeEntry entry{heard.arrives, heard.measurement};
      if (heard.measurement.source == Source::USBL) entry.usbl = UsblKind::USUAL;
      tape_.entries.push_back(entry);
    }
    if (tape_.entries.empty()) return tape_;
    begin_ = tape_.entries.front().arrives;
    setStart();
    addInstants();
    return std::move(tape_);
  }

 private:
  // Where the markers see it first, else where it truly is; before all else of that stamp.
  void setStart() {
    PoseFix start;
    const auto marker = std::find_if(tape_.entries.begin(), tape_.entries.end(), [](const auto& e) {
      return e.measurement.source == Source::MARKER;
    });
    const bool is_marked = marker != tape_.entries.end();
    if (is_marked) {
      start = std::get<PoseFix>(marker->measurement.data);
      begin_ = marker->measurement.stamp;
    } else if (!recording_.truth.empty()) {
      const TruePose& truth = recording_.truth.front();
      start = {truth.position, truth.attitude, localization::PoseCovariance::Zero(), {}};
      begin_ = truth.stamp;
    } else {
      return;
    }
    const double metres = trial_.start_deviation, angle = trial_.filter.start_yaw;
    start.covariance.diagonal().head<3>().array() += metres * metres;
    start.covariance.diagonal().tail<3>().array() += angle * angle;
    const auto place =
        std::lower_bound(tape_.entries.begin(), tape_.entries.end(), begin_,
                         [](const TapeEntry& e, Stamp stamp) { return e.arrives < stamp; });
    tape_.entries.insert(place, {begin_, {begin_, Source::SET_POSE, start}});
  }

  void addInstants() {
    std::vector<Stamp> marks = markerStamps(recording_);
    const Stamp period = usualPeriodOf(marks), end = tape_.entries.back().arrives;
    marks.push_back(end);
    Stamp last = begin_ - period;
    for (const Stamp mark : marks) {
      while (last + period + period / 2 < mark) addInstant(last += period);
      if (mark > last) addInstant(last = mark);
    }
  }

  void addInstant(Stamp stamp) {
    if (tape_.instants.size() == kMostInstants)
      throw InputError(trial_.bag, "is too long: more than a million poses to compare from " +
                                       std::to_string(1e-9 * static_cast<double>(begin_)) +
                                       " s on");
    tape_.instants.push_back({secondsBetween(begin_, stamp), stamp, truthAt(stamp)});
  }

  // Between the two poses about it.
  std::optional<localization::State> truthAt(Stamp stamp) const {
    const auto& truth = recording_.truth;
    const auto after =
        std::lower_bound(truth.begin(), truth.end(), stamp,
                         [](const TruePose& pose, Stamp at) { return pose.stamp < at; });
    if (after == truth.end() || (after == truth.begin() && after->stamp != stamp)) return {};
    const TruePose& to = *after;
    const TruePose& from = to.stamp == stamp ? to : *(after - 1);
    const double gap = secondsBetween(from.stamp, to.stamp);
    if (gap > kLongestGap) return {};
    const double share = gap > 0.0 ? secondsBetween(from.stamp, stamp) / gap : 0.0;
    localization::State state;
    state.position = from.position + share * (to.position - from.position);
    state.attitude = from.attitude.slerp(share, to.attitude);
    return state;
  }

  const RecordedTrial& trial_;
  const NavigationRecording& recording_;
  Stamp begin_ = 0;
  SensorTape tape_;
};

}  // namespace

std::vector<RecordedRow> rowsOf(const NavigationRecording& recording) {
  std::vector<RecordedRow> rows;
  for (const TrialRow& row : recordedRows()) rows.push_back({row, missingFor(row, recording)});
  return rows;
}

SensorTape tapeOf(const RecordedTrial& trial, const NavigationRecording& recording) {
  return TapeMaker(trial, recording).make();
}

}  // namespace grid_path_planner::trials
