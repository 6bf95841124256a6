#include "trials/trial_run.h"

#include <cmath>

#include "base/cholesky.h"
#include "localization/input_statistics.h"
#include "localization/mounted_pose.h"

namespace grid_path_planner::trials {

using localization::LaggedFilter, localization::Measurement, localization::MountedPose,
    localization::PoseFix, localization::Source, localization::Stamp, localization::State;

namespace {

class SpreadSum {
 public:
  void add(const PoseError& error) {
    metres_.push_back(error.metres);
    degrees_.push_back(error.degrees);
  }
  ErrorSpread spread() const {
    ErrorSpread spread;
    spread.count = static_cast<int>(metres_.size());
    std::tie(spread.metres, spread.metres_deviation) = of(metres_);
    std::tie(spread.degrees, spread.degrees_deviation) = of(degrees_);
    return spread;
  }

 private:
  static std::pair<double, double> of(const std::vector<double>& values) {
    if (values.empty()) return {NAN, NAN};
    const auto count = static_cast<double>(values.size());
    double sum = 0.0, squares = 0.0;
    for (const double value : values) sum += value;
    const double mean = sum / count;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / count)};
  }

  std::vector<double> metres_, degrees_;
};

localization::PoseCovariance statedCovariance(const StatedDeviation& deviation) {
  localization::PoseCovariance covariance = localization::PoseCovariance::Zero();
  covariance.diagonal().head<3>().setConstant(deviation.metres * deviation.metres);
  covariance.diagonal().tail<3>().setConstant(deviation.radians * deviation.radians);
  return covariance;
}

// Of the body by a fix of base_link.
TimedPose bodyBy(const PoseFix& fix) {
  const MountedPose body =
      carried({fix.position, fix.attitude, fix.covariance}, inverse(fix.mounting));
  return {0.0, body.position, body.attitude};
}

PoseError errorBetweenPoses(const TimedPose& pose, const TimedPose& truth) {
  return errorOf(pose.position, pose.attitude, truth.position, truth.attitude);
}

localization::FilterOptions optionsFor(localization::FilterOptions options, const TrialRow& row) {
  options.gate = row.gate;
  return options;
}

class RowPlayer {
 public:
  RowPlayer(const TrialSettings& study, const TrialRow& row, const SensorTape& tape)
      : study_(study),
        row_(row),
        tape_(tape),
        filter_(optionsFor(study.filter, row), localization::Start::AT_FIX),
        next_statistics_(study.filter.history) {}

  RowResult play() {
    auto entry = tape_.entries.begin();
    for (const TapeInstant& instant : tape_.instants) {
      std::optional<TimedPose> by_markers;
      for (; entry != tape_.entries.end() && entry->arrives <= instant.stamp; ++entry) {
        if (isReference(*entry) && entry->arrives == instant.stamp)
          by_markers = bodyBy(std::get<PoseFix>(entry->measurement.data));
        if (isGiven(*entry)) filter_.add(measurementOf(*entry));
      }
      if (filter_.started()) look(instant, by_markers);
    }
    return finished();
  }

  RunTracks tracks() const { return {estimates_, truths_}; }

 private:
  bool isReference(const TapeEntry& entry) const {
    return entry.measurement.source == Source::MARKER &&
           entry.method == row_.markers.value_or(Method::MEAN);
  }

  bool isGiven(const TapeEntry& entry) const {
    const Source source = entry.measurement.source;
    const double time = 1e-9 * static_cast<double>(entry.measurement.stamp);
    if (row_.lost.count(source) > 0 && study_.fault.holds(time)) return false;
    if (source == Source::SET_POSE) return true;
    if (source == Source::USBL) return entry.usbl == row_.usbl;
    if (source == Source::MARKER) return row_.markers && entry.method == *row_.markers;
    return row_.sources.count(source) > 0;
  }

  Measurement measurementOf(const TapeEntry& entry) const {
    Measurement measurement = entry.measurement;
    if (measurement.source != Source::MARKER) return measurement;
    if (row_.flips && entry.flipped) measurement.data = *entry.flipped;
    auto& fix = std::get<PoseFix>(measurement.data);
    if (row_.covariance == MarkerCovariance::DEFAULT)
      fix.covariance = statedCovariance(study_.default_covariance);
    if (row_.covariance == MarkerCovariance::PUBLISHED)
      fix.covariance = statedCovariance(study_.published_covariance);
    return measurement;
  }

