// Where a vehicle is, by two filters over the same sensors.
//
//   VehicleLocalizer localizer(options);
//   localizer.add(measurement);                              // throws base::InputError
//   if (const auto pose = localizer.mapAt(now)) drive(pose->estimate);
//
// The filter of the map takes everything. That of the odometry takes no fix but depth, so that its
// pose never jumps (REP 105); it starts at the origin of a frame of its own.
//
// Guaranteed: what LaggedFilter guarantees, for both. A measurement that is refused changes neither.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "localization/gravity_check.h"
#include "localization/lagged_filter.h"
#include "localization/localizer_options.h"
#include "localization/pose_doubt.h"

namespace grid_path_planner::localization {

enum class LocalizationStatus { INITIALIZING, OK, DEGRADED, LOST };

const char* nameOf(LocalizationStatus status);

struct LocalizationReport {
  LocalizationStatus status = LocalizationStatus::INITIALIZING;
  std::string sentence = {};
  // Standard deviation of the position along its worst axis, m, and of the attitude, deg; by how far what contradicts the
  // pose is off, where that is more.
  double deviation = 0.0, angle_deviation = 0.0;
};

// How long an input may be silent, s, before it is lost.
double longestSilence(Source source, const LocalizerOptions& options);

class VehicleLocalizer {
 public:
  // Throws InputError for an option outside its limits.
  explicit VehicleLocalizer(const LocalizerOptions& options);

  // Throws InputError for what checkMeasurement refuses, and for stamps that are DUPLICATE or TOO_OLD.
  Verdict add(const Measurement& measurement);

  // Other options, from the next measurement on. Throws InputError as the constructor does.
  void use(const LocalizerOptions& options);

  // Forgets everything but where the vehicle is in the body frame.
  void reset();

  // Turns vectors of the vehicle into the body frame, which is that of the IMU; not set: they are the same. It says
  // whether the vehicle is upside down.
  void setBase(const Eigen::Quaterniond& base) { base_ = base; }

  // What was known of the IMU's heading before the first measurement, by headingAt(). Without, its heading is taken
  // for true where the pose begins with positions.
  void beginWith(const KnownHeading& heading) { map_.beginWith(heading); }
  // The newest that is known, by a filter that has started or by beginWith(); of its own stamp.
  std::optional<KnownHeading> knownHeading() const { return map_.snapshot().heading; }
  // None before the filter has started, and where the IMU tells none at this very time.
  std::optional<KnownHeading> headingAt(Stamp stamp) const;

  // None before the filter has started.
  std::optional<FilterSnapshot> mapAt(Stamp stamp) const;
  std::optional<FilterSnapshot> odometryAt(Stamp stamp) const;
  Eigen::Vector3d rateOf(const FilterSnapshot& snapshot) const { return map_.rateOf(snapshot); }

  LocalizationReport report(Stamp now) const;
  // Seconds since the newest of this source that was used; none: none was.
  std::optional<double> sinceUsed(Source source, Stamp now) const;

  // Whether the estimates are numbers; else nothing that comes later mends them.
  bool isFinite() const;

  const LaggedFilter& map() const { return map_; }
  const LaggedFilter& odometry() const { return odometry_; }

 private:
  std::string silence(Stamp now) const;
  double sinceFix(Stamp now) const;
  std::string newBegin(const FilterSnapshot& snapshot, Stamp now) const;
  std::string problemOf(const FilterSnapshot& snapshot, Stamp now) const;
  std::string deviationsText(const LocalizationReport& report, bool is_new) const;
  void tell(const PoseDoubt& doubt, const std::string& problem, LocalizationReport& report) const;
  void tellGravity(const std::string& sentence, LocalizationReport& report) const;

  LocalizerOptions options_;
  LaggedFilter map_, odometry_;
  GravityCheck gravity_;
  Eigen::Quaterniond base_ = Eigen::Quaterniond::Identity();
  std::array<std::optional<Stamp>, kSources> used_{};  // the newest that was taken
};

}  // namespace grid_path_planner::localization
