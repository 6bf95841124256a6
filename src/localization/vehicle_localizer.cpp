#include "localization/vehicle_localizer.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "localization/filter_start.h"
#include "localization/measurement_check.h"

namespace grid_path_planner::localization {

namespace {

using base::decimalText;
using base::InputError;

constexpr double kSeldom = 5.0;  // times input_timeout: USBL

constexpr std::array<Source, 4> kFixes = {Source::SET_POSE, Source::HEADING, Source::USBL,
                                          Source::MARKER};

bool isFix(Source source) {
  return std::find(kFixes.begin(), kFixes.end(), source) != kFixes.end();
}

std::string rounded(double value) {
  return decimalText(std::round(100.0 * value) / 100.0);
}

std::string whatIsMissing(const LaggedFilter& map) {
  if (map.empty() || map.counts(Source::IMU).taken == 0)
    return "no IMU has been heard, and no pose was set";
  return "no two fixes agree yet: a pose set, marker poses, or USBL with the orientation of the "
         "IMU";
}

std::optional<FilterSnapshot> startedAt(const LaggedFilter& filter, Stamp stamp) {
  const FilterSnapshot snapshot = filter.snapshotAt(stamp);
  return snapshot.started ? std::make_optional(snapshot) : std::nullopt;
}

}  // namespace

const char* nameOf(LocalizationStatus status) {
  static constexpr std::array<const char*, 4> kNames = {"INITIALIZING", "OK", "DEGRADED", "LOST"};
  return kNames[static_cast<std::size_t>(status)];
}

double longestSilence(Source source, const LocalizerOptions& options) {
  if (source == Source::IMU) return std::max(0.5, 2.0 * options.filter.imu_timeout);
  const bool is_seldom = source == Source::USBL || source == Source::MARKER;
  return is_seldom ? kSeldom * options.input_timeout : options.input_timeout;
}

VehicleLocalizer::VehicleLocalizer(const LocalizerOptions& options)
    : options_(options),
      map_(options.filter, Start::AT_FIX),
      odometry_(options.filter, Start::AT_ORIGIN) {
  base::checkOptionLimits(options);
}

Verdict VehicleLocalizer::add(const Measurement& measurement) {
  checkMeasurement(measurement, options_.filter);
  const Verdict verdict = map_.add(measurement);
  if (verdict == Verdict::DUPLICATE) throw InputError("one of the same stamp was used already");
  if (verdict == Verdict::TOO_OLD)
    throw InputError("it is " + rounded(secondsBetween(measurement.stamp, map_.newest())) +
                     " s older than the newest input, more than the history");
  if (!isFix(measurement.source)) odometry_.add(measurement);
  if (const auto* imu = std::get_if<ImuMeasurement>(&measurement.data))
    gravity_.add(measurement.stamp, *imu, base_);
  std::optional<Stamp>& used = used_[static_cast<std::size_t>(measurement.source)];
  if (verdict == Verdict::TAKEN || verdict == Verdict::RESET)
    used = std::max(used.value_or(measurement.stamp), measurement.stamp);
  return verdict;
}

void VehicleLocalizer::use(const LocalizerOptions& options) {
  base::checkOptionLimits(options);
  options_ = options;
  map_.use(options.filter);
  odometry_.use(options.filter);
}

void VehicleLocalizer::reset() {
  map_.reset();
  odometry_.reset();
  gravity_ = {};
  used_ = {};
}

std::optional<FilterSnapshot> VehicleLocalizer::mapAt(Stamp stamp) const {
  return startedAt(map_, stamp);
}

std::optional<FilterSnapshot> VehicleLocalizer::odometryAt(Stamp stamp) const {
  return startedAt(odometry_, stamp);
}

std::optional<KnownHeading> VehicleLocalizer::headingAt(Stamp stamp) const {
  const auto snapshot = mapAt(stamp);
  if (!snapshot || !snapshot->imu || snapshot->imu->stamp != snapshot->stamp) return {};
  const auto& attitude = snapshot->imu->measurement.attitude;
  if (!attitude) return {};
  return localization::knownHeading(snapshot->stamp, *attitude, snapshot->estimate);
}

std::optional<double> VehicleLocalizer::sinceUsed(Source source, Stamp now) const {
  const auto used = used_[static_cast<std::size_t>(source)];
  return used ? std::make_optional(secondsBetween(*used, now)) : std::nullopt;
}

bool VehicleLocalizer::isFinite() const {
  return localization::isFinite(map_.snapshot().estimate) &&
         localization::isFinite(odometry_.snapshot().estimate);
}

// Of the first input that is missed; empty: of none.
std::string VehicleLocalizer::silence(Stamp now) const {
  for (const Source source : {Source::IMU, Source::DVL, Source::DEPTH, Source::USBL}) {
    const auto age = sinceUsed(source, now);
    if (age && *age > longestSilence(source, options_))
      return std::string(nameOf(source)) + " lost " + rounded(*age) + " s ago";
  }
  return {};
}

// Seconds since a fix was used; 0 where none was.
double VehicleLocalizer::sinceFix(Stamp now) const {
  std::optional<Stamp> newest;
  for (const Source source : kFixes)
    if (const auto used = used_[static_cast<std::size_t>(source)])
      newest = std::max(newest.value_or(*used), *used);
  return newest ? std::max(0.0, secondsBetween(*newest, now)) : 0.0;
}

// That something began anew, while that is in doubt; empty: nothing did.
std::string VehicleLocalizer::newBegin(const FilterSnapshot& snapshot, Stamp now) const {
  if (!snapshot.begun_anew) return {};
  const double since = secondsBetween(snapshot.begun_anew->stamp, now);
  if (since >= options_.reset_doubt) return {};
  return std::string(nameOf(snapshot.begun_anew->source)) + " began anew what it measures " +
         rounded(since) + " s ago, against the others; ";
}

// What is said before the deviations: why the pose may be off though they are small; empty: nothing shows it.
std::string VehicleLocalizer::problemOf(const FilterSnapshot& snapshot, Stamp now) const {
  if (const std::string silent = silence(now); !silent.empty()) return silent + "; ";
  if (options_.fix_timeout > 0.0 && sinceFix(now) > options_.fix_timeout / 3.0)
    return "no fix has been used for " + rounded(sinceFix(now)) + " s; ";
  return newBegin(snapshot, now);
}

std::string VehicleLocalizer::deviationsText(const LocalizationReport& report, bool is_new) const {
  std::string text = std::string(is_new ? "if that is right, " : "") + "the pose is known to " +
                     rounded(report.deviation) + " m, " + rounded(report.angle_deviation) +
                     " deg (standard deviations)";
  if (report.deviation > options_.max_deviation)
    text += ", max_deviation is " + rounded(options_.max_deviation) + " m";
  if (report.angle_deviation > options_.max_angle)
    text += ", max_angle is " + rounded(options_.max_angle) + " deg";
  return text;
}

LocalizationReport VehicleLocalizer::report(Stamp now) const {
  const auto snapshot = mapAt(now);
  const std::string wrong_gravity = gravity_.sentence(options_.filter.gravity);
  if (!snapshot)
    return {LocalizationStatus::INITIALIZING,
            wrong_gravity.empty() ? whatIsMissing(map_) : wrong_gravity};
  LocalizationReport report;
  const Covariance& covariance = snapshot->estimate.covariance;
  report.deviation = worstDeviation(covariance, kPosition);
  report.angle_deviation = worstDeviation(covariance, kAttitude) * 180.0 / M_PI;
  const double without_fix =
      options_.fix_timeout > 0.0 ? sinceFix(now) / options_.fix_timeout : 0.0;
  const double worst = std::max({report.deviation / options_.max_deviation,
                                 report.angle_deviation / options_.max_angle, without_fix});
  const std::string problem = problemOf(*snapshot, now);
  const auto doubt = doubtOf(*snapshot, now, options_);
  report.sentence = problem + deviationsText(report, !newBegin(*snapshot, now).empty());
  if (doubt) tell(*doubt, problem, report);
  const bool is_lost = (doubt && doubt->lasts) || !(worst <= 1.0);  // nor is one that is no number
  const bool is_doubtful = worst > 1.0 / 3.0 || doubt || !problem.empty();
  report.status = is_lost       ? LocalizationStatus::LOST
                  : is_doubtful ? LocalizationStatus::DEGRADED
                                : LocalizationStatus::OK;
  if (!wrong_gravity.empty()) tellGravity(wrong_gravity, report);
  if (report.status == LocalizationStatus::LOST)
    report.sentence +=
        doubt && doubt->lasts
            ? "; until fixes confirm it, or set_pose or reset tell it, map -> odom ceases"
            : "; until a fix, set_pose or reset tell it, map -> odom ceases";
  return report;
}

// Who says that fixes contradict the pose does not say what its covariance makes of it.
void VehicleLocalizer::tell(const PoseDoubt& doubt, const std::string& problem,
                            LocalizationReport& report) const {
  report.sentence = problem + sentenceOf(doubt);
  report.deviation = std::max(report.deviation, doubt.metres);
  report.angle_deviation = std::max(report.angle_deviation, doubt.degrees);
}

// A vehicle that is upside down may well be where the pose says.
void VehicleLocalizer::tellGravity(const std::string& sentence, LocalizationReport& report) const {
  const bool is_upside_down = gravity_.fault(options_.filter.gravity) == GravityFault::UPSIDE_DOWN;
  if (!is_upside_down) report.status = LocalizationStatus::LOST;
  if (report.status == LocalizationStatus::OK) report.status = LocalizationStatus::DEGRADED;
  report.sentence = sentence + "; " + report.sentence;
}

}  // namespace grid_path_planner::localization
