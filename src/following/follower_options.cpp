#include "grid_path_planner/following/follower_options.h"

#include <string>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"

namespace grid_path_planner::following {

using base::checkOptionLimits;
using base::decimalText;
using base::InputError;

const std::vector<std::pair<const char*, FollowMode>>& choicesOf(FollowMode) {
  static const std::vector<std::pair<const char*, FollowMode>> choices = {
      {"continuous", FollowMode::CONTINUOUS}, {"stop_at_each", FollowMode::STOP_AT_EACH}};
  return choices;
}

const std::vector<std::pair<const char*, MissedPolicy>>& choicesOf(MissedPolicy) {
  static const std::vector<std::pair<const char*, MissedPolicy>> choices = {
      {"stop", MissedPolicy::STOP}, {"skip", MissedPolicy::SKIP}, {"retry", MissedPolicy::RETRY}};
  return choices;
}

const std::vector<std::pair<const char*, FacingMode>>& choicesOf(FacingMode) {
  static const std::vector<std::pair<const char*, FacingMode>> choices = {
      {"path_yaw", FacingMode::PATH_YAW}, {"along", FacingMode::ALONG}};
  return choices;
}

void checkFollowerOptions(const FollowerOptions& options) {
  checkOptionLimits(options);
  if (options.position_tolerance > options.acceptance_radius)
    throw InputError("position_tolerance must not be above acceptance_radius, got " +
                     decimalText(options.position_tolerance) + " m and " +
                     decimalText(options.acceptance_radius) + " m");
}

}  // namespace grid_path_planner::following