  void look(const TapeInstant& instant, const std::optional<TimedPose>& by_markers) {
    const localization::Estimate estimate = filter_.snapshotAt(instant.stamp).estimate;
    const TimedPose pose{instant.time, estimate.state.position, estimate.state.attitude};
    takeStatistics(instant.time);
    const bool settled = instant.time >= study_.settle;
    if (settled) estimates_.push_back(pose);
    if (settled && by_markers) markers_.add(errorBetweenPoses(pose, *by_markers));
    if (instant.truth)
      compare(pose, {instant.time, instant.truth->position, instant.truth->attitude},
              neesOf(estimate, *instant.truth), by_markers.has_value());
  }

  void compare(const TimedPose& pose, const TimedPose& truth, const Nees& nees, bool in_view) {
    if (truth.time >= study_.fault.to && !fault_seen_) {
      fault_seen_ = true;
      result_.fault_end = errorBetweenPoses(pose, truth);
      result_.fault_nees = nees.all;
    }
    if (truth.time < study_.settle) return;
    compared_.push_back(pose);
    truths_.push_back(truth);
    all_.add(errorBetweenPoses(pose, truth));
    if (in_view) in_view_.add(errorBetweenPoses(pose, truth));
    if (truth.time < next_nees_) return;
    next_nees_ = std::floor(truth.time) + 1.0;
    result_.nees.push_back(nees.all);
    result_.pose_nees.push_back(nees.pose);
  }

  // Of the history, once in its length.
  void takeStatistics(double time) {
    if (time < next_statistics_) return;
    next_statistics_ += study_.filter.history;
    for (std::size_t i = 0; i < kNisSources.size(); ++i) {
      const auto of = inputStatistics(filter_, kNisSources[i], filter_.newest());
      NisMean& nis = result_.nis[i];
      if (of.nis_count == 0) continue;
      nis.mean = (nis.mean * nis.count + of.nis_mean * of.nis_count) / (nis.count + of.nis_count);
      nis.count += of.nis_count;
    }
  }

  RowResult finished() {
    result_.markers = markers_.spread();
    result_.in_view = in_view_.spread();
    result_.all = all_.spread();
    std::vector<Eigen::Vector3d> positions;
    for (const TimedPose& pose : estimates_) positions.push_back(pose.position);
    result_.smoothness = smoothnessOf(positions);
    result_.position_smoothness = autocorrelationOf(positions);
    if (!truths_.empty()) result_.ate = absoluteError(compared_, truths_);
    for (std::size_t i = 0; i < kRpeLengths.size(); ++i)
      result_.rpe[i] = relativeError(compared_, truths_, kRpeLengths[i]);
    for (const Source source : {Source::USBL, Source::MARKER}) {
      const localization::SourceCounts counts = filter_.counts(source);
      result_.gated += static_cast<int>(counts.gated);
      result_.resets += static_cast<int>(counts.resets);
    }
    return result_;
  }

  const TrialSettings& study_;
  const TrialRow& row_;
  const SensorTape& tape_;
  LaggedFilter filter_;
  SpreadSum markers_, in_view_, all_;
  PoseTrack estimates_;          // all
  PoseTrack compared_, truths_;  // those of which the truth is known
  RowResult result_;
  double next_nees_ = 0.0, next_statistics_;  // s
  bool fault_seen_ = false;
};

}  // namespace

Nees neesOf(const localization::Estimate& estimate, const State& truth) {
  const localization::ErrorVector error = localization::errorBetween<double>(estimate.state, truth);
  Eigen::Matrix<double, 6, 1> pose;
  pose << error.segment<3>(localization::kPosition), error.segment<3>(localization::kAttitude);
  return {base::Cholesky<localization::kErrors>(estimate.covariance).squaredMahalanobis(error),
          base::Cholesky<6>(poseOf(estimate).covariance).squaredMahalanobis(pose)};
}

RowResult played(const TrialSettings& study, const TrialRow& row, const SensorTape& tape,
                 RunTracks* tracks) {
  RowPlayer player(study, row, tape);
  const RowResult result = player.play();
  if (tracks) *tracks = player.tracks();
  return result;
}

}  // namespace grid_path_planner::trials
