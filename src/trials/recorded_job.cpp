#include "trials/recorded_job.h"

#include <set>

#include "grid_path_planner/base/errors.h"
#include "localization/mounted_pose.h"
#include "study/run_folder.h"
#include "study/task_loop.h"
#include "trials/report/recorded_report.h"
#include "trials/track_file.h"
#include "trials/trial_plan.h"
#include "trials/trial_record.h"

namespace grid_path_planner::trials {

using base::InputError, base::StopToken;
using localization::CommandedVelocity, localization::DepthFix, localization::DvlVelocity,
    localization::HeadingFix, localization::ImuMeasurement, localization::Mounting,
    localization::PoseFix, localization::PositionFix;
using study::StudyOutcome, study::StudyTarget, study::TaskEnd;

namespace {

// Of base_link, with the times of the bag.
PoseTrack trackOfBase(PoseTrack track, const SensorTape& tape) {
  const auto first = tape.instants.empty() ? 0 : tape.instants.front().stamp;
  const double begin = 1e-9 * static_cast<double>(first) -
                       (tape.instants.empty() ? 0.0 : tape.instants.front().time);
  for (TimedPose& pose : track) {
    const auto base = carried(
        {pose.position, pose.attitude, localization::PoseCovariance::Identity()}, tape.base);
    pose = {begin + pose.time, base.position, base.attitude};
  }
  return track;
}

// All that a tape says, bit for bit.
class TapePrint {
 public:
  explicit TapePrint(study::Fingerprint& print) : print_(print) {}

  void add(const SensorTape& tape) {
    add(tape.base);
    for (const TapeEntry& entry : tape.entries) {
      print_.addNumber(entry.arrives);
      print_.addNumber(entry.measurement.stamp);
      print_.addText(nameOf(entry.measurement.source));
      std::visit([this](const auto& data) { add(data); }, entry.measurement.data);
    }
    for (const TapeInstant& instant : tape.instants) {
      print_.addNumber(instant.stamp);
      if (instant.truth) addPose(instant.truth->position, instant.truth->attitude);
    }
  }

 private:
  void addPose(const Eigen::Vector3d& position, const Eigen::Quaterniond& attitude) {
    print_.addMatrix(position);
    print_.addMatrix(attitude.coeffs());
  }
  void add(const Mounting& mounting) { addPose(mounting.position, mounting.rotation); }
  void add(const ImuMeasurement& imu) {
    print_.addMatrix(imu.inertial.rate);
    print_.addMatrix(imu.inertial.acceleration);
    if (imu.attitude) print_.addMatrix(imu.attitude->coeffs());
  }
  void add(const DvlVelocity& dvl) {
    print_.addMatrix(dvl.velocity);
    print_.addMatrix(dvl.covariance);
    add(dvl.sensor);
  }
  void add(const CommandedVelocity& command) {
    print_.addMatrix(command.velocity);
    add(command.base);
  }
  void add(const DepthFix& depth) {
    print_.addNumber(depth.z);
    print_.addNumber(depth.variance);
    print_.addMatrix(depth.sensor);
  }
  void add(const HeadingFix& heading) {
    print_.addNumber(heading.yaw);
    print_.addNumber(heading.variance);
  }
  void add(const PositionFix& fix) {
    print_.addMatrix(fix.position);
    print_.addMatrix(fix.covariance);
    print_.addMatrix(fix.sensor);
  }
  void add(const PoseFix& fix) {
    addPose(fix.position, fix.attitude);
    print_.addMatrix(fix.covariance);
    add(fix.mounting);
  }

  study::Fingerprint& print_;
};

}  // namespace

RecordedJob::RecordedJob(RecordedTrial trial, localization::NavigationRecording recording)
    : trial_(std::move(trial)),
      recording_(std::move(recording)),
      rows_(rowsOf(recording_)),
      tape_(tapeOf(trial_, recording_)) {
  for (const RecordedRow& row : rows_)
    if (row.missing.empty()) possible_.push_back(row.row);
  if (possible_.empty())
    throw InputError(trial_.bag, "allows no row: L1 needs " + rows_.front().missing +
                                     "; L2 needs " + rows_[2].missing);
}

std::function<std::string(std::size_t)> RecordedJob::work(const std::string& folder) const {
  return [this, folder](std::size_t unit) { return lineOfRow(unit, folder); };
}

std::string RecordedJob::lineOfRow(std::size_t unit, const std::string& folder) const {
  const TrialRow& row = possible_[unit];
  RunTracks tracks;
  const RowRecord record{row.name, played(trial_, row, tape_, &tracks)};
  writeTrack(folder, row.name, trackOfBase(tracks.estimate, tape_));
  if (unit == 0 && !tracks.truth.empty())
    writeTrack(folder, "truth", trackOfBase(tracks.truth, tape_));
  return lineOf(record) + '\n';
}

// A bag that was corrected has the same stamps.
std::uint64_t RecordedJob::fingerprint() const {
  study::Fingerprint print = fingerprintOf(trial_.file);
  TapePrint(print).add(tape_);
  return print.value();
}

StudyOutcome RecordedJob::run(const StudyTarget& target, study::WorkerGroup& workers,
                              const StopToken& stop,
                              const std::function<void(std::size_t)>& progress) const {
  study::RunFolder folder(target.folder, "trials", fingerprint());
  RecordedResults results{trial_, recording_, rows_, {}};
  for (const std::string& line : folder.lines()) {
    const RowRecord record = rowFromLine(line);
    results.played[record.row] = record.result;
  }
  StudyOutcome outcome;
  outcome.resumed = results.played.size();
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < possible_.size(); ++i)
    if (results.played.count(possible_[i].name) == 0) waiting.push_back(i);
  outcome.interrupted = runTasks(waiting, workers, stop, [&](const TaskEnd& end) {
    if (end.failed) {
      outcome.failures.push_back({possible_[end.task].name, end.text});
    } else {
      folder.add(end.text);
      results.played[possible_[end.task].name] =
          rowFromLine(end.text.substr(0, end.text.size() - 1)).result;
    }
    progress(results.played.size());
  });
  outcome.runs = results.played.size();
  if (outcome.runs == possible_.size()) writeRecordedReport(results, target);
  return outcome;
}

}  // namespace grid_path_planner::trials
