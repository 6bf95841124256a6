#include "ros/localization/kept_heading.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"
#include "ros/guard/master/kept_file.h"
#include "ros/guard/scheduling/log_throttle.h"

namespace grid_path_planner::nodes {

using base::decimalText;
using base::InputError;
using base::StopSource;
using base::TaskQueue;
using localization::KnownHeading;

namespace {

constexpr double kEvery = 2.0;          // s of the wall clock
constexpr std::size_t kLongest = 4096;  // bytes of a file
constexpr char kSlot[] = "heading";

}  // namespace

std::string lineOf(const KnownHeading& heading, const std::string& run) {
  return "run " + run + " stamp " + std::to_string(heading.stamp) + " offset " +
         decimalText(heading.offset) + " variance " + decimalText(heading.variance) + "\n";
}

std::optional<KnownHeading> headingIn(const std::string& line, const std::string& run) {
  std::istringstream words(line);
  std::string names[4], of_run;
  KnownHeading heading;
  if (!(words >> names[0] >> of_run >> names[1] >> heading.stamp >> names[2] >> heading.offset >>
        names[3] >> heading.variance))
    return {};
  if (names[0] != "run" || names[1] != "stamp" || names[2] != "offset" || names[3] != "variance")
    return {};
  if (of_run != run || heading.stamp < 0 || !(std::abs(heading.offset) <= M_PI) ||
      !(heading.variance >= 0.0) || !(heading.variance <= M_PI * M_PI))
    return {};
  return heading;
}

std::optional<KnownHeading> headingAfterStep(const std::optional<KnownHeading>& heading,
                                             double back, localization::Stamp now,
                                             bool is_simulated) {
  if (!heading || is_simulated) return {};
  KnownHeading known = *heading;
  known.stamp = std::min(now, known.stamp - static_cast<localization::Stamp>(1e9 * back));
  return known;
}

KeptHeading::KeptHeading(const std::string& folder, const std::string& node)
    : run_(runIdAtStart()),
      folder_(folder),
      file_(folder + "/" + keptFileName(node, run_, ".heading")) {
  if (!run_.empty()) removeOldKeptFiles(file_);
}

std::optional<KnownHeading> KeptHeading::begin() const {
  if (run_.empty()) return {};
  try {
    const auto heading = headingIn(base::RegularFile(file_).read(0, kLongest), run_);
    if (heading)
      ROS_WARN_STREAM("Begins with the heading that was kept in "
                      << file_ << ", by which the IMU's was off by " << heading->offset
                      << " rad; the service ~reset forgets it");
    return heading;
  } catch (const InputError&) {  // there is none, or none that can be read
    return {};
  }
}

bool KeptHeading::isDue() const {
  return !run_.empty() && (kept_.isZero() || (ros::SteadyTime::now() - kept_).toSec() >= kEvery);
}

void KeptHeading::keep(const KnownHeading& heading) {
  if (run_.empty()) return;
  kept_ = ros::SteadyTime::now();
  writer_.post([this, line = lineOf(heading, run_)](const StopSource&) { write(line); }, kSlot);
}

void KeptHeading::write(const std::string& line) const {
  std::error_code ignored;  // shows in the writing
  std::filesystem::create_directories(folder_, ignored);
  try {
    base::writeFileAtomically(file_, line);
  } catch (const InputError& error) {
    static LogThrottle seldom(10.0);
    ROS_WARN_STREAM_COND(seldom.isDue(), "The heading cannot be kept for a node that starts again: "
                                             << error.what());
  }
}

void KeptHeading::forget() {
  writer_
      .post(
          [this](const StopSource&) {
            std::error_code error;  // none where there is no file
            std::filesystem::remove(file_, error);
            if (error)
              ROS_ERROR_STREAM(file_
                               << " cannot be removed, a node that starts again begins with it: "
                               << error.message());
          },
          kSlot, TaskQueue::Turn::NEXT)
      ->wait();
}

}  // namespace grid_path_planner::nodes
